// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/mbs/ncf/readout.hpp>

#include "support/body_laws.hpp"
#include "support/errors.hpp"
#include "support/quadrature.hpp"

namespace {

using namespace sphmbs::mbs;
using ncf::PlanarBody;

constexpr double rounding = 1e-13;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

PlanarBody random_body(test::Random& random) {
  return {.inertia = {.mass = random.between(0.5, 2),
                      .centre = test::random_vector<2>(random),
                      .polar = random.between(0.1, 1)},
          .reference = test::random_vector<2>(random),
          .position = test::random_vector<2>(random, 3),
          .velocity = test::random_vector<2>(random, 3),
          .angle = random.between(-3, 3),
          .angular_velocity = random.between(-4, 4)};
}

}  // namespace

TEST_CASE("a planar body starts where and as fast as it is told", "[mbs]") {
  test::Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const PlanarBody body = random_body(random);
    test::check_start(body);
    test::check_rigidity_derivatives(body, random);
    test::check_translation(body, test::random_vector<2>(random), body.inertia.mass);
    Structure<PlanarBody> structure;
    const auto placed = structure.add(body);
    const VectorXd q = structure.q(), v = structure.v();
    CHECK(test::largest_difference(placed.point(body.reference).at(q), body.position) < rounding);
    CHECK(test::largest_difference(placed.point(body.reference).rate(v), body.velocity) <
          10 * rounding);
    CHECK(ncf::angle(placed, q) == Approx(body.angle).epsilon(rounding));
    CHECK(ncf::angular_velocity(placed, q, v) == Approx(body.angular_velocity).epsilon(1e-12));
  }
}

TEST_CASE("the kinetic energy of a planar body is that of mass and moment of inertia", "[mbs]") {
  test::Random random(12);
  for (int trial = 0; trial < 20; ++trial) {
    const PlanarBody body = random_body(random);
    const Vector<2> v_centre = body.shape(body.inertia.centre) * body.initial_rates();
    const double w = body.angular_velocity;
    CHECK(test::kinetic_energy(body) == Approx(0.5 * body.inertia.mass * v_centre.squaredNorm() +
                                               0.5 * body.inertia.polar * w * w)
                                            .epsilon(1e-12));
  }
}

TEST_CASE("the mass matrix of a planar body is the integral of rho N^T N", "[mbs]") {
  constexpr double density = 3, a = 0.4, b = 0.9;
  const Vector<2> centre(0.3, -0.2);
  const double mass = density * a * b;
  const PlanarBody body{
      .inertia = {.mass = mass, .centre = centre, .polar = mass * (a * a + b * b) / 12}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double integral = test::integral(-a / 2, a / 2, [&](double x) {
        return test::integral(-b / 2, b / 2, [&](double y) {
          const Matrix<2, 4> N = body.shape(centre + Vector<2>(x, y));
          return density * N.col(i).dot(N.col(j));
        });
      });
      CHECK(body.mass_matrix()(i, j) == Approx(integral).margin(1e-14));
    }
}

TEST_CASE("a planar body without an outline is drawn as a square of equal inertia", "[mbs]") {
  const PlanarBody body{.inertia = {.mass = 6, .centre = {1, 2}, .polar = 4}};  // side 2
  CHECK(test::largest_difference(body.outline(0), Vector<2>(0, 1)) < rounding);
  CHECK(test::largest_difference(body.outline(0.5), Vector<2>(2, 3)) < rounding);
  CHECK(test::largest_difference(body.outline(1), Vector<2>(0, 1)) < rounding);
  const PlanarBody line{.inertia = {.mass = 1, .polar = 1}, .outline_points = {{0, 0}, {2, 4}}};
  CHECK(test::largest_difference(line.outline(0.25), Vector<2>(0.5, 1)) < rounding);
}

TEST_CASE("planar bodies refuse what makes no sense, by name and value", "[mbs][fault]") {
  const PlanarBody good{.inertia = {.mass = 1, .polar = 1}};
  const auto complaint = [&](auto change) {
    PlanarBody body = good;
    change(body);
    return test::refusal([&] { body.check(); });
  };
  CHECK(complaint([](PlanarBody&) {}).empty());
  CHECK(complaint([](PlanarBody& b) { b.inertia.mass = 0; }) == "mass = 0: must be positive [kg]");
  CHECK(complaint([](PlanarBody& b) { b.inertia.centre[0] = not_a_number; }) ==
        "centre = nan   0: must be finite [m]");
  CHECK(complaint([](PlanarBody& b) { b.angle = not_a_number; }) ==
        "angle = nan: must be finite [rad]");
  CHECK(complaint([](PlanarBody& b) { b.position[1] = not_a_number; }) ==
        "position =   0 nan: must be finite [m]");
  CHECK_THAT(complaint([](PlanarBody& b) {
               b.outline_points = {{0, 0}};
             }),
             Catch::Contains("outline_points = 1 point"));
}
