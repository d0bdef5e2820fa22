// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/mbs/ncf/readout.hpp>
#include <sphmbs/mbs/ncf/rod.hpp>

#include "support/body_laws.hpp"
#include "support/errors.hpp"
#include "support/quadrature.hpp"

namespace {

using namespace sphmbs::mbs;
using ncf::Bar;
using ncf::Rod;

constexpr double rounding = 1e-13;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Bar random_bar(test::Random& random) {
  const Vector<2> from = test::random_vector<2>(random, 3);
  const double angle = random.between(-3, 3), length = random.between(0.5, 2);
  return {.from = from,
          .to = from + length * Vector<2>(std::cos(angle), std::sin(angle)),
          .inertia = ncf::PlanarInertia{.mass = random.between(0.5, 2),
                                        .centre = test::random_vector<2>(random),
                                        .polar = random.between(0.1, 1)},
          .velocity = test::random_vector<2>(random, 5),
          .angular_velocity = random.between(-5, 5)};
}

}  // namespace

TEST_CASE("a bar starts rigid, as fast as it is told", "[mbs]") {
  test::Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Bar bar = random_bar(random);
    test::check_start(bar);
    test::check_rigidity_derivatives(bar, random);
    test::check_translation(bar, test::random_vector<2>(random), bar.inertia->mass);
    Structure<Bar> structure;
    const auto placed = structure.add(bar);
    const VectorXd q = structure.q(), v = structure.v();
    const Vector<2> e = bar.to - bar.from;
    CHECK(ncf::angle(placed, q) == Approx(std::atan2(e[1], e[0])).margin(rounding));
    CHECK(ncf::angular_velocity(placed, q, v) == Approx(bar.angular_velocity).epsilon(1e-12));
    CHECK(test::largest_difference(placed.start().at(q), bar.from) < rounding);
    CHECK(test::largest_difference(placed.end().at(q), bar.to) < rounding);
    CHECK(test::largest_difference(placed.start().rate(v), bar.velocity) < rounding);
    const Matrix<2, 2> R = ncf::rotation(placed, q);
    CHECK(test::largest_difference(R.transpose() * R, Matrix<2, 2>::Identity()) < rounding);
    CHECK(R.determinant() == Approx(1).epsilon(rounding));
  }
}

TEST_CASE("the rigidity of a bar is its change of length, to first order", "[mbs]") {
  const Bar bar{.from = {0, 0}, .to = {2, 0}, .density = 1, .area = 1};
  constexpr double stretch = 1e-6;
  const Vector<4> q(0, 0, 2 + stretch, 0);
  CHECK(bar.rigidity(q)[0] == Approx(stretch).epsilon(stretch));
}

TEST_CASE("the kinetic energy of a bar is that of its mass and of its moment of inertia", "[mbs]") {
  test::Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Bar bar = random_bar(random);
    const auto& p = *bar.inertia;
    const Vector<2> v_centre = bar.shape(p.centre) * bar.initial_rates();
    const double w = bar.angular_velocity;
    CHECK(test::kinetic_energy(bar) ==
          Approx(0.5 * p.mass * v_centre.squaredNorm() + 0.5 * p.polar * w * w).epsilon(1e-12));
    const Vector<2> momentum =
        Bar::translation().transpose() * (bar.mass_matrix() * bar.initial_rates());
    CHECK(test::largest_difference(momentum, p.mass * v_centre) < 1e-12);
  }
}

TEST_CASE("the mass matrix of a prismatic bar is the integral of rho N^T N", "[mbs]") {
  const Bar bar{.from = {1, 2}, .to = {-0.5, 3}, .density = 7.5, .area = 0.02, .height = 0.3};
  const double L = bar.length();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double integral = test::integral(0, L, [&](double x) {
        return test::integral(-0.15, 0.15, [&](double y) {
          const Matrix<2, 4> N = bar.shape({x, y});
          return 7.5 * 0.02 / 0.3 * N.col(i).dot(N.col(j));
        });
      });
      CHECK(bar.mass_matrix()(i, j) == Approx(integral).margin(1e-14));
    }
}

TEST_CASE("a uniform thin bar has the mass matrix m/6 [2 1; 1 2]", "[mbs]") {
  const Bar bar{.from = {0, 0}, .to = {3, 4}, .density = 2, .area = 0.6};
  const Matrix<2, 2> one = Matrix<2, 2>::Identity();
  Matrix<4, 4> M;
  M << 2 * one, one, one, 2 * one;
  CHECK(test::largest_difference(bar.mass_matrix(), M) < rounding);
}

TEST_CASE("a rod in space starts rigid and has the energy of a thin rod", "[mbs]") {
  test::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Rod rod{.from = test::random_vector<3>(random),
                  .to = test::random_vector<3>(random, 2),
                  .density = 3,
                  .area = 0.1,
                  .velocity = test::random_vector<3>(random),
                  .angular_velocity = test::random_vector<3>(random)};
    test::check_start(rod);
    test::check_rigidity_derivatives(rod, random);
    test::check_translation(rod, Vector<1>(0.3), rod.mass());
    const Vector<3> d = rod.to - rod.from;
    const Vector<3> v = rod.velocity + rod.angular_velocity.cross(d / 2);
    const double spinning = rod.mass() / 24 * rod.angular_velocity.cross(d).squaredNorm();
    CHECK(test::kinetic_energy(rod) ==
          Approx(0.5 * rod.mass() * v.squaredNorm() + spinning).epsilon(1e-12));
    CHECK(test::regularity(rod.mass_matrix(), rod.rigidity_jacobian(rod.initial_coordinates())) >
          1e-3);
  }
}

TEST_CASE("bars and rods refuse what makes no sense, by name and value", "[mbs][fault]") {
  using test::refusal;
  const Bar good{.from = {0, 0}, .to = {1, 0}, .density = 1, .area = 1};
  const auto complaint = [&](auto change) {
    Bar bar = good;
    change(bar);
    return refusal([&] { bar.check(); });
  };
  CHECK(complaint([](Bar&) {}).empty());
  CHECK(complaint([](Bar& b) { b.to = b.from; }) == "length = 0: must be positive [m]");
  CHECK(complaint([](Bar& b) { b.from[1] = not_a_number; }) ==
        "from =   0 nan: must be finite [m]");
  CHECK(complaint([](Bar& b) { b.density = -1; }) == "density = -1: must be positive [kg/m^3]");
  CHECK(complaint([](Bar& b) { b.area = 0; }) == "area = 0: must be positive [m^2]");
  CHECK(complaint([](Bar& b) { b.height = -1; }) == "height = -1: must be not negative [m]");
  CHECK(complaint([](Bar& b) { b.velocity[0] = not_a_number; }) ==
        "velocity = nan   0: must be finite [m/s]");
  CHECK(complaint([](Bar& b) { b.angular_velocity = not_a_number; }) ==
        "angular_velocity = nan: must be finite [rad/s]");
  CHECK_THAT(complaint([](Bar& b) { b.inertia = ncf::PlanarInertia{.mass = 1, .polar = 1}; }),
             Catch::Contains("left out where inertia is given"));
  const auto given = [&](double mass, double polar) {
    return complaint([&](Bar& b) {
      b.density = b.area = 0;
      b.inertia = ncf::PlanarInertia{.mass = mass, .polar = polar};
    });
  };
  CHECK(given(-2, 1) == "mass = -2: must be positive [kg]");
  CHECK(given(not_a_number, 1) == "mass = nan: must be positive [kg]");
  CHECK(given(1, -1) == "polar = -1: must be not negative [kg m^2]");
  CHECK(given(1, 0).empty());

  Structure<Bar> structure;
  CHECK(refusal([&] {
          structure.add(Bar{.from = {1, 1}, .to = {1, 1}, .density = 1, .area = 1});
        }) == "bar 0: length = 0: must be positive [m]");
  const Rod rod{.from = {0, 0, 0}, .to = {1, 0, 0}, .density = 1, .area = -1};
  CHECK(refusal([&] { rod.check(); }) == "area = -1: must be positive [m^2]");
}
