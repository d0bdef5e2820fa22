// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/readout.hpp>
#include <sphmbs/mbs/ncf/rigid_body.hpp>

#include "support/body_laws.hpp"
#include "support/errors.hpp"
#include "support/quadrature.hpp"

namespace {

using namespace sphmbs::mbs;
using ncf::Inertia;
using ncf::RigidBody;

constexpr double rounding = 1e-13;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A cloud of point masses: mass, centre and tensor from their definitions.
Inertia random_inertia(test::Random& random) {
  std::vector<Vector<3>> points;
  Inertia inertia{.mass = 0};
  for (int k = 0; k < 8; ++k) points.push_back(test::random_vector<3>(random));
  for (const auto& x : points) inertia.centre += x / 8;
  inertia.mass = 8 * 0.3;
  for (const auto& x : points) {
    const Vector<3> d = x - inertia.centre;
    inertia.tensor += 0.3 * (d.squaredNorm() * Matrix<3, 3>::Identity() - d * d.transpose());
  }
  return inertia;
}

RigidBody random_body(test::Random& random) {
  return {.inertia = random_inertia(random),
          .orientation = test::random_rotation(random),
          .reference = test::random_vector<3>(random),
          .position = test::random_vector<3>(random, 3),
          .velocity = test::random_vector<3>(random, 3),
          .angular_velocity = test::random_vector<3>(random, 4)};
}

double share(const MatrixXd& a, const MatrixXd& b) {
  return test::largest_difference(a, b) / test::largest(b);
}

}  // namespace

TEST_CASE("a rigid body starts where, turned and as fast as it is told", "[mbs]") {
  test::Random random(21);
  for (int trial = 0; trial < 20; ++trial) {
    RigidBody body = random_body(random);
    if (trial % 2 == 0) body.reference = body.inertia.centre;
    const bool own_axes = trial % 3 == 0;
    if (own_axes) body.angular_velocity_in = ncf::Axes::body;
    test::check_start(body);
    test::check_rigidity_derivatives(body, random);
    test::check_translation(body, test::random_vector<3>(random), body.inertia.mass);
    Structure<RigidBody> structure;
    const auto placed = structure.add(body);
    const VectorXd q = structure.q(), v = structure.v();
    CHECK(test::largest_difference(ncf::rotation(placed, q), body.orientation.R) < rounding);
    CHECK(test::largest_difference(placed.point(body.reference).at(q), body.position) <
          10 * rounding);
    CHECK(test::largest_difference(placed.point(body.reference).rate(v), body.velocity) <
          10 * rounding);
    const Vector<3> omega =
        own_axes ? ncf::body_angular_velocity(placed, q, v) : ncf::angular_velocity(placed, q, v);
    CHECK(test::largest_difference(omega, body.angular_velocity) < 10 * rounding);
  }
}

TEST_CASE("orientation may be a matrix, a quaternion, an axis and angle, or three points",
          "[mbs]") {
  const double angle = 0.7;
  const Vector<3> axis = Vector<3>(1, -2, 2) / 3;
  const Eigen::AngleAxisd turn(angle, axis);
  const Matrix<3, 3> R = turn.toRotationMatrix();
  for (const ncf::Orientation& o :
       {ncf::Orientation(R), ncf::Orientation(turn), ncf::Orientation(Eigen::Quaterniond(turn)),
        ncf::through_points({1, 1, 1}, Vector<3>(1, 1, 1) + 2 * R.col(0),
                            Vector<3>(1, 1, 1) + R.col(1) - 5 * R.col(0))}) {
    o.check();
    CHECK(test::largest_difference(o.R, R) < rounding);
  }
}

TEST_CASE("energy, momentum and angular momentum follow from the mass matrix", "[mbs]") {
  test::Random random(22);
  for (int trial = 0; trial < 20; ++trial) {
    const RigidBody body = random_body(random);
    const Vector<12> q = body.initial_coordinates(), v = body.initial_rates();
    const double m = body.inertia.mass;
    const Vector<3> w = body.angular_velocity;
    const Vector<3> r = body.shape(body.inertia.centre) * q;
    const Vector<3> r_rate = body.shape(body.inertia.centre) * v;
    const Matrix<3, 3> J =
        body.orientation.R * body.inertia.tensor * body.orientation.R.transpose();
    CHECK(test::kinetic_energy(body) ==
          Approx(0.5 * m * r_rate.squaredNorm() + 0.5 * w.dot(J * w)).epsilon(1e-12));
    const Vector<12> p = body.mass_matrix() * v;
    CHECK(share(RigidBody::translation().transpose() * p, m * r_rate) < 1e-12);
    Vector<3> angular = Vector<3>::Zero();
    for (int k = 0; k < 12; k += 3) angular += q.segment<3>(k).cross(p.segment<3>(k));
    CHECK(share(angular, m * r.cross(r_rate) + J * w) < 1e-12);
  }
}

TEST_CASE("the mass matrix of a moved and turned box is the integral of rho N^T N", "[mbs]") {
  test::Random random(23);
  constexpr double density = 1.7;
  const Vector<3> sides(0.4, 0.7, 1.1), shift = test::random_vector<3>(random);
  const Matrix<3, 3> R = test::random_rotation(random).toRotationMatrix();
  const RigidBody body{.inertia =
                           ncf::shifted(ncf::rotated(ncf::solid_box(density, sides), R), shift)};
  body.check();
  Matrix<12, 12> integral = Matrix<12, 12>::Zero();
  // Gauss's two points along each axis are exact for the quadratic integrand.
  for (int corner = 0; corner < 8; ++corner) {
    const Vector<3> signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Matrix<3, 12> N = body.shape(shift + R * (sides.cwiseProduct(signs) / std::sqrt(12.0)));
    integral += density * sides.prod() / 8 * N.transpose() * N;
  }
  CHECK(share(body.mass_matrix(), integral) < rounding);
}

TEST_CASE("the inertias of cylinder and ball are the integrals over their slices", "[mbs]") {
  constexpr double density = 2.5, R = 0.8, h = 1.3, pi = std::numbers::pi;
  const Inertia ball = ncf::solid_ball(density, R);
  const auto slice = [&](double z) { return pi * (R * R - z * z); };
  CHECK(ball.mass == Approx(density * test::integral(-R, R, slice)).epsilon(rounding));
  const double zz = density * test::integral(-R, R, [&](double z) { return z * z * slice(z); });
  CHECK(test::largest_difference(ball.central_moments(), zz * Matrix<3, 3>::Identity()) < rounding);

  const Inertia cylinder = ncf::solid_cylinder(density, R, h);
  const double area = pi * R * R;
  CHECK(cylinder.mass == Approx(density * area * h).epsilon(rounding));
  const double along =
      density * test::integral(-h / 2, h / 2, [&](double z) { return z * z * area; });
  const double across =  // of x^2 over the disc: by polar coordinates
      density * h * test::integral(0, R, [&](double r) { return pi * r * r * r; });
  CHECK(test::largest_difference(cylinder.central_moments(),
                                 Matrix<3, 3>(Vector<3>(across, across, along).asDiagonal())) <
        rounding);
}

TEST_CASE("inertias add up, and may be given about the origin", "[mbs]") {
  const Inertia half = ncf::solid_box(3, {0.5, 1, 2});
  const Inertia both = ncf::shifted(half, {0.25, 0, 0}) + ncf::shifted(half, {0.75, 0, 0});
  const Inertia whole = ncf::shifted(ncf::solid_box(3, {1, 1, 2}), {0.5, 0, 0});
  CHECK(both.mass == Approx(whole.mass).epsilon(rounding));
  CHECK(test::largest_difference(both.centre, whole.centre) < rounding);
  CHECK(test::largest_difference(both.tensor, whole.tensor) < rounding);

  test::Random random(24);
  const Inertia some = random_inertia(random);
  const Matrix<3, 3> J = some.second_moments();
  const Inertia again =
      ncf::about_origin(some.mass, some.centre, J.trace() * Matrix<3, 3>::Identity() - J);
  CHECK(test::largest_difference(again.tensor, some.tensor) < rounding);
}

TEST_CASE("rigidity holds all that has no mass but the spin of a free thin rod", "[mbs]") {
  test::Random random(25);
  const auto regularity = [&](const Inertia& inertia) {
    RigidBody body{.inertia = inertia, .orientation = test::random_rotation(random)};
    body.check();
    return test::regularity(body.mass_matrix(), body.rigidity_jacobian(body.initial_coordinates()));
  };
  CHECK(regularity(ncf::solid_box(1, {1, 1, 1})) > 1e-3);
  CHECK(regularity(ncf::box(1, {1, 2, 0})) > 1e-3);  // a thin plate
  CHECK(regularity(ncf::solid_cylinder(1 / (std::numbers::pi * 1e-4), 0.01, 1)) > 1e-6);
  CHECK(regularity(ncf::rod(1, 1)) < 1e-14);

  // A hinge across the rod holds its spin.
  Structure<RigidBody> structure;
  const auto placed = structure.add(
      RigidBody{.inertia = ncf::rod(1, 1), .orientation = test::random_rotation(random)});
  const VectorXd q = structure.q();
  const auto end = placed.point({0.5, 0, 0});
  const auto hinge = joints::revolute(joints::ground_frame<3>(end.at(q)), end,
                                      placed.vector({0, 0, 0}, {0, 0, 1}), q);
  MatrixXd phi_q = MatrixXd::Zero(11, 12);
  phi_q.topRows(6) = placed.part.rigidity_jacobian(q);
  MatrixXd own = MatrixXd::Zero(5, static_cast<int>(hinge.index().size()));
  hinge.jacobian(q(hinge.index()), 0, own);
  phi_q(Eigen::seqN(6, 5), hinge.index()) = own;
  CHECK(test::regularity(placed.part.mass_matrix(), phi_q) > 1e-3);
}

TEST_CASE("bodies that share a point and a vector are hinged", "[mbs]") {
  test::Random random(26);
  const RigidBody a = random_body(random);
  RigidBody b = a;
  b.orientation = Matrix<3, 3>(a.orientation.R * Eigen::AngleAxisd(0.6, Vector<3>::UnitZ()));
  Structure<RigidBody> structure;
  const auto first = structure.add(a);
  const Vector<12> qb = b.initial_coordinates();
  const Node u = structure.add_node(qb.segment<3>(3)), v = structure.add_node(qb.segment<3>(6));
  const auto second = structure.add(b, {first.nodes[0], u, v, first.nodes[3]});
  const VectorXd q = structure.q();
  MatrixXd phi_q = MatrixXd::Zero(12, 18);
  phi_q(Eigen::seqN(0, 6), first.index()) += a.rigidity_jacobian(first.local(q));
  phi_q(Eigen::seqN(6, 6), second.index()) += b.rigidity_jacobian(second.local(q));
  CHECK(phi_q.colPivHouseholderQr().rank() == 18 - 7);
}

TEST_CASE("a rigid body without an outline is drawn as the box of equal inertia", "[mbs]") {
  const Vector<3> sides(1, 2, 3), centre(0.1, 0.2, 0.3);
  const RigidBody body{.inertia = ncf::shifted(ncf::solid_box(1, sides), centre)};
  Vector<3> upper = centre, lower = centre;
  for (int k = 0; k <= 15; ++k) {
    upper = upper.cwiseMax(body.outline(k / 15.0));
    lower = lower.cwiseMin(body.outline(k / 15.0));
  }
  CHECK(test::largest_difference(upper, centre + sides / 2) < 1e-12);
  CHECK(test::largest_difference(lower, centre - sides / 2) < 1e-12);
  const RigidBody line{.inertia = ncf::rod(1, 1), .outline_points = {{0, 0, 0}, {0, 0, 2}}};
  CHECK(test::largest_difference(line.outline(0.25), Vector<3>(0, 0, 0.5)) < rounding);
}

TEST_CASE("rigid bodies refuse what makes no sense, by name and value", "[mbs][fault]") {
  const auto complaint = [&](auto change) {
    RigidBody body{.inertia = ncf::solid_box(1, {1, 1, 1})};
    change(body);
    return test::refusal([&] { body.check(); });
  };
  using Catch::Contains;
  CHECK(complaint([](RigidBody&) {}).empty());
  CHECK(complaint([](RigidBody& b) { b.inertia.mass = -1; }) == "mass = -1: must be positive [kg]");
  CHECK_THAT(complaint([](RigidBody& b) { b.inertia.tensor(0, 0) = not_a_number; }),
             Contains("inertia tensor") && Contains("finite"));
  CHECK_THAT(complaint([](RigidBody& b) { b.inertia.tensor(0, 1) = 0.1; }),
             Contains("inertia tensor") && Contains("symmetric"));
  CHECK(complaint([](RigidBody& b) {
          b.inertia = ncf::principal(1, {-1, 2, 3});
        }) ==
        "principal moments of inertia = -1  2  3: must be positive, or one of them 0 for a thin "
        "rod [kg m^2]");
  CHECK(complaint([](RigidBody& b) {
          b.inertia = ncf::principal(1, {1, 1, 3});
        }) ==
        "principal moments of inertia = 1 1 3: must be such that none exceeds the sum of the "
        "others [kg m^2]");
  CHECK_THAT(complaint([](RigidBody& b) { b.inertia.tensor.setZero(); }), Contains("= 0 0 0"));
  CHECK(complaint([](RigidBody& b) { b.inertia = ncf::box(1, {1, 2, 0}); }).empty());
  CHECK(complaint([](RigidBody& b) { b.inertia = ncf::rod(1, 2); }).empty());
  CHECK_THAT(complaint([](RigidBody& b) { b.orientation.R(0, 0) = 1.001; }),
             Contains("orientation"));
  CHECK_THAT(complaint([](RigidBody& b) { b.orientation.R(2, 2) = -1; }), Contains("det R = 1"));
  CHECK_THAT(complaint([](RigidBody& b) { b.orientation = Eigen::Quaterniond(2, 0, 0, 1); }),
             Contains("unit quaternion"));
  CHECK(complaint([](RigidBody& b) { b.angular_velocity[2] = not_a_number; }) ==
        "angular_velocity =   0   0 nan: must be finite [rad/s]");
  CHECK_THAT(test::refusal([] {
               ncf::through_points({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
             }),
             Contains("not in line"));
}
