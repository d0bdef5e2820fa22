// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include <sphmbs/mbs/forces/bushing.hpp>

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

template <int Dim, int Points>
forces::Bushing<Dim> some_bushing(FreePoints<Dim, Points>& points) {
  forces::Frame<Dim> from{.origin = points.place(), .vectors = {}}, to = from;
  to.origin = points.place();
  for (auto* frame : {&from, &to})
    for (auto& axis : frame->vectors) axis = points.vector();
  forces::Bushing<Dim> bushing{.from = from, .to = to};
  for (int k = 0; k < Dim; ++k) {
    bushing.stiffness[k] = 10 + k;
    bushing.damping[k] = 1 + k;
    bushing.rest[k] = 0.1 * k;
  }
  for (int k = 0; k < forces::Bushing<Dim>::turns; ++k) {
    bushing.rotational_stiffness[k] = 3 + k;
    bushing.rotational_damping[k] = 0.5 + k;
  }
  return bushing;
}

/// Strains of a bushing, the long way.
template <int Dim, int n, class S>
Vector<Dim + forces::Bushing<Dim>::turns, S> strains(const forces::Bushing<Dim>& b,
                                                     const Vector<n, S>& q) {
  const Vector<Dim, S> d = at(b.to.origin, q) - at(b.from.origin, q);
  std::array<Vector<Dim, S>, static_cast<std::size_t>(Dim)> A, B;
  for (std::size_t k = 0; k < Dim; ++k) {
    A[k] = at(b.from.vectors[k], q);
    B[k] = at(b.to.vectors[k], q);
  }
  Vector<Dim + forces::Bushing<Dim>::turns, S> z;
  for (int k = 0; k < Dim; ++k) z[k] = A[static_cast<std::size_t>(k)].dot(d) - S(b.rest[k]);
  const S half(0.5);
  if constexpr (Dim == 2) {
    z[2] = half * (A[1].dot(B[0]) - A[0].dot(B[1]));
  } else {
    z[3] = half * (A[2].dot(B[1]) - A[1].dot(B[2]));
    z[4] = half * (A[0].dot(B[2]) - A[2].dot(B[0]));
    z[5] = half * (A[1].dot(B[0]) - A[0].dot(B[1]));
  }
  return z;
}

template <int Dim>
void check_bushing(std::uint64_t seed) {
  FreePoints<Dim, 4> points(seed);
  constexpr int n = FreePoints<Dim, 4>::n, turns = forces::Bushing<Dim>::turns;
  const auto bushing = some_bushing(points);
  bushing.check();
  Vector<Dim + turns> k, c;
  k << bushing.stiffness, bushing.rotational_stiffness;
  c << bushing.damping, bushing.rotational_damping;

  const auto energy = [&]<class S>(const Vector<n, S>& q) -> S {
    const auto z = strains<Dim, n, S>(bushing, q);
    S V(0.0);
    for (int i = 0; i < Dim + turns; ++i) V += S(0.5 * k[i]) * z[i] * z[i];
    return V;
  };
  const auto slopes = test::slopes<n>(energy, points.q);
  const auto still = test::assembled<n>(bushing, points.q, Vector<n>::Zero());
  CHECK(still.potential == Approx(energy(points.q)));
  CHECK((still.Q + slopes.gradient).norm() < derivative * still.Q.norm());
  CHECK((still.K + slopes.hessian).norm() < derivative * still.K.norm());

  // Damping: Q = -dz/dq^T c dz/dt.
  const auto moving = test::assembled<n>(bushing, points.q, points.v);
  using D = test::Dual<n>;
  const auto damper = [&](const Vector<n, D>& q) {
    const auto z = strains<Dim, n, test::Dual<n, D>>(bushing, test::dual<n, D>(q));
    Vector<n, D> Q = Vector<n, D>::Constant(D(0.0));
    for (int i = 0; i < Dim + turns; ++i) {
      D speed(0.0);
      for (int j = 0; j < n; ++j) speed += z[i].derivatives()[j] * D(points.v[j]);
      for (int j = 0; j < n; ++j) Q[j] -= D(c[i]) * speed * z[i].derivatives()[j];
    }
    return Q;
  };
  const Vector<n, D> viscous = damper(test::dual<n>(points.q));
  Vector<n> value;
  for (int i = 0; i < n; ++i) value[i] = viscous[i].value();
  CHECK((moving.Q - still.Q - value).norm() < derivative * moving.Q.norm());
  CHECK((moving.K - still.K - test::jacobian<n, n>(viscous)).norm() < derivative * moving.K.norm());
  CHECK((moving.C - moving.C.transpose()).norm() < exact * moving.C.norm());
  CHECK((moving.C * points.v - value).norm() < derivative * moving.C.norm());
  CHECK(moving.dissipation > 0);
  CHECK(points.v.dot(moving.Q) ==
        Approx(-points.v.dot(slopes.gradient) - moving.dissipation).epsilon(1e-10));

  for (int axis = 0; axis < Dim; ++axis)
    CHECK(std::abs(moving.Q.dot(points.translation(axis))) < exact * moving.Q.norm());
  for (const Matrix<Dim, Dim>& W : test::unit_turns<Dim>())
    CHECK(std::abs(moving.Q.dot(points.turned(W, points.q))) < exact * moving.Q.norm());
  const Matrix<Dim, Dim> R = test::some_turn<Dim>();
  const auto turned =
      test::assembled<n>(bushing, points.turned(R, points.q), points.turned(R, points.v));
  CHECK((turned.Q - points.turned(R, moving.Q)).norm() < exact * moving.Q.norm());
}

}  // namespace

TEST_CASE("a bushing pulls with the slope of its energy, and its forces balance", "[mbs]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    check_bushing<2>(seed);
    check_bushing<3>(seed);
  }
}

TEST_CASE("a bushing measures shifts and turns along and about the axes of its first frame",
          "[mbs]") {
  // The second frame has the coordinates: place and axes.
  forces::Frame<3> to{.origin = FreePoints<3, 4>::point(0), .vectors = {}};
  for (int k = 0; k < 3; ++k)
    to.vectors[static_cast<std::size_t>(k)] = FreePoints<3, 4>::point(k + 1);
  const forces::Bushing<3> bushing{
      .to = to, .stiffness = {1, 2, 3}, .rotational_stiffness = {4, 5, 6}, .rest = {1, 0, 0}};
  const auto energy = [&](const Vector<3>& place, const Matrix<3, 3>& R) {
    Vector<12> q;
    q << place, R.col(0), R.col(1), R.col(2);
    return bushing.potential(q, 0);
  };
  const Matrix<3, 3> I = Matrix<3, 3>::Identity();
  CHECK(energy({1, 0, 0}, I) == 0);
  CHECK(energy({1.1, 0, 0}, I) == Approx(0.5 * 1 * 0.01));
  CHECK(energy({1, 0.1, 0}, I) == Approx(0.5 * 2 * 0.01));
  CHECK(energy({1, 0, 0.1}, I) == Approx(0.5 * 3 * 0.01));
  for (int k = 0; k < 3; ++k) {
    const Matrix<3, 3> R = Eigen::AngleAxisd(0.3, Vector<3>::Unit(k)).toRotationMatrix();
    CHECK(energy({1, 0, 0}, R) == Approx(0.5 * (4 + k) * std::sin(0.3) * std::sin(0.3)));
  }
}

TEST_CASE("a planar frame has its second axis a quarter turn from the first", "[mbs]") {
  FreePoints<2, 3> points(1);
  const Marker<2> x = points.vector();
  const forces::Frame<2> frame = forces::frame(points.place(), x);
  CHECK((at(frame.vectors[1], points.q) - quarter_turn(at(x, points.q))).norm() < exact);
  const forces::Frame<2> wall = forces::ground_frame<2>({1, 2}, {3, 4});
  CHECK((wall.vectors[0].x0 - Vector<2>(0.8, -0.6)).norm() < exact);
  CHECK((wall.vectors[1].x0 - Vector<2>(0.6, 0.8)).norm() < exact);
  const forces::Frame<3> slope = forces::ground_frame<3>({1, 2, 3}, {3, 0, 4});
  CHECK((slope.vectors[2].x0 - Vector<3>(0.6, 0, 0.8)).norm() < exact);
  CHECK((slope.vectors[0].x0.cross(slope.vectors[1].x0) - slope.vectors[2].x0).norm() < exact);
  CHECK(test::refusal([] {
          forces::ground_frame<2>({1, 2}, {0, 0});
        }) == "normal = 0 0: must be of positive length");
}

TEST_CASE("a bushing refuses negative stiffness and damping", "[mbs]") {
  using Bushing = forces::Bushing<2>;
  const auto refusal = [](const Bushing& bushing) {
    return test::refusal([&] { bushing.check(); });
  };
  CHECK(refusal({.stiffness = {1, -1}}) == "stiffness =  1 -1: must be zero or positive [N/m]");
  CHECK(refusal({.rotational_stiffness = Vector<1>(-2)}) ==
        "rotational_stiffness = -2: must be zero or positive [N m/rad]");
  CHECK(refusal({.damping = {-1, 0}}) == "damping = -1  0: must be zero or positive [N s/m]");
  CHECK(refusal({.rotational_damping = Vector<1>(-2)}) ==
        "rotational_damping = -2: must be zero or positive [N m s/rad]");
  CHECK(refusal({.rest = {0, std::numeric_limits<double>::quiet_NaN()}}) ==
        "rest =   0 nan: must be finite [m]");
}
