// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>
#include <sphmbs/mbs/structure.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/force_laws.hpp"

namespace {

using namespace sphmbs::mbs;
using test::Dual;

constexpr double exact = 1e-12;       // relative, of sums and products
constexpr double derivative = 1e-10;  // relative

template <int Dim>
using Model = Structure<ancf::Cable<Dim>, joints::Sliding<ancf::Cable<Dim>>>;

constexpr int elements = 3;
constexpr double lengths[elements] = {0.7, 0.5, 0.9};
constexpr double total = 2.1;

/// A bent chain of cables of different lengths, and a free point that slides on it.
template <int Dim>
struct Example {
  static constexpr int n = Dim + 1 + 4 * Dim;  // coordinates of the joint
  test::Random random;
  Model<Dim> model;
  std::vector<Placed<ancf::Cable<Dim>>> chain;
  Marker<Dim> slider;
  joints::SlidingOptions<Dim> options;

  explicit Example(std::uint64_t seed) : random(seed) {
    std::vector<Node> nodes;
    for (int i = 0; i <= elements; ++i) {
      VectorXd q(2 * Dim), v(2 * Dim);
      for (int k = 0; k < 2 * Dim; ++k) {
        q[k] = random.between(-0.3, 0.3);
        v[k] = random.between(-1, 1);
      }
      q[0] += i;
      q[Dim] += 1;
      nodes.push_back(model.add_node(q, v));
    }
    for (int i = 0; i < elements; ++i) {
      const auto k = static_cast<std::size_t>(i);
      chain.push_back(model.add(ancf::Cable<Dim>{.length = lengths[i],
                                                 .axial_stiffness = 1,
                                                 .bending_stiffness = 1,
                                                 .mass_per_length = 1},
                                {nodes[k], nodes[k + 1]}));
    }
  }

  /// The slider on the rail at s, with a random velocity.
  void place(double s) {
    VectorXd v(Dim);
    for (int k = 0; k < Dim; ++k) v[k] = random.between(-1, 1);
    const auto at = joints::Rail(chain).point(s).at(model.q());
    const Node node = model.add_node(at, v);
    slider = {.N = Matrix<Dim, Dynamic>::Identity(Dim, Dim)};
    for (int k = 0; k < Dim; ++k) slider.index.push_back(node.offset + k);
    options.slider = slider;
    options.at = s;
  }

  joints::Sliding<ancf::Cable<Dim>> joint() { return joints::sliding(model, chain, options); }
};

/// Phi of the element that begins at `start`, from its cubic: q = (slider, s, r0, r0', r1, r1').
template <int Dim, class S>
Vector<Dim, S> reference_line(const Vector<5 * Dim + 1, S>& q, double start, double length,
                              int order) {
  const S x = (q[Dim] - S(start)) / S(length), L(length);
  S c[4];
  if (order == 0) {
    c[0] = S(1.0) - S(3.0) * x * x + S(2.0) * x * x * x;
    c[1] = L * (x - S(2.0) * x * x + x * x * x);
    c[2] = S(3.0) * x * x - S(2.0) * x * x * x;
    c[3] = L * (x * x * x - x * x);
  } else {
    c[0] = (S(6.0) * x * x - S(6.0) * x) / L;
    c[1] = S(1.0) - S(4.0) * x + S(3.0) * x * x;
    c[2] = (S(6.0) * x - S(6.0) * x * x) / L;
    c[3] = S(3.0) * x * x - S(2.0) * x;
  }
  Vector<Dim, S> r = Vector<Dim, S>::Constant(S(0.0));
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < Dim; ++k) r[k] += c[i] * q[Dim + 1 + Dim * i + k];
  return r;
}

template <int n>
struct State {
  Vector<n> q, v;
};
template <int n, class Joint>
State<n> state_of(const Joint& joint, test::Random& random, double s) {
  State<n> x;
  for (int k = 0; k < n; ++k) {
    x.q[k] = random.between(-1, 1);
    x.v[k] = random.between(-1, 1);
  }
  x.q[joint.conditions()] = s;
  return x;
}

template <int Dim>
void check_derivatives(std::uint64_t seed) {
  constexpr int n = Example<Dim>::n;
  Example<Dim> example(seed);
  example.place(0.3);
  auto joint = example.joint();
  for (const double s : {0.2, 0.65, 1.0, 1.9, 2.2, -0.1}) {
    VectorXd all = VectorXd::Zero(example.model.coordinates());
    all[joint.arc().index[0]] = s;
    joint.relocate(all);
    const auto element = joint.element();
    const double start = joint.rail().start(element), length = lengths[element];
    const State<n> now = state_of<n>(joint, example.random, s);
    const auto phi_of = [&]<class S>(const Vector<n, S>& q) {
      return Vector<Dim, S>(q.template head<Dim>() - reference_line<Dim, S>(q, start, length, 0));
    };
    VectorXd phi = VectorXd::Zero(Dim), gamma = phi, rate = phi;
    MatrixXd B = MatrixXd::Zero(Dim, n), H = MatrixXd::Zero(n, n);
    joint.residual(now.q, 0, phi);
    joint.jacobian(now.q, 0, B);
    CHECK((phi - phi_of(now.q)).norm() < exact * now.q.norm());
    CHECK((B - test::jacobian<Dim, n>(phi_of(test::dual<n>(now.q)))).norm() <
          derivative * B.norm());
    VectorXd lambda(Dim);
    for (int k = 0; k < Dim; ++k) lambda[k] = example.random.between(-1, 1);
    joint.add_hessian(now.q, 0, lambda, H);
    const auto product = [&]<class S>(const Vector<n, S>& q) -> S {
      S sum(0.0);
      const Vector<Dim, S> f = phi_of(q);
      for (int k = 0; k < Dim; ++k) sum += S(lambda[k]) * f[k];
      return sum;
    };
    CHECK((H - test::slopes<n>(product, now.q).hessian).norm() < derivative * H.norm());
    joint.rate(now.q, 0, rate);
    joint.acceleration(now.q, now.v, 0, gamma);
    CHECK(rate.isZero(0.0));
    CHECK(gamma.isZero(0.0));
  }
}

/// mu, c, w0 and N0 of the reference law below.
constexpr joints::Friction sticky{
    .coefficient = 0.4, .viscous = 0.3, .creep_velocity = 0.5, .normal_smoothing = 0.1};

/// r_s of friction, as its definition has it.
template <int Dim, class S>
S reference_friction(const Vector<5 * Dim + 1, S>& q, const Vector<5 * Dim + 1, S>& v,
                     const Vector<Dim, S>& lambda, double start, double length) {
  using std::sqrt, std::tanh;
  const Vector<Dim, S> tangent = reference_line<Dim, S>(q, start, length, 1);
  const S stretch = sqrt(tangent.squaredNorm());
  const Vector<Dim, S> along = tangent / stretch;
  const Vector<Dim, S> across = lambda - S(along.dot(lambda)) * along;
  const S N = sqrt(across.squaredNorm() + S(0.01)) - S(0.1), w = stretch * v[Dim];
  return stretch * (S(0.4) * N * tanh(S(w / S(0.5))) + S(0.3) * w);
}

template <int Dim>
void check_friction(std::uint64_t seed) {
  constexpr int n = Example<Dim>::n, m = Dim;
  Example<Dim> example(seed);
  example.place(1.0);
  example.options.friction = sticky;
  const auto joint = example.joint();
  REQUIRE(joint.element() == 1);
  const State<n> now = state_of<n>(joint, example.random, 1.05);
  Vector<m> lambda;
  for (int k = 0; k < m; ++k) lambda[k] = example.random.between(-5, 5);

  using D = Dual<2 * n + m>;
  Vector<n, D> q, v;
  Vector<m, D> force;
  for (int k = 0; k < n; ++k) {
    q[k] = D(now.q[k], 2 * n + m, k);
    v[k] = D(now.v[k], 2 * n + m, n + k);
  }
  for (int k = 0; k < m; ++k) force[k] = D(lambda[k], 2 * n + m, 2 * n + k);
  const D expected = reference_friction<Dim, D>(q, v, force, 0.7, 0.5);

  VectorXd r = VectorXd::Zero(n);
  MatrixXd k = MatrixXd::Zero(n, n), c = k, l = MatrixXd::Zero(n, m);
  joint.friction(now.q, now.v, 0, lambda, r);
  joint.friction_tangent(now.q, now.v, 0, lambda, k, c, l);
  CHECK((r - expected.value() * VectorXd::Unit(n, Dim)).norm() < exact * r.norm());
  const Vector<2 * n + m> slope = expected.derivatives();
  CHECK((k.row(Dim).transpose() - slope.head(n)).norm() < derivative * slope.norm());
  CHECK((c.row(Dim).transpose() - slope.segment(n, n)).norm() < derivative * slope.norm());
  CHECK((l.row(Dim).transpose() - slope.tail(m)).norm() < derivative * slope.norm());
  for (int i = 0; i < n; ++i)
    if (i != Dim) {
      CHECK(k.row(i).isZero(0.0));
      CHECK(c.row(i).isZero(0.0));
      CHECK(l.row(i).isZero(0.0));
    }
  const double power = joint.dissipation(now.q, now.v, 0, lambda);
  CHECK(power > 0);
  CHECK(power == Approx(r.dot(now.v)));
}

}  // namespace

TEST_CASE("the conditions of a sliding joint have their exact first and second derivatives",
          "[mbs]") {
  static_assert(MovingConstraint<joints::Sliding<ancf::Cable<2>>>);
  static_assert(WatchingConstraint<joints::Sliding<ancf::Cable<2>>>);
  static_assert(FrictionalConstraint<joints::Sliding<ancf::Cable<3>>>);
  check_derivatives<2>(1);
  check_derivatives<3>(2);
}

TEST_CASE("a sliding joint follows its slider from element to element, and Phi is smooth there",
          "[mbs]") {
  Example<3> example(3);
  example.place(0.3);
  auto joint = example.joint();
  const int s_at = joint.arc().index[0];
  VectorXd q(example.model.coordinates());
  q << example.model.q().head(q.size() - 1), 0.3;
  // Phi and Phi_q over all coordinates.
  const auto conditions = [&](double s, VectorXd& phi, MatrixXd& B) {
    q[s_at] = s;
    const bool changed = joint.relocate(q);
    CHECK(!joint.relocate(q));
    const Index& index = joint.index();
    MatrixXd local = MatrixXd::Zero(3, static_cast<int>(index.size()));
    phi = VectorXd::Zero(3);
    B = MatrixXd::Zero(3, q.size());
    joint.residual(q(index), 0, phi);
    joint.jacobian(q(index), 0, local);
    B(Eigen::all, index) = local;
    return changed;
  };
  const double step = 1e-9;
  VectorXd before, after;
  MatrixXd B_before, B_after;
  for (const double border : {0.7, 1.2}) {
    conditions(border - step, before, B_before);
    const std::size_t element = joint.element();
    CHECK(conditions(border + step, after, B_after));
    CHECK(joint.element() == element + 1);
    CHECK((after - before).norm() < 10 * step);
    CHECK((B_after - B_before).norm() < 100 * step);
    CHECK(conditions(border - step, after, B_after));
    CHECK(joint.element() == element);
  }
  // To far elements at once, and past the ends.
  CHECK(conditions(0.1, before, B_before));
  CHECK(joint.element() == 0);
  CHECK(conditions(2.0, before, B_before));
  CHECK(joint.element() == 2);
  CHECK(!conditions(2.3, before, B_before));
  CHECK(conditions(-0.3, before, B_before));
  CHECK(joint.element() == 0);
  CHECK(joint.index().size() == 3 + 1 + 12);
}

TEST_CASE("a sliding joint starts where and as fast as its slider", "[mbs]") {
  Example<2> example(4);
  example.place(0.9);
  const auto joint = example.joint();
  const VectorXd q = example.model.q(), v = example.model.v();
  const int s = joint.arc().index[0];
  CHECK(s == q.size() - 1);
  CHECK(q[s] == 0.9);
  // The velocity along the rail, as seen from the rail.
  const auto line = joint.rail();
  const Vector<2> tangent = line.tangent(0.9).at(q);
  const Vector<2> gap = example.slider.rate(v) - line.point(0.9).rate(v) - v[s] * tangent;
  CHECK(std::abs(gap.dot(tangent)) < exact);

  example.options.rate = 0.25;
  const auto given = example.joint();
  CHECK(example.model.v()[given.arc().index[0]] == 0.25);
  CHECK(example.model.add(given) == 0);
}

TEST_CASE("friction of a sliding joint has exact derivatives in q, v and lambda", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    check_friction<2>(seed);
    check_friction<3>(seed);
  }
}

TEST_CASE("the equation of s makes the reaction along the rail friction that opposes sliding",
          "[mbs]") {
  // -r' . lambda + r_s = 0, solved for the part of lambda along the rail.
  Example<2> example(5);
  example.place(1.0);
  example.options.friction = {.coefficient = 0.4, .viscous = 0.3, .creep_velocity = 1e-6};
  const auto joint = example.joint();
  const VectorXd all = example.model.q();
  const VectorXd q = all(joint.index());
  const Vector<2> along = joint.rail().tangent(1.0).at(all).normalized();
  const double stretch = joint.rail().tangent(1.0).at(all).norm();
  const Vector<2> across(-along[1], along[0]);
  for (const double normal : {7.0, -7.0})
    for (const double rate : {0.5, -0.5}) {
      const double w = stretch * rate, friction = std::copysign(0.4 * 7, w) + 0.3 * w;
      const VectorXd lambda = normal * across + friction * along;
      VectorXd v = VectorXd::Zero(q.size()), r = v;
      v[2] = rate;
      joint.friction(q, v, 0, lambda, r);
      MatrixXd B = MatrixXd::Zero(2, q.size());
      joint.jacobian(q, 0, B);
      const VectorXd rows = B.transpose() * lambda + r;
      CHECK(std::abs(rows[2]) < 1e-3 * friction * friction);
      // On the slider acts -lambda; its power along the rail is what friction takes.
      const Vector<2> slide = w * along;
      CHECK(-lambda.dot(slide) < 0);
      CHECK(joint.dissipation(q, v, 0, lambda) == Approx(lambda.dot(slide)).epsilon(1e-3));
    }
}

TEST_CASE("stops push a slider back from beyond the ends, and only there", "[mbs]") {
  Example<2> example(6);
  example.place(1.0);
  example.options.ends = joints::Ends::stop;
  example.options.stop = {.stiffness = 100, .exponent = 2, .damping = 0.5};
  const auto joint = example.joint();
  constexpr int n = Example<2>::n;
  State<n> now = state_of<n>(joint, example.random, 0);
  const Vector<2> lambda(0, 0);
  const auto push = [&](double s, double rate) {
    now.q[2] = s;
    now.v[2] = rate;
    VectorXd r = VectorXd::Zero(n);
    joint.friction(now.q, now.v, 0, lambda, r);
    MatrixXd k = MatrixXd::Zero(n, n), c = k, l = MatrixXd::Zero(n, 2);
    joint.friction_tangent(now.q, now.v, 0, lambda, k, c, l);
    // The same law, differentiated by hand.
    const double depth = s < 0 ? -s : s - total, speed = s < 0 ? -rate : rate;
    if (depth > 0) {
      CHECK(k(2, 2) == Approx(200 * depth * (1 + 0.5 * speed)));
      CHECK(c(2, 2) == Approx(50 * depth * depth));
      CHECK(joint.potential(now.q, 0) == Approx(100.0 / 3 * depth * depth * depth));
      CHECK(joint.dissipation(now.q, now.v, 0, lambda) ==
            Approx(50 * depth * depth * speed * speed));
    } else {
      CHECK(k.isZero(0.0));
      CHECK(c.isZero(0.0));
      CHECK(joint.potential(now.q, 0) == 0);
    }
    return -r[2];  // on the right of the equation
  };
  CHECK(push(0, -1) == 0);
  CHECK(push(total, 1) == 0);
  CHECK(push(-0.1, 0) == Approx(1));
  CHECK(push(-0.1, -1) == Approx(1.5));
  CHECK(push(total + 0.1, 1) == Approx(-1.5));
  CHECK(push(total + 0.1, -1) == Approx(-0.5));
}

TEST_CASE("a slider beyond the end is an event once the state is accepted", "[mbs][fault]") {
  Example<2> example(7);
  example.place(2.0);
  example.options.name = "A";
  auto joint = example.joint();
  VectorXd q = example.model.q();
  const int s = joint.arc().index[0];
  const auto event = [&](double place) {
    q[s] = place;
    joint.relocate(q);  // never throws
    return test::complaint<sphmbs::NumericalFailure>([&] { joint.accept(q, 0.25); });
  };
  CHECK(event(0).empty());
  CHECK(event(total).empty());
  CHECK(event(total + 1e-7).empty());  // rounding
  CHECK(
      event(2.2) ==
      "sliding joint 'A': at t = 0.25 s the slider has left its rail: s = 2.2 m, the rail is from "
      "0 to 2.1 m; make the rail longer, end the run earlier, or give it `Ends::stop`");
  CHECK(!event(-0.01).empty());

  example.options.ends = joints::Ends::stop;
  joint = example.joint();
  const int its_s = joint.arc().index[0];
  q = example.model.q();
  const auto through = [&](double place) {
    q[its_s] = place;
    return test::complaint<sphmbs::NumericalFailure>([&] { joint.accept(q, 0.25); });
  };
  CHECK(through(2.2).empty());
  CHECK(through(-0.01).empty());
  CHECK_THAT(through(3.1), Catch::Contains("make `stop` stiffer or the step shorter"));
}

TEST_CASE("a sliding joint refuses bad input", "[mbs]") {
  Example<2> example(8);
  example.place(0.9);
  const auto refusal = [&](const joints::SlidingOptions<2>& options) {
    return test::refusal(
        [&] { example.model.add(joints::sliding(example.model, example.chain, options)); });
  };
  const auto with = [&](auto change) {
    auto options = example.options;
    change(options);
    return refusal(options);
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(example.options).empty());
  CHECK(with([](auto& o) { o.at = 2.2; }) ==
        "sliding joint: at = 2.2: must be between 0 and the length of the rail, 2.100000 [m]");
  CHECK_THAT(with([&](auto& o) { o.at = not_a_number; }), Catch::Contains("at = nan"));
  CHECK(with([](auto& o) { o.slider.x0[1] = 0.25; }) ==
        "sliding joint: distance of the slider from the rail = 0.25: must be zero at t = 0 [m]");
  CHECK(with([](auto& o) { o.friction.coefficient = -0.1; }) ==
        "sliding joint: friction.coefficient = -0.1: must be zero or positive [-]");
  CHECK(with([&](auto& o) { o.friction.viscous = not_a_number; }) ==
        "sliding joint: friction.viscous = nan: must be zero or positive [N s/m]");
  CHECK(with([](auto& o) { o.friction.creep_velocity = 0; }) ==
        "sliding joint: friction.creep_velocity = 0: must be positive [m/s]");
  CHECK(with([](auto& o) { o.friction.normal_smoothing = 0; }) ==
        "sliding joint: friction.normal_smoothing = 0: must be positive [N]");
  CHECK(with([](auto& o) { o.stop.stiffness = -1; }) ==
        "sliding joint: stop: stiffness = -1: must be zero or positive [N/m^p]");
  CHECK(with([](auto& o) { o.overrun = -1; }) ==
        "sliding joint: overrun = -1: must be between 0 and 1 [-]");
  std::swap(example.chain[0], example.chain[1]);
  CHECK(refusal(example.options) ==
        "sliding joint: element of the rail = 1: must be one that begins at the node where the one "
        "before ends");
  example.chain.clear();
  CHECK(refusal(example.options) == "sliding joint: elements of the rail = 0: must be one or more");
}
