// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <sphmbs/mbs/joints/distance.hpp>
#include <sphmbs/mbs/joints/gear.hpp>
#include <sphmbs/mbs/joints/relation.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>

#include "support/errors.hpp"
#include "support/joint_laws.hpp"

namespace {

using namespace sphmbs::mbs;
using joints::Relation;
using joints::TimeFunction;
using ncf::PlanarBody;

constexpr double rounding = 1e-12;

/// The condition of joints::distance between two planar points, L = 1 + t / 2, written out.
struct Stretch {
  template <class S>
  Vector<1, S> operator()(const Vector<Dynamic, S>& x, const S& t) const {
    const S dx = x[0] - x[2], dy = x[1] - x[3], L = 1.0 + 0.5 * t;
    return Vector<1, S>(S((dx * dx + dy * dy - L * L) / 2.0));
  }
};

/// Two conditions with all sorts of functions, on three coordinates.
struct Wild {
  template <class S>
  Vector<2, S> operator()(const Vector<Dynamic, S>& x, const S& t) const {
    using std::cos, std::exp, std::sin, std::sqrt;
    Vector<2, S> phi;
    phi[0] = S(sin(S(x[0] * x[1])) + exp(S(t * x[2])) - 2.0 * t * t);
    phi[1] = S(sqrt(S(2.0 + x[2] * x[2])) * cos(x[0]) / (3.0 + x[1]) - t * x[1]);
    return phi;
  }
};

/// The same, first condition alone, with derivatives by hand.
struct ByHand {
  VectorXd operator()(const VectorXd& x, double t) const {
    return Vector<1>(std::sin(x[0] * x[1]) + std::exp(t * x[2]) - 2 * t * t);
  }
  MatrixXd jacobian(const VectorXd& x, double t) const {
    const double c = std::cos(x[0] * x[1]);
    return Matrix<1, 3>(c * x[1], c * x[0], t * std::exp(t * x[2]));
  }
  MatrixXd hessian(const VectorXd& x, double t, const VectorXd& lambda) const {
    const double c = std::cos(x[0] * x[1]), s = std::sin(x[0] * x[1]);
    Matrix<3, 3> h = Matrix<3, 3>::Zero();
    h(0, 0) = -s * x[1] * x[1];
    h(1, 1) = -s * x[0] * x[0];
    h(0, 1) = h(1, 0) = c - s * x[0] * x[1];
    h(2, 2) = t * t * std::exp(t * x[2]);
    return lambda[0] * h;
  }
  VectorXd rate(const VectorXd& x, double t) const {
    return Vector<1>(x[2] * std::exp(t * x[2]) - 4 * t);
  }
  VectorXd acceleration(const VectorXd& x, const VectorXd& v, double t) const {
    const double e = std::exp(t * x[2]);
    return Vector<1>(2 * (1 + t * x[2]) * e * v[2] + x[2] * x[2] * e - 4);
  }
};
static_assert(joints::Differentiated<ByHand> && !joints::Differentiated<Wild>);
static_assert(Constraint<Relation<Wild>> && Constraint<Relation<ByHand>> &&
              Constraint<Relation<joints::Mesh>>);

/// All that a constraint says at one state.
struct Said {
  VectorXd phi, phi_t, gamma;
  MatrixXd phi_q, h;
};
template <Constraint C>
Said said(const C& joint, const VectorXd& q, const VectorXd& v, double t, const VectorXd& lambda) {
  const auto n = static_cast<int>(q.size());
  const int m = joint.conditions();
  Said all{VectorXd::Zero(m), VectorXd::Zero(m), VectorXd::Zero(m), MatrixXd::Zero(m, n),
           MatrixXd::Zero(n, n)};
  joint.residual(q, t, all.phi);
  joint.jacobian(q, t, all.phi_q);
  joint.add_hessian(q, t, lambda, all.h);
  joint.rate(q, t, all.phi_t);
  joint.acceleration(q, v, t, all.gamma);
  return all;
}

void check_same(const Said& a, const Said& b) {
  CHECK(test::largest_difference(a.phi, b.phi) < rounding);
  CHECK(test::largest_difference(a.phi_q, b.phi_q) < rounding);
  CHECK(test::largest_difference(a.h, b.h) < rounding);
  CHECK(test::largest_difference(a.phi_t, b.phi_t) < rounding);
  CHECK(test::largest_difference(a.gamma, b.gamma) < rounding);
}

}  // namespace

TEST_CASE("a relation between markers is what the standard joint is", "[mbs]") {
  test::Random random(51);
  Structure<PlanarBody> structure;
  const auto a = structure.add(PlanarBody{.inertia = {.mass = 1, .polar = 1}});
  const auto b = structure.add(PlanarBody{.inertia = {.mass = 1, .polar = 1}});
  const auto P = a.point({1, 2}), Q = b.point({3, -1});
  const TimeFunction length = joints::linear_in_time(1, 0.5);
  const auto standard = joints::distance(P, Q, length);
  const Relation own("rope", std::vector{P, Q}, Stretch{});
  CHECK(own.name() == "relation 'rope'");
  CHECK(own.conditions() == 1);
  CHECK(own.index() == standard.index());
  const auto n = static_cast<int>(own.index().size());
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd q = test::random_vector(random, n), v = test::random_vector(random, n);
    const double t = random.between(0, 2);
    check_same(said(own, q, v, t, Vector<1>(0.7)), said(standard, q, v, t, Vector<1>(0.7)));
  }
}

TEST_CASE("a relation is differentiated as by hand", "[mbs]") {
  test::Random random(52);
  const auto first = [](const auto& x, const auto& t) {
    using S = std::decay_t<decltype(t)>;
    return Vector<1, S>(Wild{}(x, t)[0]);
  };
  const Relation found("wild", Index{4, 2, 9}, first);
  const Relation given("wild", Index{4, 2, 9}, ByHand{});
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd q = test::random_vector(random, 3), v = test::random_vector(random, 3);
    const double t = random.between(0, 2);
    check_same(said(found, q, v, t, Vector<1>(-1.3)), said(given, q, v, t, Vector<1>(-1.3)));
  }
}

TEST_CASE("the second derivatives of a relation are those of its first ones", "[mbs]") {
  // Along a straight line: Phi(q + s v, t + s) differentiated as one function of s.
  test::Random random(53);
  const Relation relation("wild", Index{0, 1, 2}, Wild{});
  CHECK(relation.conditions() == 2);
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd q = test::random_vector(random, 3), v = test::random_vector(random, 3);
    const double t = random.between(0, 2);
    const auto slopes = test::slopes_along(relation, q, v, VectorXd::Zero(3), t);
    for (int i = 0; i < 2; ++i) {
      const auto along = joints::differentiated([&](auto s) {
        using S = decltype(s);
        Vector<Dynamic, S> x(3);
        for (int k = 0; k < 3; ++k) x[k] = S(q[k] + v[k] * s);
        return S(Wild{}(x, S(t + s))[i]);
      });
      CHECK(slopes.first[i] == Approx(along.rate(0)).epsilon(1e-12));
      CHECK(slopes.second[i] == Approx(along.acceleration(0)).epsilon(1e-11));
    }
  }
}

TEST_CASE("a linear relation of markers and coordinates is linear, with a given sum", "[mbs]") {
  test::Random random(54);
  Structure<PlanarBody> structure;
  const auto body = structure.add(PlanarBody{.inertia = {.mass = 1, .polar = 1}});
  const auto P = body.point({1, 2});
  const auto q3 = joints::coordinate<2>(3);
  const TimeFunction value([](double t) { return t * t; }, [](double t) { return 2 * t; },
                           [](double) { return 2.0; });
  const auto rack = joints::linear<2>({{{2, -1}, P}, {{5, 0}, q3}}, value, "rack");
  rack.check();
  CHECK(rack.name() == "linear 'rack'");
  CHECK(rack.linear());
  const VectorXd q = test::random_vector(random, 4);
  CHECK(test::residual(rack, q, 3)[0] ==
        Approx(Vector<2>(2, -1).dot(P.at(q)) + 5 * q[3] - 9).epsilon(rounding));
  test::check_derivatives_in_q(rack, random, 1);
  test::check_derivatives_in_time(rack, random, 1);
}

TEST_CASE("a gear couples the angles of two wheels, for any number of turns", "[mbs]") {
  using std::numbers::pi;
  const auto wheel = [](double angle) {
    return PlanarBody{.inertia = {.mass = 1, .polar = 1}, .angle = angle};
  };
  const auto q_of = [&](double alpha, double beta) {
    VectorXd q(8);
    q << wheel(alpha).initial_coordinates(), wheel(beta).initial_coordinates();
    return q;
  };
  const double alpha = 0.4, beta = -1.1;
  for (const bool inside : {false, true}) {
    Structure<PlanarBody, Relation<joints::Mesh>> structure;
    const auto a = structure.add(wheel(alpha)), b = structure.add(wheel(beta));
    const auto gear = joints::gear(a.vector({0, 0}, {2, 0}), 18, b.vector({0, 0}, {0, 3}), 30,
                                   inside, structure.q(), "drive");
    structure.add(gear);
    CHECK(gear.name() == "gear 'drive'");
    const double ratio = (inside ? 1.0 : -1.0) * 18 / 30;
    for (double turned = -7; turned < 20; turned += 0.37)
      CHECK(std::abs(test::residual(gear, q_of(alpha + turned, beta + ratio * turned))[0]) < 1e-11);
    // Off by a small angle of the first wheel: that angle, in [rad].
    constexpr double small = 1e-5;
    CHECK(test::residual(gear, q_of(alpha + 3 + small, beta + ratio * 3))[0] ==
          Approx(small).epsilon(1e-6));
    // Only the ratio of the angular velocities is left free.
    const VectorXd q = q_of(alpha + 3, beta + ratio * 3);
    VectorXd v = VectorXd::Zero(8);
    v.segment<2>(2) = Vector<2>(-q[3], q[2]);
    v.segment<2>(6) = ratio * Vector<2>(-q[7], q[6]);
    CHECK(test::largest(test::jacobian(gear, q) * v) < 1e-11);
    CHECK(test::jacobian(gear, q).row(0).segment(2, 2).dot(v.segment<2>(2)) ==
          Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("relations refuse what makes no sense, by name", "[mbs]") {
  Structure<ncf::Bar, Relation<Wild>, Relation<joints::Mesh>> structure;
  const auto bar = structure.add(ncf::Bar{.from = {0, 0}, .to = {1, 0}, .density = 1, .area = 1});
  const auto e = bar.vector({0, 0}, {1, 0}), zero = bar.vector({0, 0}, {0, 0});
  using Catch::Contains;
  using test::refusal;
  CHECK(refusal([&] { structure.add(Relation("cam", Index{0, 1, 2}, Wild{})); }).empty());
  CHECK(refusal([&] {
          structure.add(Relation("cam", Index{0, 2, 2}, Wild{}));
        }) == "relation 'cam': coordinate = 2: must be listed once");
  CHECK_THAT(refusal([&] {
               structure.add(Relation("cam", Index{0, 1, 7}, Wild{}));
             }),
             Contains("relation 'cam': coordinate = 7"));
  Marker<2> bad = e;
  bad.N(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal([&] {
               structure.add(Relation("cam", std::vector{bad, e}, Wild{}));
             }),
             Contains("relation 'cam': marker"));
  CHECK_THAT(refusal([&] { joints::gear(e, 0, e, 3, false, structure.q(), "drive"); }),
             Contains("gear 'drive': teeth of a = 0: must be positive"));
  CHECK_THAT(refusal([&] { joints::gear(e, 2, zero, 3, false, structure.q(), "drive"); }),
             Contains("gear 'drive': length of the axis = 0"));
}
