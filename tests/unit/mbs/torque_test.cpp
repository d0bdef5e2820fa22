// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <sphmbs/mbs/forces/couple.hpp>
#include <sphmbs/mbs/forces/torque.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/force_laws.hpp"

namespace {

using namespace sphmbs::mbs;
using test::at;
using test::FreePoints;

constexpr double exact = 1e-12;       // relative, of sums and products
constexpr double derivative = 1e-10;  // relative

/// Sum of the moments about the origin.
template <int Dim, int Points>
Vector<Dim == 2 ? 1 : 3> moment_of(const FreePoints<Dim, Points>& points,
                                   const Vector<Dim * Points>& Q) {
  Vector<Dim == 2 ? 1 : 3> M;
  if constexpr (Dim == 2)
    M[0] = Q.dot(points.turned(test::unit_turns<2>()[0], points.q));
  else
    for (int k = 0; k < 3; ++k)
      M[k] = Q.dot(points.turned(forces::skew(Vector<3>::Unit(k)), points.q));
  return M;
}

template <int Dim, int Points>
void check_no_force(const FreePoints<Dim, Points>& points, const Vector<Dim * Points>& Q) {
  for (int axis = 0; axis < Dim; ++axis)
    CHECK(std::abs(Q.dot(points.translation(axis))) < exact * Q.norm());
}

/// The angle between two vectors about an axis.
template <int Dim, class S>
S angle(const Vector<Dim, S>& from, const Vector<Dim, S>& to, const Vector<Dim, S>& axis) {
  using std::atan2, std::sqrt;
  if constexpr (Dim == 2) {
    return atan2(S(from[0] * to[1] - from[1] * to[0]), S(from.dot(to)));
  } else {
    const Vector<3, S> a = axis / S(sqrt(axis.squaredNorm()));
    const Vector<3, S> x = from - S(from.dot(a)) * a, y = a.cross(x);
    return atan2(S(to.dot(y)), S(to.dot(x)));
  }
}

/// A torque is M times the gradient of the angle.
template <int Dim, int n>
void check_gradient(const forces::Torque<Dim>& torque, const Vector<n>& q) {
  const auto turned = [&]<class S>(const Vector<n, S>& x) -> S {
    return angle<Dim, S>(at(torque.against, x), at(torque.on, x), at(torque.axis, x));
  };
  const auto slopes = test::slopes<n>(turned, q);
  const auto now = test::assembled<n>(torque, q, Vector<n>::Zero());
  CHECK((now.Q - torque.value * slopes.gradient).norm() < derivative * now.Q.norm());
  CHECK((now.K - torque.value * slopes.hessian).norm() < derivative * now.K.norm());
}

}  // namespace

TEST_CASE("a torque is the gradient of the angle, with its reaction on the other part", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    FreePoints<2, 4> plane(seed);
    const forces::Torque<2> planar{.on = plane.vector(), .against = plane.vector(), .value = 3};
    planar.check();
    check_gradient(planar, plane.q);
    const auto Q2 = test::assembled<8>(planar, plane.q, plane.v).Q;
    check_no_force(plane, Q2);
    CHECK(moment_of(plane, Q2).norm() < exact * Q2.norm());

    FreePoints<3, 4> space(seed);
    const forces::Torque<3> spatial{
        .on = space.vector(), .against = space.vector(), .axis = space.vector(), .value = 3};
    spatial.check();
    check_gradient(spatial, space.q);
    const auto Q3 = test::assembled<12>(spatial, space.q, space.v).Q;
    check_no_force(space, Q3);
    CHECK(moment_of(space, Q3).norm() < 10 * exact * Q3.norm());
  }
}

TEST_CASE("a torque against the ground turns one part with the whole moment", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    FreePoints<2, 4> plane(seed);
    const forces::Torque<2> planar{.on = plane.vector(), .value = -2};
    const auto now2 = test::assembled<8>(planar, plane.q, plane.v);
    check_no_force(plane, now2.Q);
    CHECK(moment_of(plane, now2.Q)[0] == Approx(-2).epsilon(1e-11));
    auto fixed = planar;
    fixed = {.on = planar.on, .against = ground<2>({0.3, -2}), .value = -2};
    check_gradient(fixed, plane.q);

    // About an axis of the part itself, which turns with it.
    FreePoints<3, 4> space(seed);
    const forces::Torque<3> spatial{.on = space.vector(), .axis = space.vector(), .value = -2};
    spatial.check();
    const auto now3 = test::assembled<12>(spatial, space.q, space.v);
    const Vector<3> M = -2 * at(spatial.axis, space.q).normalized();
    check_no_force(space, now3.Q);
    CHECK((moment_of(space, now3.Q) - M).norm() < 1e-11 * now3.Q.norm());

    const auto reference = [&]<class S>(const Vector<12, S>& q) {
      using std::sqrt;
      const Vector<3, S> a = at(spatial.axis, q), u = at(spatial.on, q), p = a.cross(u);
      const S a2 = a.squaredNorm(), strength = S(-2.0) * sqrt(a2) / p.squaredNorm();
      const Vector<3, S> on_u = strength * p, on_a = S(-(a.dot(u) / a2)) * on_u;
      Vector<12, S> Q = Vector<12, S>::Constant(S(0.0));
      test::pull_back(spatial.on, on_u, Q);
      test::pull_back(spatial.axis, on_a, Q);
      return Q;
    };
    CHECK((now3.Q - reference(space.q)).norm() < derivative * now3.Q.norm());
    CHECK((now3.K - test::jacobian<12, 12>(reference(test::dual<12>(space.q)))).norm() <
          derivative * now3.K.norm());
  }
}

TEST_CASE("the work of a torque over a full turn is 2 pi M", "[mbs]") {
  const double pi = std::numbers::pi;
  const int steps = 64;
  const forces::Torque<2> planar{.on = FreePoints<2, 1>::point(0), .value = 1.5};
  const Vector<3> axis(1, 2, -1);
  const forces::Torque<3> spatial{
      .on = FreePoints<3, 1>::point(0), .axis = ground<3>(axis), .value = 1.5};
  double work2 = 0, work3 = 0;
  for (int k = 0; k < steps; ++k) {
    const double phi = 2 * pi * k / steps;
    const Vector<2> u = Eigen::Rotation2Dd(phi) * Vector<2>(3, 1);
    work2 += test::assembled<2>(planar, u, u).Q.dot(quarter_turn(u)) * 2 * pi / steps;
    const Vector<3> w = Eigen::AngleAxisd(phi, axis.normalized()) * Vector<3>(0.4, 1, 2);
    work3 += test::assembled<3>(spatial, w, w).Q.dot(axis.normalized().cross(w)) * 2 * pi / steps;
  }
  CHECK(std::abs(work2 - 3 * pi) < 1e-12);
  CHECK(std::abs(work3 - 3 * pi) < 1e-12);
}

TEST_CASE("a torque may change in time", "[mbs]") {
  const forces::Torque<2> torque{.on = FreePoints<2, 1>::point(0),
                                 .history = [](double t) { return 3 * t; }};
  CHECK(test::assembled<2>(torque, Vector<2>(2, 0), Vector<2>(0, 0), 2).Q[1] == Approx(3));
}

TEST_CASE("a couple does the work of a moment on the turning of its part", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    FreePoints<3, 4> points(seed);
    constexpr int n = 12;
    forces::Couple couple{.u = points.vector(), .w = points.vector(), .value = {1, -2, 0.5}};
    couple.check();
    const auto now = test::assembled<n>(couple, points.q, points.v);
    check_no_force(points, now.Q);
    CHECK((moment_of(points, now.Q) - couple.value).norm() < 1e-11 * now.Q.norm());

    // Q_k = m . omega for unit rates of each coordinate, where omega = sum e_i x e_i' / 2 of the
    // triad e_i of the two vectors.
    const auto reference = [&]<class S>(const Vector<n, S>& place) {
      using std::sqrt;
      using T = test::Dual<n, S>;
      const Vector<n, T> q = test::dual<n, S>(place);
      Vector<3, T> e1 = at(couple.u, q);
      e1 /= T(sqrt(e1.squaredNorm()));
      Vector<3, T> e3 = e1.cross(at(couple.w, q));
      e3 /= T(sqrt(e3.squaredNorm()));
      const Vector<3, T> e2 = e3.cross(e1);
      Vector<n, S> Q;
      for (int k = 0; k < n; ++k) {
        Vector<3, S> omega = Vector<3, S>::Constant(S(0.0));
        for (const Vector<3, T>& e : std::array<Vector<3, T>, 3>{e1, e2, e3}) {
          Vector<3, S> value, slope;
          for (int i = 0; i < 3; ++i) {
            value[i] = e[i].value();
            slope[i] = e[i].derivatives()[k];
          }
          omega += S(0.5) * value.cross(slope);
        }
        Q[k] = S(couple.value[0]) * omega[0] + S(couple.value[1]) * omega[1] +
               S(couple.value[2]) * omega[2];
      }
      return Q;
    };
    CHECK((now.Q - reference(points.q)).norm() < derivative * now.Q.norm());
    CHECK((now.K - test::jacobian<n, n>(reference(test::dual<n>(points.q)))).norm() <
          derivative * now.K.norm());

    const forces::Couple between{.u = couple.u,
                                 .w = couple.w,
                                 .against_u = points.vector(),
                                 .against_w = points.vector(),
                                 .value = couple.value};
    const auto both = test::assembled<n>(between, points.q, points.v);
    check_no_force(points, both.Q);
    CHECK(moment_of(points, both.Q).norm() < 1e-11 * both.Q.norm());
    const forces::Couple reaction{
        .u = between.against_u, .w = between.against_w, .value = -couple.value};
    const auto other = test::assembled<n>(reaction, points.q, points.v);
    CHECK((both.Q - now.Q - other.Q).norm() < exact * both.Q.norm());
    CHECK((both.K - now.K - other.K).norm() < exact * both.K.norm());
  }
}

TEST_CASE("torques and couples without vectors, or not finite, are refused", "[mbs]") {
  const Marker<3> x = ground<3>({1, 0, 0}), y = ground<3>({0, 1, 0});
  const auto torque = [](const forces::Torque<3>& t) { return test::refusal([&] { t.check(); }); };
  CHECK(torque({.on = x, .axis = y, .value = 1}).empty());
  CHECK(torque({.on = x, .value = 1}) == "axis = zero: must be a vector");
  CHECK(torque({.axis = x, .value = 1}) == "on = zero: must be a vector of a part");
  CHECK(torque({.on = x, .axis = y, .value = std::numeric_limits<double>::infinity()}) ==
        "value = inf: must be finite [N m]");
  const auto couple = [](const forces::Couple& c) { return test::refusal([&] { c.check(); }); };
  CHECK(couple({.u = x}) == "u, w = zero: must be two vectors of a part");
  CHECK(couple({.u = x, .w = y, .against_u = x}) ==
        "against_u, against_w = one of them zero: must be two vectors of a part, or none");
  const forces::Torque<3> along{.on = FreePoints<3, 1>::point(0), .axis = x, .value = 1};
  CHECK(test::complaint<sphmbs::NumericalFailure>(
            [&] { test::assembled<3>(along, Vector<3>(2, 0, 0), Vector<3>(0, 0, 0)); }) ==
        "torque: the part across its axis of a vector that it turns has no length, and the force "
        "no direction");
}
