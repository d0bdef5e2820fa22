// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <sphmbs/mbs/joints/clamped.hpp>
#include <sphmbs/mbs/joints/distance.hpp>
#include <sphmbs/mbs/joints/driven_angle.hpp>
#include <sphmbs/mbs/joints/dual.hpp>
#include <sphmbs/mbs/joints/in_plane.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/prismatic.hpp>
#include <sphmbs/mbs/joints/reaction.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/mbs/ncf/readout.hpp>
#include <sphmbs/mbs/ncf/rigid_body.hpp>

#include "support/errors.hpp"
#include "support/joint_laws.hpp"

namespace {

using namespace sphmbs::mbs;
static_assert(LinearConstraint<joints::Joint<2>> && LinearConstraint<joints::Joint<3>>);
using joints::Joint;
using joints::TimeFunction;
using ncf::PlanarBody;
using ncf::RigidBody;
using sphmbs::InvalidInput;

constexpr double rounding = 1e-12;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TimeFunction parabola(double a, double b, double c) {
  return {[=](double t) { return a + b * t + c * t * t; }, [=](double t) { return b + 2 * c * t; },
          [=](double) { return 2 * c; }};
}

/// Two free bodies, turned at random, and a place and directions for a joint between them.
template <class B>
struct Two {
  static constexpr int dim = B::dim;
  static constexpr int rotations = dim == 2 ? 1 : 3;
  using Structure = sphmbs::mbs::Structure<B, Joint<dim>>;

  Structure structure;
  std::vector<Placed<B>> body;
  VectorXd q;
  Vector<dim> place;      // of the joint
  Matrix<dim, dim> axes;  // of the joint: columns t1, t2, n in 3D; n, t in 2D

  explicit Two(test::Random& random) {
    for (int k = 0; k < 2; ++k) {
      B start = some(random);
      start.position = test::random_vector<dim>(random, 2);
      body.push_back(structure.add(start));
    }
    q = structure.q();
    place = test::random_vector<dim>(random, 2);
    if constexpr (dim == 3) {
      axes = test::random_rotation(random).toRotationMatrix();
    } else {
      axes = Eigen::Rotation2Dd(random.between(-3, 3)).toRotationMatrix();
    }
  }

  static B some(test::Random& random) {
    if constexpr (dim == 3) {
      return {.inertia = ncf::solid_box(1, {1, 2, 3}),
              .orientation = test::random_rotation(random)};
    } else {
      return {.inertia = {.mass = 1, .polar = 1}, .angle = random.between(-3, 3)};
    }
  }

  Vector<dim> material(int k, const Vector<dim>& x) const {
    const auto& b = body[static_cast<std::size_t>(k)];
    const Vector<dim> origin = b.point(Vector<dim>::Zero()).at(q);
    return ncf::rotation(b, q).transpose() * (x - origin);
  }
  Marker<dim> point(int k, const Vector<dim>& x) const {
    return body[static_cast<std::size_t>(k)].point(material(k, x));
  }
  Marker<dim> vector(int k, const Vector<dim>& d) const {
    return body[static_cast<std::size_t>(k)].vector(material(k, Vector<dim>::Zero()),
                                                    material(k, d));
  }
  joints::Frame<dim> frame(int k, const Vector<dim>& x) const {
    return joints::frame(body[static_cast<std::size_t>(k)], material(k, x));
  }

  /// Coordinates after body k has been turned by R about `place` and moved by d.
  VectorXd moved(VectorXd from, int k, const Matrix<dim, dim>& R, const Vector<dim>& d) const {
    for (int i = 0; i < B::nodes; ++i) {
      auto x = from.segment<dim>(k * B::dofs + dim * i);
      x = i == 0 ? Vector<dim>(place + R * (x - place) + d) : Vector<dim>(R * x);
    }
    return from;
  }

  Matrix<dim, dim> turn(int axis, double angle) const {
    if constexpr (dim == 3) {
      return Eigen::AngleAxisd(angle, axes.col(axis)).toRotationMatrix();
    } else {
      return Eigen::Rotation2Dd(angle).toRotationMatrix();
    }
  }

  /// Rates of body k as it moves along the axes of the joint (0 ... dim - 1) or turns about them.
  VectorXd twist(int k, int motion) const {
    constexpr double quarter = std::numbers::pi / 2;
    VectorXd v = VectorXd::Zero(q.size());
    if (motion < dim) {
      v.segment<dim>(k * B::dofs) = axes.col(motion);
      return v;
    }
    // omega x: a quarter turn of what is perpendicular to the axis
    Matrix<dim, dim> W = turn(motion - dim, quarter);
    if constexpr (dim == 3) W -= axes.col(motion - dim) * axes.col(motion - dim).transpose();
    const VectorXd ahead = moved(q, k, W, Vector<dim>::Zero());
    v.segment<B::dofs>(k * B::dofs) = ahead.segment<B::dofs>(k * B::dofs);
    v.segment<dim>(k * B::dofs) -= place;
    return v;
  }

  /// Conditions of rigidity and of the joint that are independent.
  int rank(const Joint<dim>& joint) const {
    constexpr int own = B::conditions;
    MatrixXd phi_q = MatrixXd::Zero(2 * own + joint.conditions(), q.size());
    for (int k = 0; k < 2; ++k)
      phi_q.block<own, B::dofs>(k * own, k * B::dofs) =
          body[static_cast<std::size_t>(k)].part.rigidity_jacobian(q.segment<B::dofs>(k * B::dofs));
    phi_q.bottomRows(joint.conditions()) = test::jacobian(joint, q);
    return static_cast<int>(Eigen::ColPivHouseholderQR<MatrixXd>(phi_q).setThreshold(1e-9).rank());
  }
};

/// A joint and the motions of b against a that it leaves free: along the axes of the joint, then
/// about them.
template <int Dim>
struct Case {
  Joint<Dim> joint;
  std::vector<int> free;
  bool finite = true;  // whether these are free for any size of the motion
};

constexpr int about_t1 = 3, about_t2 = 4, about_n = 5, along_t1 = 0, along_t2 = 1, along_n = 2;

std::vector<Case<3>> spatial_joints(const Two<RigidBody>& two) {
  const Vector<3> P = two.place, t1 = two.axes.col(0), t2 = two.axes.col(1), n = two.axes.col(2);
  const VectorXd& q = two.q;
  const auto A = two.frame(0, P), B = two.frame(1, P);
  const auto Q = two.point(1, P);
  const auto axis = two.vector(1, 1.7 * n);
  std::vector<Case<3>> all;
  all.push_back({joints::spherical(A.origin, Q), {about_t1, about_t2, about_n}});
  all.push_back({joints::coincident(A.origin, Q), {about_t1, about_t2, about_n}});
  all.push_back({joints::revolute(A, Q, axis, q), {about_n}});
  all.push_back({joints::universal(A.origin, two.vector(0, 2 * t1), Q, two.vector(1, 3 * t2), q),
                 {about_t1, about_t2}});
  all.push_back({joints::cylindrical(A, two.point(1, P - 0.8 * n), axis, q), {along_n, about_n}});
  all.push_back({joints::prismatic(A, two.frame(1, P + 0.6 * n), axis, q), {along_n}});
  all.push_back({joints::rigid(A, B, q), {}});
  all.push_back(
      {joints::in_line(A, Q, two.vector(0, -2 * n), q), {along_n, about_t1, about_t2, about_n}});
  all.push_back({joints::in_plane(A.origin, two.vector(0, 3 * n), Q, q),
                 {along_t1, along_t2, about_t1, about_t2, about_n}});
  all.push_back({joints::aligned(A, axis, q), {along_t1, along_t2, along_n, about_n}});
  all.push_back({joints::distance(two.point(0, P - 1.3 * n), Q, 1.3),
                 {along_t1, along_t2, about_t1, about_t2, about_n},
                 false});
  all.push_back({joints::driven_rotation(A, axis, two.vector(1, 2 * t1), 0.0, q),
                 {along_t1, along_t2, along_n, about_t1, about_t2},
                 false});
  return all;
}

std::vector<Case<2>> planar_joints(const Two<PlanarBody>& two) {
  constexpr int along_n2 = 0, along_t = 1, about = 2;
  const Vector<2> P = two.place, n = two.axes.col(0), t = two.axes.col(1);
  const VectorXd& q = two.q;
  const auto A = two.frame(0, P), B = two.frame(1, P);
  const auto Q = two.point(1, P);
  std::vector<Case<2>> all;
  all.push_back({joints::revolute(A.origin, Q), {about}});
  all.push_back(
      {joints::prismatic(A, two.frame(1, P + 0.7 * n), two.vector(1, 2 * n), q), {along_n2}});
  all.push_back({joints::rigid(A, B, q), {}});
  all.push_back({joints::in_line(A, Q, two.vector(0, 2 * n), q), {along_n2, about}});
  all.push_back({joints::in_plane(A.origin, two.vector(0, 2 * t), Q, q), {along_n2, about}});
  all.push_back({joints::aligned(A, two.vector(1, 2 * n), q), {along_n2, along_t}});
  all.push_back({joints::distance(two.point(0, P - 0.4 * n), Q, 0.4), {along_t, about}, false});
  all.push_back({joints::driven_rotation(A, two.vector(1, 2 * n), 0.0, q), {along_n2, along_t}});
  return all;
}

template <class B, class List>
void check_freedom(const List& joints_between, std::uint64_t seed) {
  test::Random random(seed);
  for (int trial = 0; trial < 5; ++trial) {
    const Two<B> two(random);
    constexpr int dim = B::dim, motions = dim == 2 ? 3 : 6;
    const auto one = [&](int k) { return two.turn(k, 0.0); };
    for (const auto& [joint, free, finite] : joints_between(two)) {
      INFO(joint.name());
      joint.check();
      CHECK(test::largest(test::residual(joint, two.q)) < rounding);
      CHECK(two.rank(joint) == 2 * B::conditions + joint.conditions());
      CHECK(joint.conditions() == motions - static_cast<int>(free.size()));
      const MatrixXd phi_q = test::jacobian(joint, two.q);
      VectorXd allowed = two.q;
      for (int motion = 0; motion < motions; ++motion) {
        INFO("motion " << motion);
        const bool is_free = std::find(free.begin(), free.end(), motion) != free.end();
        const double slope = test::largest(phi_q * two.twist(1, motion));
        CHECK((slope < rounding) == is_free);
        const double size = random.between(0.2, 1.5);
        const VectorXd there =
            motion < dim ? two.moved(two.q, 1, one(0), size * two.axes.col(motion))
                         : two.moved(two.q, 1, two.turn(motion - dim, size), Vector<dim>::Zero());
        const double off = test::largest(test::residual(joint, there));
        if (!is_free) CHECK(off > 1e-3);
        if (is_free && finite) CHECK(off < rounding);
      }
      // Neither joint cares where both are together.
      const Matrix<dim, dim> R = two.turn(0, random.between(-3, 3));
      const Vector<dim> d = test::random_vector<dim>(random, 5);
      const VectorXd together = two.moved(two.moved(two.q, 0, R, d), 1, R, d);
      CHECK(test::largest(test::residual(joint, together)) < 10 * rounding);
    }
  }
}

/// Joints to the ground and joints that move by themselves.
std::vector<Joint<3>> other_spatial_joints(const Two<RigidBody>& two) {
  const Vector<3> P = two.place, n = two.axes.col(2);
  const auto A = two.frame(0, P);
  const auto Q = two.point(1, P + n);
  const std::vector<Marker<3>> vectors{two.vector(1, n), two.vector(1, 2 * two.axes.col(1))};
  return {
      joints::pinned(Q, two.q),
      joints::driven(Q, joints::Path<3>(parabola(1, 2, 3), 4.0, parabola(5, 6, 7))),
      joints::component(Q, n, parabola(1, 2, 3)),
      joints::clamped(Q, vectors, two.q),
      joints::clamped(Q, vectors, A, two.q),
      joints::distance(A.origin, Q, parabola(1, 0.5, 0.25)),
      joints::revolute(joints::ground_frame<3>(P + n), Q, two.vector(1, n), two.q),
      joints::prismatic(joints::ground_frame<3>(P), two.frame(1, P + 2 * n), ground<3>(n), two.q)};
}

}  // namespace

TEST_CASE("a spatial joint leaves the motions free that its name says, and no others", "[mbs]") {
  check_freedom<RigidBody>(spatial_joints, 31);
}

TEST_CASE("a planar joint leaves the motions free that its name says, and no others", "[mbs]") {
  check_freedom<PlanarBody>(planar_joints, 32);
}

TEST_CASE("derivatives of joints are exact", "[mbs]") {
  test::Random random(33);
  const auto check = [&](const auto& joint, bool polynomial) {
    INFO(joint.name());
    const double t = random.between(0, 1);
    test::check_derivatives_in_q(joint, random, t);
    if (polynomial) test::check_derivatives_in_time(joint, random, t);
  };
  for (int trial = 0; trial < 3; ++trial) {
    const Two<RigidBody> two(random);
    for (const auto& c : spatial_joints(two)) check(c.joint, true);
    for (const auto& joint : other_spatial_joints(two)) check(joint, true);
    const auto turning =
        joints::driven_rotation(two.frame(0, two.place), two.vector(1, two.axes.col(2)),
                                two.vector(1, two.axes.col(0)), parabola(0.1, 2, 3), two.q);
    check(turning, false);
    const Two<PlanarBody> flat(random);
    for (const auto& c : planar_joints(flat)) check(c.joint, true);
    check(joints::driven_angle(flat.vector(1, flat.axes.col(0)), parabola(0.1, 2, 3), flat.q),
          false);
  }
}

TEST_CASE("a driven angle has the derivatives in time that differentiation finds", "[mbs]") {
  test::Random random(34);
  const Two<PlanarBody> two(random);
  const double a = 0.3, b = 2, c = -1.5, t0 = 0.4;
  const auto vector = two.vector(1, 2 * two.axes.col(0));
  const auto joint = joints::driven_angle(vector, parabola(a, b, c), two.q);
  const auto n = static_cast<int>(joint.index().size());
  const VectorXd q = test::random_vector(random, n), v = test::random_vector(random, n),
                 acc = test::random_vector(random, n);
  const Vector<2> x0 = vector.N * q, x1 = vector.N * v, x2 = vector.N * acc;
  const auto phi = joints::differentiated([&](auto s) {  // s = t - t0
    using S = decltype(s);
    using std::cos, std::sin;
    const S t = s + t0, angle = a + b * t + c * t * t;
    const S x = x0[0] + x1[0] * s + 0.5 * x2[0] * s * s,
            y = x0[1] + x1[1] * s + 0.5 * x2[1] * s * s;
    return S((cos(angle) * y - sin(angle) * x) / 2.0);
  });
  const auto said = test::slopes_along(joint, q, v, acc, t0);
  VectorXd now = VectorXd::Zero(1);
  joint.residual(q, t0, now);
  CHECK(now[0] == Approx(phi.value(0)).epsilon(1e-12));
  CHECK(said.first[0] == Approx(phi.rate(0)).epsilon(1e-12));
  CHECK(said.second[0] == Approx(phi.acceleration(0)).epsilon(1e-12));
}

TEST_CASE("a driven rotation turns b against a by the given angle about the axis", "[mbs]") {
  test::Random random(35);
  const auto angle = parabola(0, 2, 3);
  const double t = 0.3;
  const auto check = [&](const auto& two, const auto& joint) {
    constexpr int dim = std::decay_t<decltype(two)>::dim;
    CHECK(std::abs(test::residual(joint, two.q, 0)[0]) < rounding);
    const VectorXd there =
        two.moved(two.q, 1, two.turn(dim - 1, angle.value(t)), test::random_vector<dim>(random));
    CHECK(std::abs(test::residual(joint, there, t)[0]) < rounding);
    // In [rad] near the given angle.
    constexpr double small = 1e-5;
    const VectorXd ahead =
        two.moved(two.q, 1, two.turn(dim - 1, angle.value(t) + small), Vector<dim>::Zero());
    CHECK(std::abs(test::residual(joint, ahead, t)[0]) == Approx(small).epsilon(1e-6));
    VectorXd phi_t = VectorXd::Zero(1);
    joint.rate(there(joint.index()), t, phi_t);
    CHECK(std::abs(phi_t[0]) == Approx(angle.rate(t)).epsilon(1e-9));
  };
  const Two<RigidBody> two(random);
  check(two, joints::driven_rotation(two.frame(0, two.place), two.vector(0, 2 * two.axes.col(2)),
                                     two.vector(1, two.axes.col(0) + 0.3 * two.axes.col(2)), angle,
                                     two.q));
  const Two<PlanarBody> flat(random);
  check(flat,
        joints::driven_rotation(flat.frame(0, flat.place), flat.vector(1, {2, 1}), angle, flat.q));
  const auto absolute = joints::driven_angle(flat.vector(1, 2 * flat.axes.col(0)),
                                             std::atan2(flat.axes(1, 0), flat.axes(0, 0)), flat.q);
  CHECK(std::abs(test::residual(absolute, flat.q)[0]) < rounding);
}

TEST_CASE("clamped vectors of an element are held in length and angle, by independent conditions",
          "[mbs]") {
  test::Random random(36);
  const Two<RigidBody> two(random);
  const std::vector<Marker<3>> gradients{two.vector(1, 2 * two.axes.col(0)),
                                         two.vector(1, two.axes.col(1)),
                                         two.vector(1, two.axes.col(0) + two.axes.col(2))};
  const auto to_body =
      joints::clamped(two.point(1, two.place), gradients, two.frame(0, two.place), two.q);
  const auto to_ground = joints::clamped(two.point(1, two.place), gradients, two.q);
  for (const auto& joint : {to_body, to_ground}) {
    CHECK(joint.conditions() == 12);
    CHECK(joint.linear());
    CHECK(test::largest(test::residual(joint, two.q)) < rounding);
    CHECK(test::jacobian(joint, two.q).rightCols(12).colPivHouseholderQr().rank() == 12);
  }
  const Matrix<3, 3> R = two.turn(1, 0.8);
  const Vector<3> d(1, 2, 3);
  const VectorXd together = two.moved(two.moved(two.q, 0, R, d), 1, R, d);
  CHECK(test::largest(test::residual(to_body, together)) < rounding);
  CHECK(test::largest(test::residual(to_ground, together)) > 0.1);
}

TEST_CASE("joints with the ground are linear and hold what they name", "[mbs]") {
  test::Random random(37);
  const Two<RigidBody> two(random);
  const Vector<3> n = two.axes.col(2);
  const auto Q = two.point(1, two.place);
  const auto pinned = joints::pinned(Q, two.q);
  CHECK(pinned.linear());
  CHECK(test::largest(test::residual(pinned, two.q)) < rounding);
  const auto hinge =
      joints::revolute(joints::ground_frame<3>(two.place), Q, two.vector(1, n), two.q);
  CHECK(hinge.linear());
  CHECK(hinge.conditions() == 5);
  const VectorXd turned = two.moved(two.q, 1, two.turn(2, 0.9), Vector<3>::Zero());
  CHECK(test::largest(test::residual(hinge, turned)) < rounding);
  const auto height = joints::component(Q, n, parabola(1, 2, 3));
  CHECK(test::residual(height, two.q, 2)[0] == Approx(n.dot(two.place) - 17).epsilon(1e-12));
  const auto driven = joints::driven(Q, joints::Path<3>(parabola(1, 2, 3), 4.0, 0.0));
  CHECK(test::largest_difference(test::residual(driven, two.q, 2),
                                 two.place - Vector<3>(17, 4, 0)) < rounding);
  CHECK_FALSE(joints::distance(two.point(0, two.place), Q, 1.0).linear());
}

TEST_CASE("the reaction does the work of -Phi_q^T lambda", "[mbs]") {
  test::Random random(38);
  const auto check = [&](const auto& two, const auto& joint, const auto& point_a, int a) {
    constexpr int dim = std::decay_t<decltype(two)>::dim, motions = dim == 2 ? 3 : 6;
    INFO(joint.name());
    const VectorXd lambda = test::random_vector(random, joint.conditions());
    const VectorXd force = -test::jacobian(joint, two.q).transpose() * lambda;
    const auto r = joints::reaction(joint, two.q, 0, lambda);
    for (int motion = 0; motion < motions; ++motion) {
      const VectorXd v = two.twist(a, motion);
      double power = r.force.dot(point_a.rate(v));
      if (motion >= dim) {
        if constexpr (dim == 3) {
          power += r.couple.dot(two.axes.col(motion - dim));
        } else {
          power += r.couple[0];
        }
      }
      CHECK(power == Approx(force.dot(v)).margin(rounding));
    }
  };
  const Two<RigidBody> two(random);
  const auto elsewhere = two.point(0, two.place - 1.3 * two.axes.col(2));
  for (const auto& c : spatial_joints(two))
    check(two, c.joint, c.joint.name() == "distance" ? elsewhere : two.point(0, two.place), 0);
  const auto Q = two.point(1, two.place);
  check(two, joints::pinned(Q, two.q), Q, 1);
  check(two, joints::clamped(Q, {two.vector(1, {1, 2, 3})}, two.frame(0, two.place), two.q), Q, 1);
  const Two<PlanarBody> flat(random);
  const auto there = flat.point(0, flat.place - 0.4 * flat.axes.col(0));
  for (const auto& c : planar_joints(flat))
    check(flat, c.joint, c.joint.name() == "distance" ? there : flat.point(0, flat.place), 0);
  check(flat, joints::driven_angle(flat.vector(1, {1, 2}), 0.3, flat.q), flat.point(1, flat.place),
        1);
}

TEST_CASE("time functions have the derivatives that differentiation finds", "[mbs]") {
  const auto check = [](const TimeFunction& f, const TimeFunction& judge) {
    for (const double t : {-0.3, 0.1, 0.45, 0.8, 1.7}) {
      CHECK(f.value(t) == Approx(judge.value(t)).margin(rounding));
      CHECK(f.rate(t) == Approx(judge.rate(t)).margin(rounding));
      CHECK(f.acceleration(t) == Approx(judge.acceleration(t)).margin(rounding));
    }
  };
  const auto angle = [](auto t) { return decltype(t)(0.2 + 3.0 * t - 2.0 * t * t); };
  const auto sine = [](auto t) {
    using std::sin;
    return decltype(t)(0.5 + 2.0 * sin(2 * std::numbers::pi * 1.5 * t + 0.3));
  };
  check(2.5, joints::differentiated([](auto t) { return decltype(t)(2.5); }));
  check(joints::linear_in_time(1, -2),
        joints::differentiated([](auto t) { return decltype(t)(1.0 - 2.0 * t); }));
  check(joints::Sine{.amplitude = 2, .frequency = 1.5, .phase = 0.3, .mean = 0.5},
        joints::differentiated(sine));
  check(joints::SmoothStep{.from = 1, .to = 3, .begin = 0, .end = 1},
        joints::differentiated([](auto t) {
          using S = decltype(t);
          if (t < S(0.0)) return S(1.0);
          if (t > S(1.0)) return S(3.0);
          return S(1.0 + 2.0 * t * t * t * (10.0 - 15.0 * t + 6.0 * t * t));
        }));
  check(joints::squared(joints::differentiated(angle)), joints::differentiated([&](auto t) {
          using S = decltype(t);
          return S(angle(t) * angle(t));
        }));
  check(joints::cosine_of(joints::differentiated(angle), 1.7, -0.4),
        joints::differentiated([&](auto t) {
          using std::cos;
          using S = decltype(t);
          const S a = angle(t) - 0.4;
          return S(1.7 * cos(a));
        }));
}

TEST_CASE("messages name a joint and its conditions", "[mbs]") {
  test::Random random(39);
  const Two<RigidBody> two(random);
  const auto knee = joints::revolute(two.frame(0, two.place), two.point(1, two.place),
                                     two.vector(1, two.axes.col(2)), two.q, "knee");
  CHECK(knee.name() == "revolute 'knee'");
  CHECK(knee.condition_name(1) == "revolute 'knee': position y");
  CHECK(knee.condition_name(4) == "revolute 'knee': axis 2");
  CHECK(joints::pinned(two.point(0, two.place), two.q).name() == "pinned");
}

TEST_CASE("joints refuse what makes no sense, by name", "[mbs][fault]") {
  test::Random random(40);
  Two<RigidBody> two(random);
  const Vector<3> P = two.place, t1 = two.axes.col(0), n = two.axes.col(2);
  const VectorXd& q = two.q;
  const auto A = two.frame(0, P);
  const auto Q = two.point(1, P), zero = two.vector(1, Vector<3>::Zero());
  const auto axis = two.vector(1, n);
  using Catch::Contains;
  using test::refusal;
  const auto add = [&](const Joint<3>& joint) {
    return refusal([&] { two.structure.add(joint); });
  };
  CHECK(add(joints::spherical(A.origin, Q)).empty());

  // A part with itself, the ground with itself, NaN.
  CHECK(add(joints::spherical(A.origin, two.point(0, P + n), "hip")) ==
        "spherical 'hip': position: parts joined = one and the same: must be two different ones");
  CHECK_THAT(add(joints::revolute(A, Q, two.vector(0, n), q, "hip")),
             Contains("revolute 'hip': axis 1: parts joined = one and the same"));
  CHECK_THAT(add(joints::coincident(ground<3>(P), ground<3>(P), "wall")),
             Contains("coincident 'wall': position: coordinates = none"));
  CHECK_THAT(add(joints::distance(Q, Q, 1.0, "rope")),
             Contains("distance 'rope': distance: coordinates = none"));
  Vector<3> bad = P;
  bad[1] = not_a_number;
  CHECK_THAT(add(joints::coincident(Q, ground<3>(bad), "pin")),
             Contains("coincident 'pin': marker") && Contains("finite"));
  CHECK_THAT(add(joints::driven(Q, joints::Path<3>(not_a_number, 0.0, 0.0), "crank")),
             Contains("driven 'crank': value of the time function at t = 0 = nan"));

  // Axes of no length, parallel or not perpendicular; frames that are flat.
  CHECK_THAT(refusal([&] { joints::revolute(A, Q, zero, q, "knee"); }),
             Contains("revolute 'knee': length of the axis = 0: must be positive"));
  CHECK_THAT(refusal([&] { joints::cylindrical(A, Q, zero, q, "piston"); }),
             Contains("cylindrical 'piston': length of the axis"));
  CHECK_THAT(refusal([&] { joints::in_plane(A.origin, zero, Q, q, "table"); }),
             Contains("in plane 'table': length of the axis"));
  CHECK_THAT(refusal([&] { joints::universal(A.origin, two.vector(0, n), Q, axis, q, "cross"); }),
             Contains("universal 'cross': cosine between the axes = 1: must be 0"));
  CHECK_THAT(
      refusal([&] { joints::driven_rotation(A, axis, axis, 0.0, q, "motor"); }),
      Contains("driven rotation 'motor': sine between axis and vector") && Contains("parallel"));
  auto flat = A;
  flat.vectors[2] = flat.vectors[0];
  CHECK_THAT(refusal([&] { joints::rigid(flat, two.frame(1, P), q, "weld"); }),
             Contains("rigid 'weld': volume between the unit vectors of the frame"));
  CHECK_THAT(refusal([&] { joints::component(Q, 2 * t1, 0.0, "rail"); }),
             Contains("component 'rail': length of the axis = 2: must be 1"));

  // Numbers out of range.
  CHECK_THAT(refusal([&] { joints::distance(A.origin, Q, -1.0, "rope"); }),
             Contains("distance 'rope': length = -1: must be positive [m]"));
  CHECK_THAT(refusal([&] { joints::distance(A.origin, Q, not_a_number, "rope"); }),
             Contains("distance 'rope': length = nan"));
  CHECK_THAT(refusal([] { TimeFunction(joints::SmoothStep{.to = 1, .begin = 2, .end = 2}); }),
             Contains("end of the smooth step = 2"));
  CHECK_THAT(refusal([] { TimeFunction(nullptr, nullptr, nullptr); }), Contains("three functions"));
}
