// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <type_traits>

#include <sphmbs/mbs/forces/follower_force.hpp>
#include <sphmbs/mbs/forces/point_force.hpp>
#include <sphmbs/mbs/forces/user_force.hpp>

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
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
void check_follower(std::uint64_t seed) {
  FreePoints<Dim, 4> points(seed);
  constexpr int n = FreePoints<Dim, 4>::n;
  forces::FollowerForce<Dim> force{
      .at = points.place(), .along = points.vector(), .beside = points.vector()};
  for (int k = 0; k < Dim; ++k) force.value[k] = points.random.between(-1, 1);
  force.check();
  const auto reference = [&]<class S>(const Vector<n, S>& q) {
    using std::sqrt;
    Vector<Dim, S> e1 = at(force.along, q), F;
    e1 /= S(sqrt(e1.squaredNorm()));
    if constexpr (Dim == 2) {
      F = S(force.value[0]) * e1 + S(force.value[1]) * Vector<2, S>(-e1[1], e1[0]);
    } else {
      const Vector<3, S> w = at(force.beside, q);
      Vector<3, S> e2 = w - S(w.dot(e1)) * e1;
      e2 /= S(sqrt(e2.squaredNorm()));
      const Vector<3, S> e3 = e1.cross(e2);
      F = S(force.value[0]) * e1 + S(force.value[1]) * e2 + S(force.value[2]) * e3;
    }
    Vector<n, S> Q = Vector<n, S>::Constant(S(0.0));
    test::pull_back(force.at, F, Q);
    return Q;
  };
  const auto now = test::assembled<n>(force, points.q, points.v);
  CHECK((now.Q - reference(points.q)).norm() < exact * now.Q.norm());
  CHECK((now.K - test::jacobian<n, n>(reference(test::dual<n>(points.q)))).norm() <
        derivative * now.K.norm());
  CHECK(now.C.isZero(0.0));
  CHECK((now.K - now.K.transpose()).norm() > 0.01 * now.K.norm());

  // The force turns with the part, and its work at the point is that of its components.
  const Matrix<Dim, Dim> R = test::some_turn<Dim>();
  const auto turned = test::assembled<n>(force, points.turned(R, points.q), points.v);
  CHECK((turned.Q - points.turned(R, now.Q)).norm() < exact * now.Q.norm());
}

/// V = |x|^4 / 2, with linear damping.
struct Well {
  void operator()(const auto& x, const auto& v, double, auto& F) const {
    F = -2.0 * x.squaredNorm() * x - 0.5 * v;
  }
  double potential(const Vector<3>& x, double) const {
    return 0.5 * x.squaredNorm() * x.squaredNorm();
  }
  double dissipation(const Vector<3>&, const Vector<3>& v, double) const {
    return 0.5 * v.squaredNorm();
  }
};

}  // namespace

TEST_CASE("a point force is dead: constant, with the potential -F . x", "[mbs]") {
  FreePoints<3, 3> points(1);
  constexpr int n = 9;
  forces::PointForce<3> force{.at = points.place(), .value = {1, -2, 3}};
  const auto now = test::assembled<n>(force, points.q, points.v);
  const auto energy = [&]<class S>(const Vector<n, S>& q) -> S {
    return -(at(force.at, q).dot(Vector<3, S>(S(1.0), S(-2.0), S(3.0))));
  };
  CHECK((now.Q + test::slopes<n>(energy, points.q).gradient).norm() < exact * now.Q.norm());
  CHECK(now.potential == Approx(energy(points.q)));
  CHECK(now.K.isZero(0.0));
  // The sum of its forces is the force.
  for (int axis = 0; axis < 3; ++axis)
    CHECK(std::abs(now.Q.dot(points.translation(axis)) - force.value[axis]) < exact);

  force.history = [](double t) { return Vector<3>(0, std::sin(t), 0); };
  const auto later = test::assembled<n>(force, points.q, points.v, 0.5);
  CHECK(std::abs(later.Q.dot(points.translation(1)) - std::sin(0.5)) < exact);
  CHECK(later.potential == 0);

  force.value[1] = not_a_number;
  CHECK(test::refusal([&] { force.check(); }) == "value =   1 nan   3: must be finite [N]");
}

TEST_CASE("a force on a coordinate is that of its marker", "[mbs]") {
  const forces::PointForce<1> force{.at = forces::coordinates<1>({2}), .value = Vector<1>(5)};
  CHECK(test::assembled<4>(force, Vector<4>::Zero(), Vector<4>::Zero()).Q ==
        5 * Vector<4>::Unit(2));
}

TEST_CASE("a follower force turns with its vectors, and its tangent is exact", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    check_follower<2>(seed);
    check_follower<3>(seed);
  }
}

TEST_CASE("a follower force along one vector needs no other", "[mbs]") {
  FreePoints<3, 4> points(3);
  forces::FollowerForce<3> force{
      .at = points.place(), .along = points.vector(), .value = {2, 0, 0}};
  force.check();
  const auto now = test::assembled<12>(force, points.q, points.v);
  Vector<12> Q = Vector<12>::Zero();
  test::pull_back<3, 12, double>(force.at, 2 * at(force.along, points.q).normalized(), Q);
  CHECK((now.Q - Q).norm() < exact * Q.norm());
  CHECK(now.K.allFinite());

  force.value[2] = 1;
  CHECK(test::refusal([&] { force.check(); }) ==
        "beside = zero: must be a second vector, for a force that is not along the first");
  force.along = {};
  CHECK(test::refusal([&] { force.check(); }) ==
        "along = zero: must be a vector that the force turns with");
  const forces::FollowerForce<2> lost{.along = FreePoints<2, 1>::point(0), .value = {1, 0}};
  CHECK(test::complaint<sphmbs::NumericalFailure>([&] {
          test::assembled<2>(lost, Vector<2>(0, 0), Vector<2>(0, 0));
        }) == "follower force: the vector along it has no length, and the force no direction");
}

TEST_CASE("a user's force is differentiated, or brings its tangent", "[mbs]") {
  FreePoints<2, 3> points(7);
  constexpr int n = 6;
  // Drag that grows with the square of the speed, and with the height.
  const double at_start = 0.3;
  const auto drag = [at_start](const auto& x, const auto& v, double t, auto& F) {
    using std::sqrt;
    F = -(at_start + t) * x[1] * sqrt(v.squaredNorm() + 1e-6) * v;
  };
  const auto tangent = [](const Vector<2>& x, const Vector<2>& v, double t, Matrix<2, 2>& k,
                          Matrix<2, 2>& c) {
    const double speed = std::sqrt(v.squaredNorm() + 1e-6);
    k.col(1) = -(0.3 + t) * speed * v;
    c = -(0.3 + t) * x[1] * (speed * Matrix<2, 2>::Identity() + v * v.transpose() / speed);
  };
  const Marker<2> on = points.place();
  const auto dual = forces::user_force(on, drag);
  const auto given = forces::user_force(on, drag, tangent, "drag");
  static_assert(Force<std::remove_const_t<decltype(dual)>>);
  static_assert(Force<std::remove_const_t<decltype(given)>>);
  dual.check();
  CHECK(given.name() == "drag");
  const double t = 0.2;
  const auto a = test::assembled<n>(dual, points.q, points.v, t);
  const auto b = test::assembled<n>(given, points.q, points.v, t);
  CHECK(a.Q == b.Q);
  CHECK((a.K - b.K).norm() < exact * a.K.norm());
  CHECK((a.C - b.C).norm() < exact * a.C.norm());
  CHECK(a.K.norm() > 0.01);
  CHECK(a.C.norm() > 0.01);

  // As a law on the coordinates, differentiated by the test.
  using D = test::Dual<n>;
  const auto all = [&]<class S>(const Vector<n, S>& q, const Vector<n, S>& v) {
    Vector<2, S> F;
    drag(at(on, q), rate(on, v), t, F);
    Vector<n, S> Q = Vector<n, S>::Constant(S(0.0));
    test::pull_back(on, F, Q);
    return Q;
  };
  const auto by_q = all(test::dual<n>(points.q), test::constant<D, n>(points.v));
  CHECK((a.K - test::jacobian<n, n>(by_q)).norm() < derivative * a.K.norm());
}

TEST_CASE("a user's force may have energy and damping", "[mbs]") {
  FreePoints<3, 3> points(8);
  const auto force = forces::user_force(points.place(), Well{});
  const auto now = test::assembled<9>(force, points.q, points.v);
  const auto energy = [&]<class S>(const Vector<9, S>& q) -> S {
    const S r2 = at(force.on, q).squaredNorm();
    return S(0.5) * r2 * r2;
  };
  const auto slopes = test::slopes<9>(energy, points.q);
  CHECK(now.potential == Approx(energy(points.q)));
  CHECK(points.v.dot(now.Q) ==
        Approx(-points.v.dot(slopes.gradient) - now.dissipation).epsilon(1e-10));
  CHECK((now.K + slopes.hessian).norm() < derivative * now.K.norm());

  const auto nowhere = forces::user_force(ground<3>({1, 2, 3}), Well{});
  CHECK(test::refusal([&] { nowhere.check(); }) ==
        "coordinates of its marker = 0: must be one or more");
}
