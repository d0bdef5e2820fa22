// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include <sphmbs/mbs/forces/spring_damper.hpp>
#include <sphmbs/mbs/forces/torsion_spring.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/force_laws.hpp"

namespace {

using namespace sphmbs::mbs;
using test::at;
using test::FreePoints;
using test::rate;

constexpr double exact = 1e-12;       // relative, of sums and products
constexpr double derivative = 1e-10;  // relative

/// Internal forces leave the sum of forces and of moments at zero.
template <int Dim, int Points>
void check_action_is_reaction(const FreePoints<Dim, Points>& points,
                              const Vector<Dim * Points>& Q) {
  for (int axis = 0; axis < Dim; ++axis)
    CHECK(std::abs(Q.dot(points.translation(axis))) < exact * Q.norm());
  for (const Matrix<Dim, Dim>& W : test::unit_turns<Dim>())
    CHECK(std::abs(Q.dot(points.turned(W, points.q))) < exact * Q.norm() * points.q.norm());
}

template <int Dim>
void check_spring(std::uint64_t seed) {
  FreePoints<Dim, 4> points(seed);
  constexpr int n = FreePoints<Dim, 4>::n;
  const forces::SpringDamper<Dim> spring{.from = points.place(),
                                         .to = points.place(),
                                         .stiffness = 30,
                                         .damping = 2.5,
                                         .natural_length = 0.4};
  spring.check();
  const auto energy = [&]<class S>(const Vector<n, S>& q) -> S {
    using std::sqrt;
    const Vector<Dim, S> d = at(spring.to, q) - at(spring.from, q);
    const S length = sqrt(d.squaredNorm());
    return S(15.0) * (length - S(0.4)) * (length - S(0.4));
  };
  const auto length_rate = [&]<class S>(const Vector<n, S>& q, const Vector<n, S>& v) -> S {
    using std::sqrt;
    const Vector<Dim, S> d = at(spring.to, q) - at(spring.from, q);
    return d.dot(Vector<Dim, S>(rate(spring.to, v) - rate(spring.from, v))) / sqrt(d.squaredNorm());
  };

  const auto still = test::assembled<n>(spring, points.q, Vector<n>::Zero());
  const auto slopes = test::slopes<n>(energy, points.q);
  CHECK(std::abs(still.potential - energy(points.q)) < exact * still.potential);
  CHECK((still.Q + slopes.gradient).norm() < derivative * slopes.gradient.norm());
  CHECK((still.K + slopes.hessian).norm() < derivative * slopes.hessian.norm());
  CHECK(still.dissipation == 0);

  // The damper's part, on top: -c l' dl/dq, where dl/dq = dl'/dv.
  const auto moving = test::assembled<n>(spring, points.q, points.v);
  using D = test::Dual<n>;
  const Vector<n, D> q = test::dual<n>(points.q), v = test::dual<n>(points.v);
  const D by_q = length_rate(q, test::constant<D, n>(points.v));
  const D by_v = length_rate(test::constant<D, n>(points.q), v);
  const Vector<n> dl = by_v.derivatives();
  CHECK((moving.Q - still.Q + 2.5 * by_v.value() * dl).norm() < derivative * moving.Q.norm());
  CHECK((moving.C + 2.5 * dl * dl.transpose()).norm() < derivative * moving.C.norm());
  const auto damper = [&](const Vector<n, D>& x) {
    Vector<n, D> Q;
    const D c = length_rate(x, test::constant<D, n>(points.v));
    for (int k = 0; k < n; ++k)
      Q[k] = D(-2.5) * c * length_rate(x, test::constant<D, n>(Vector<n>::Unit(k)));
    return Q;
  };
  CHECK((moving.K - still.K - test::jacobian<n, n>(damper(q))).norm() <
        derivative * moving.K.norm());
  CHECK(by_q.value() == Approx(by_v.value()));

  // Power: v . Q = -dV/dt - D.
  CHECK(moving.dissipation == Approx(2.5 * by_v.value() * by_v.value()));
  CHECK(points.v.dot(moving.Q) ==
        Approx(-points.v.dot(slopes.gradient) - moving.dissipation).epsilon(1e-10));
  check_action_is_reaction(points, moving.Q);
}

template <int Dim>
void check_torsion_spring(std::uint64_t seed) {
  FreePoints<Dim, 4> points(seed);
  constexpr int n = FreePoints<Dim, 4>::n;
  const forces::TorsionSpring<Dim> spring{.from = points.vector(),
                                          .to = points.vector(),
                                          .axis = Dim == 3 ? points.vector() : Marker<Dim>{},
                                          .stiffness = 30,
                                          .damping = 2.5,
                                          .natural_angle = 0.2};
  spring.check();
  const auto angle = [&]<class S>(const Vector<n, S>& q) -> S {
    using std::atan2, std::sqrt;
    const Vector<Dim, S> u = at(spring.from, q), w = at(spring.to, q);
    if constexpr (Dim == 2) {
      return atan2(S(u[0] * w[1] - u[1] * w[0]), S(u[0] * w[0] + u[1] * w[1]));
    } else {
      // Right-handed axes: the axis, u without its share along the axis, and their product.
      Vector<3, S> a = at(spring.axis, q);
      a /= S(sqrt(a.squaredNorm()));
      const Vector<3, S> x = u - S(u.dot(a)) * a, y = a.cross(x);
      return atan2(S(w.dot(y)), S(w.dot(x)));
    }
  };
  const double turned = std::remainder(angle(points.q) - 0.2, 2 * std::numbers::pi);
  CHECK(std::abs(spring.deflection(points.q(spring.index())) - turned) < exact);
  const auto slopes = test::slopes<n>(angle, points.q);
  const Vector<n> g = slopes.gradient;
  const Matrix<n, n> H = slopes.hessian;
  const double speed = g.dot(points.v), moment = 30 * turned + 2.5 * speed;
  const auto now = test::assembled<n>(spring, points.q, points.v);
  const Matrix<n, n> K = -(30 * g + 2.5 * H * points.v) * g.transpose() - moment * H;
  const Vector<n> Q = -moment * g;
  CHECK((now.Q - Q).norm() < derivative * Q.norm());
  CHECK((now.K - K.transpose()).norm() < derivative * K.norm());
  CHECK((now.C + 2.5 * g * g.transpose()).norm() < derivative * now.C.norm());
  CHECK(now.potential == Approx(15 * turned * turned));
  CHECK(now.dissipation == Approx(2.5 * speed * speed));
  CHECK(points.v.dot(now.Q) == Approx(-30 * turned * speed - now.dissipation).epsilon(1e-10));
  check_action_is_reaction(points, now.Q);
}

}  // namespace

TEST_CASE("a spring and damper pull along their line with the slope of their energy", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    check_spring<2>(seed);
    check_spring<3>(seed);
  }
}

TEST_CASE("a spring of zero length is linear in the distance", "[mbs]") {
  FreePoints<3, 2> points(3);
  const forces::SpringDamper<3> spring{
      .from = points.point(0), .to = points.point(1), .stiffness = 7, .natural_length = 0};
  const auto now = test::assembled<6>(spring, points.q, Vector<6>::Zero());
  const Vector<3> d = points.q.tail<3>() - points.q.head<3>();
  CHECK((now.Q.tail<3>() + 7 * d).norm() < exact * now.Q.norm());
  Matrix<6, 6> K;
  K << Matrix<3, 3>::Identity(), -Matrix<3, 3>::Identity(), -Matrix<3, 3>::Identity(),
      Matrix<3, 3>::Identity();
  CHECK((now.K + 7 * K).norm() < exact * now.K.norm());
}

TEST_CASE("a spring may have a law of its user, with energy and damping", "[mbs]") {
  // T = k x + k3 x^3 + c l'^3 with x = l - 0.3.
  const auto law = [](double l, double rate) {
    const double x = l - 0.3;
    return forces::Tension{.force = 5 * x + 40 * x * x * x + 0.5 * rate * rate * rate,
                           .by_length = 5 + 120 * x * x,
                           .by_rate = 1.5 * rate * rate,
                           .energy = 2.5 * x * x + 10 * x * x * x * x,
                           .dissipation = 0.5 * rate * rate * rate * rate};
  };
  FreePoints<2, 3> points(5);
  constexpr int n = 6;
  const forces::SpringDamper<2> spring{.from = points.place(), .to = points.place(), .law = law};
  spring.check();
  const auto reference = [&]<class S>(const Vector<n, S>& q, const Vector<n, S>& v) {
    using std::sqrt;
    const Vector<2, S> d = at(spring.to, q) - at(spring.from, q);
    const Vector<2, S> velocity = rate(spring.to, v) - rate(spring.from, v);
    const S l = sqrt(d.squaredNorm()), x = l - S(0.3), speed = d.dot(velocity) / l;
    const S T = S(5.0) * x + S(40.0) * x * x * x + S(0.5) * speed * speed * speed;
    const Vector<2, S> F = S(T / l) * d;
    Vector<n, S> Q = Vector<n, S>::Constant(S(0.0));
    test::pull_back(spring.from, F, Q);
    test::pull_back(spring.to, Vector<2, S>(-F), Q);
    return Q;
  };
  using D = test::Dual<n>;
  const auto now = test::assembled<n>(spring, points.q, points.v);
  const auto still = test::assembled<n>(spring, points.q, Vector<n>::Zero());
  const auto by_q = reference(test::dual<n>(points.q), test::constant<D, n>(points.v));
  const auto by_v = reference(test::constant<D, n>(points.q), test::dual<n>(points.v));
  CHECK((now.Q - reference(points.q, points.v)).norm() < derivative * now.Q.norm());
  CHECK((now.K - test::jacobian<n, n>(by_q)).norm() < derivative * now.K.norm());
  CHECK((now.C - test::jacobian<n, n>(by_v)).norm() < derivative * now.C.norm());
  CHECK(now.dissipation >= 0);
  CHECK(points.v.dot(now.Q) == Approx(points.v.dot(still.Q) - now.dissipation).epsilon(1e-10));
}

TEST_CASE("ends of a spring that meet are refused, as is bad input", "[mbs][fault]") {
  using Spring = forces::SpringDamper<2>;
  const Marker<2> a = FreePoints<2, 2>::point(0), b = FreePoints<2, 2>::point(1);
  const auto refusal = [](const Spring& spring) { return test::refusal([&] { spring.check(); }); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal({.from = a, .to = b, .stiffness = 1, .natural_length = 1}).empty());
  CHECK(refusal({.from = a, .to = b, .damping = 1}).empty());
  CHECK(refusal({.from = a, .to = b, .stiffness = -1, .natural_length = 1}) ==
        "stiffness = -1: must be zero or positive [N/m]");
  CHECK(refusal({.from = a, .to = b, .stiffness = nan, .natural_length = 1}) ==
        "stiffness = nan: must be zero or positive [N/m]");
  CHECK(refusal({.from = a, .to = b, .damping = -0.5, .natural_length = 1}) ==
        "damping = -0.5: must be zero or positive [N s/m]");
  CHECK(refusal({.from = a, .to = b, .stiffness = 1}) ==
        "natural_length = nan: must be given, zero or positive [m]");
  CHECK(refusal({.from = a, .to = a, .stiffness = 1, .natural_length = 0}) ==
        "distance of its ends = 0: must be positive for some coordinates, as the force has no "
        "direction else [m]");

  const Spring spring{.from = a, .to = b, .stiffness = 1, .natural_length = 0, .label = "spring 4"};
  CHECK(test::complaint<sphmbs::NumericalFailure>([&] {
          test::assembled<4>(spring, Vector<4>(1, 2, 1, 2), Vector<4>::Zero());
        }) == "spring 4: the line between its ends has no length, and the force no direction");
}

TEST_CASE("a torsion spring turns with the slope of its energy", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    check_torsion_spring<2>(seed);
    check_torsion_spring<3>(seed);
  }
}

TEST_CASE("the deflection of a torsion spring is measured from its natural angle", "[mbs]") {
  const double pi = std::numbers::pi;
  const Marker<2> u = FreePoints<2, 1>::point(0);
  const auto deflection = [&](double natural, double angle) {
    const forces::TorsionSpring<2> spring{
        .from = ground<2>({1, 0}), .to = u, .stiffness = 1, .natural_angle = natural};
    return spring.deflection(Vector<2>(std::cos(angle), std::sin(angle)));
  };
  CHECK(std::abs(deflection(0, 1) - 1) < exact);
  CHECK(std::abs(deflection(pi, pi - 0.5) + 0.5) < exact);
  CHECK(std::abs(deflection(pi, -pi + 0.5) - 0.5) < exact);
  CHECK(std::abs(deflection(3, -3) - (2 * pi - 6)) < exact);
  CHECK(std::abs(deflection(-2, 1) - 3) < exact);

  using Spring = forces::TorsionSpring<3>;
  const auto refusal = [](const Spring& spring) { return test::refusal([&] { spring.check(); }); };
  const Marker<3> x = ground<3>({1, 0, 0}), y = ground<3>({0, 1, 0});
  CHECK(refusal({.from = x, .to = y}) == "axis = zero: must be a vector");
  CHECK(refusal({.from = x, .axis = x}) == "to = zero: must be a vector");
  CHECK(refusal({.from = x, .to = y, .axis = x, .stiffness = -1}) ==
        "stiffness = -1: must be zero or positive [N m/rad]");
  CHECK(refusal({.from = x, .to = y, .axis = x, .damping = -1}) ==
        "damping = -1: must be zero or positive [N m s/rad]");
}
