// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include <sphmbs/mbs/forces/contact.hpp>

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

using forces::Contact;
using forces::Penalty;
using forces::Plane;
using forces::Sphere;

/// Depth in the frame of the surface.
template <int Dim, class S>
S depth(const Plane<Dim>&, const Vector<Dim, S>& x, double radius) {
  return S(radius) - x[Dim - 1];
}
template <int Dim, class S>
S depth(const Sphere<Dim>& sphere, const Vector<Dim, S>& x, double radius) {
  using std::sqrt;
  return S(radius + sphere.radius) - S(sqrt(x.squaredNorm()));
}
template <int Dim, class S>
Vector<Dim, S> normal(const Plane<Dim>&, const Vector<Dim, S>&) {
  Vector<Dim, S> n = Vector<Dim, S>::Constant(S(0.0));
  n[Dim - 1] = S(1.0);
  return n;
}
template <int Dim, class S>
Vector<Dim, S> normal(const Sphere<Dim>&, const Vector<Dim, S>& x) {
  using std::sqrt;
  return x / S(sqrt(x.squaredNorm()));
}

/// The law of contact as text books have it.
template <class Surface, int n, class S>
Vector<n, S> reference(const Contact<Surface>& contact, const Vector<n, S>& q,
                       const Vector<n, S>& v) {
  using std::pow, std::sqrt;
  constexpr int Dim = Surface::dim;
  const Vector<Dim, S> d = at(contact.point, q) - at(contact.frame.origin, q);
  const Vector<Dim, S> d_rate = rate(contact.point, v) - rate(contact.frame.origin, v);
  Vector<Dim, S> x, x_rate;
  std::array<Vector<Dim, S>, static_cast<std::size_t>(Dim)> a;
  for (std::size_t k = 0; k < Dim; ++k) {
    a[k] = at(contact.frame.vectors[k], q);
    x[static_cast<int>(k)] = a[k].dot(d);
    x_rate[static_cast<int>(k)] = a[k].dot(d_rate) + rate(contact.frame.vectors[k], v).dot(d);
  }
  Vector<n, S> Q = Vector<n, S>::Constant(S(0.0));
  const S delta = depth<Dim, S>(contact.surface, x, contact.radius);
  if (!(delta > S(0.0))) return Q;
  const Vector<Dim, S> outward = normal<Dim, S>(contact.surface, x);
  const S approach = -outward.dot(x_rate);
  const S factor = S(1.0) + S(contact.law.damping) * approach;
  if (!(factor > S(0.0))) return Q;
  const S N = S(contact.law.stiffness) * pow(delta, contact.law.exponent) * factor;
  const Vector<Dim, S> slip = x_rate + approach * outward;
  const S speed = sqrt(slip.squaredNorm() + S(contact.creep_velocity * contact.creep_velocity));
  const Vector<Dim, S> F = N * (outward - S(S(contact.friction) / speed) * slip);
  // Its work is F . dx, and x_i = a_i . d.
  for (std::size_t k = 0; k < Dim; ++k) {
    const S f = F[static_cast<int>(k)];
    test::pull_back(contact.point, Vector<Dim, S>(f * a[k]), Q);
    test::pull_back(contact.frame.origin, Vector<Dim, S>(-f * a[k]), Q);
    test::pull_back(contact.frame.vectors[k], Vector<Dim, S>(f * d), Q);
  }
  return Q;
}

/// Checks derivatives, balance of forces and of power; says whether there was contact.
template <class Surface>
bool check_contact(std::uint64_t seed, const Surface& surface, const Penalty& law,
                   double friction) {
  constexpr int Dim = Surface::dim;
  FreePoints<Dim, 4> points(seed);
  constexpr int n = FreePoints<Dim, 4>::n;
  forces::Frame<Dim> frame{.origin = points.place(), .vectors = {}};
  for (auto& axis : frame.vectors) axis = points.vector();
  const Contact<Surface> contact{.point = points.place(),
                                 .radius = 0.3,
                                 .frame = frame,
                                 .surface = surface,
                                 .law = law,
                                 .friction = friction,
                                 .creep_velocity = 0.2};
  contact.check();
  const auto now = test::assembled<n>(contact, points.q, points.v);
  CHECK((now.Q - reference(contact, points.q, points.v)).norm() <= derivative * now.Q.norm());
  const bool touching = now.Q.norm() > 0;

  using D = test::Dual<n>;
  const Matrix<n, n> K = test::jacobian<n, n>(
      reference(contact, test::dual<n>(points.q), test::constant<D, n>(points.v)));
  const Matrix<n, n> C = test::jacobian<n, n>(
      reference(contact, test::constant<D, n>(points.q), test::dual<n>(points.v)));
  if (touching) {
    CHECK((now.K - K).norm() < derivative * K.norm());
    CHECK((now.C - C).norm() <= derivative * C.norm());
  } else {
    CHECK(now.K.isZero(0.0));
    CHECK(now.C.isZero(0.0));
  }

  // v . Q = -dV/dt - D, also while the surface lets go.
  const auto elastic = test::assembled<n>(
      Contact<Surface>{.point = contact.point,
                       .radius = contact.radius,
                       .frame = contact.frame,
                       .surface = surface,
                       .law = {.stiffness = law.stiffness, .exponent = law.exponent}},
      points.q, points.v);
  CHECK(now.potential == elastic.potential);
  CHECK(now.dissipation >= 0);
  CHECK(std::abs(points.v.dot(now.Q) - points.v.dot(elastic.Q) + now.dissipation) <=
        derivative * (elastic.Q.norm() + now.Q.norm()) * points.v.norm());

  for (int axis = 0; axis < Dim; ++axis)
    CHECK(std::abs(now.Q.dot(points.translation(axis))) <= exact * now.Q.norm());
  for (const Matrix<Dim, Dim>& W : test::unit_turns<Dim>())
    CHECK(std::abs(now.Q.dot(points.turned(W, points.q))) <= exact * now.Q.norm());
  return touching;
}

}  // namespace

TEST_CASE("contact has the exact tangent, balances, and takes power only", "[mbs]") {
  int touching = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double exponent : {1.0, 1.5}) {
      const Penalty law{.stiffness = 50, .exponent = exponent, .damping = 0.8};
      touching += check_contact(seed, Plane<2>{}, law, 0.4);
      touching += check_contact(seed, Plane<3>{}, law, 0.4);
      touching += check_contact(seed, Sphere<2>{.radius = 0.6}, law, 0.4);
      touching += check_contact(seed, Sphere<3>{.radius = 0.6}, law, 0.4);
      touching += check_contact(seed, Sphere<3>{.radius = 0.6}, law, 0.0);
    }
  CHECK(touching > 50);
  CHECK(touching < 150);
}

TEST_CASE("without damping and friction contact is the slope of its energy", "[mbs]") {
  const Contact<Sphere<3>> contact{.point = FreePoints<3, 1>::point(0),
                                   .surface = {.radius = 1},
                                   .law = {.stiffness = 50, .exponent = 1.5}};
  const auto energy = [&]<class S>(const Vector<3, S>& x) -> S {
    using std::sqrt;
    const S depth = S(1.0) - sqrt(x.squaredNorm());
    return S(20.0) * depth * depth * sqrt(depth);
  };
  const Vector<3> inside(0.3, -0.5, 0.6);
  const auto slopes = test::slopes<3>(energy, inside);
  const auto now = test::assembled<3>(contact, inside, Vector<3>(1, 2, 3));
  CHECK(now.potential == Approx(energy(inside)));
  CHECK((now.Q + slopes.gradient).norm() < derivative * now.Q.norm());
  CHECK((now.K + slopes.hessian).norm() < derivative * now.K.norm());
  CHECK(now.dissipation == 0);
}

TEST_CASE("contact never pulls, however fast the point leaves", "[mbs]") {
  const Contact<Plane<2>> floor{.point = FreePoints<2, 1>::point(0),
                                .frame = forces::ground_frame<2>({0, 0}, {0, 1}),
                                .law = {.stiffness = 100, .damping = 2}};
  bool pressed = false, let_go = false;
  for (double speed = -3; speed <= 3; speed += 0.1) {
    const Vector<2> F = floor.force_on_point(Vector<2>(0, -0.01), Vector<2>(0, speed));
    CHECK(F[0] == 0);
    CHECK(F[1] >= 0);
    pressed = pressed || F[1] > 0;
    let_go = let_go || F[1] == 0;
    CHECK(floor.force_on_point(Vector<2>(0, 0.01), Vector<2>(0, speed)).isZero(0.0));
  }
  CHECK(pressed);
  CHECK(let_go);
}

TEST_CASE("friction is mu N against the slip, and none where a body carries both", "[mbs]") {
  const Contact<Plane<3>> fixed{.point = FreePoints<3, 1>::point(0),
                                .law = {.stiffness = 100, .exponent = 1},
                                .friction = 0.5,
                                .creep_velocity = 1e-3};
  const Vector<3> F = fixed.force_on_point(Vector<3>(7, 8, -0.2), Vector<3>(3, -4, 0));
  CHECK((F - Vector<3>(-6, 8, 20)).norm() < 1e-5);

  // A frame whose origin and axes turn with the point.
  forces::Frame<3> turning{.origin = ground<3>({0, 0, 0}), .vectors = {}};
  for (int k = 0; k < 3; ++k)
    turning.vectors[static_cast<std::size_t>(k)] = FreePoints<3, 4>::point(k + 1);
  const Contact<Plane<3>> carried{.point = FreePoints<3, 4>::point(0),
                                  .frame = turning,
                                  .law = {.stiffness = 100, .exponent = 1},
                                  .friction = 0.5};
  const Vector<3> omega(1, 2, 3);
  const Matrix<3, 3> R = test::some_turn<3>();
  Vector<12> q, v;
  q << R * Vector<3>(7, 8, -0.2), R.col(0), R.col(1), R.col(2);
  for (int k = 0; k < 4; ++k) v.segment<3>(3 * k) = omega.cross(q.segment<3>(3 * k));
  CHECK((carried.force_on_point(q, v) - Vector<3>(0, 0, 20)).norm() < 1e-10);
}

TEST_CASE("a mass bounces back with the restitution that the damping says", "[mbs]") {
  // m v' = N, from contact to contact; 1 - e = 2/3 a V to first order in a V.
  for (const double exponent : {1.0, 1.5, 2.0}) {
    const double arrival = 0.5, damping = 0.02 / arrival;
    const Penalty law{.stiffness = 1e4, .exponent = exponent, .damping = damping};
    double depth = 0, rate = arrival;
    const double dt = 1e-6;
    do {
      const double middle = depth + 0.5 * dt * rate;
      rate -= dt * law.push(middle, rate).force;
      depth = middle + 0.5 * dt * rate;
    } while (depth > 0);
    CHECK(1 + rate / arrival == Approx(2.0 / 3 * damping * arrival).epsilon(0.02));
  }
}

TEST_CASE("contact refuses parameters out of range", "[mbs]") {
  using Ball = Contact<Sphere<2>>;
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](Ball ball) {
    ball.point = FreePoints<2, 1>::point(0);
    return test::refusal([&] { ball.check(); });
  };
  const Sphere<2> unit{.radius = 1};
  CHECK(test::refusal([&] { Ball{.surface = unit}.check(); }) ==
        "point = missing: must be a point of a part");
  CHECK(refusal({.surface = unit}).empty());
  CHECK(refusal({}) == "radius of the sphere = 0: must be positive [m]");
  CHECK(refusal({.radius = -1, .surface = unit}) == "radius = -1: must be zero or positive [m]");
  CHECK(refusal({.surface = unit, .law = {.stiffness = -1}}) ==
        "stiffness = -1: must be zero or positive [N/m^p]");
  CHECK(refusal({.surface = unit, .law = {.exponent = 0.5}}) ==
        "exponent = 0.5: must be between 1 and 3 [-]");
  CHECK(refusal({.surface = unit, .law = {.damping = not_a_number}}) ==
        "damping = nan: must be zero or positive [s/m]");
  CHECK(refusal({.surface = unit, .friction = -0.1}) ==
        "friction = -0.1: must be zero or positive [-]");
  CHECK(refusal({.surface = unit, .creep_velocity = 0}) ==
        "creep_velocity = 0: must be positive [m/s]");
}
