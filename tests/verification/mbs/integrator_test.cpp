// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance;
using test::double_pendulum;
using test::PlanarMechanism;

namespace {

/// Angles of the double pendulum of thin bars from the downward vertical and their rates by the
/// classical Runge-Kutta method on Lagrange's equations of the minimal coordinates.
std::array<double, 4> reference_angles(double until) {
  const double g = 9.81;
  const auto rates = [&](const std::array<double, 4>& y) {
    const double c = std::cos(y[0] - y[1]), s = std::sin(y[0] - y[1]);
    // [4/3, c/2; c/2, 1/3] (a1, a2) = (f1, f2)
    const double f1 = -0.5 * s * y[3] * y[3] - 1.5 * g * std::sin(y[0]);
    const double f2 = 0.5 * s * y[2] * y[2] - 0.5 * g * std::sin(y[1]);
    const double det = 4.0 / 9 - c * c / 4;
    return std::array<double, 4>{y[2], y[3], (f1 / 3 - c / 2 * f2) / det,
                                 (4.0 / 3 * f2 - c / 2 * f1) / det};
  };
  std::array<double, 4> y{std::acos(0.0), 0, 0, 0};
  const int n = 20000;
  const double h = until / n;
  const auto moved = [&](const std::array<double, 4>& k, double step) {
    std::array<double, 4> z = y;
    for (std::size_t i = 0; i < 4; ++i) z[i] += step * k[i];
    return z;
  };
  for (int k = 0; k < n; ++k) {
    const auto k1 = rates(y), k2 = rates(moved(k1, h / 2)), k3 = rates(moved(k2, h / 2)),
               k4 = rates(moved(k3, h));
    for (std::size_t i = 0; i < 4; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return y;
}

struct Errors {
  double q, v, lambda;
};

/// Errors of the tip's place and velocity, and of the root's reaction, at 0.5 s.
Errors errors(double spectral_radius, double step) {
  const double until = 0.5;
  PlanarMechanism mechanism = double_pendulum();
  Dynamics<PlanarMechanism, solvers::SparseLDLT> system(mechanism);
  advance(system,
          {.spectral_radius = spectral_radius,
           .newton = {.tolerance = 1e-13, .acceleration_tolerance = 1e-10}},
          until, step);
  const auto [a, b, wa, wb] = reference_angles(until);
  const Vector<2> tip(std::sin(a) + std::sin(b), -std::cos(a) - std::cos(b));
  const Vector<2> velocity(std::cos(a) * wa + std::cos(b) * wb,
                           std::sin(a) * wa + std::sin(b) * wb);
  // The reaction follows from the exact state through the equations of motion.
  PlanarMechanism exact = double_pendulum();
  VectorXd q(8), v(8);
  q << 0, 0, std::sin(a), -std::cos(a), std::sin(a), -std::cos(a), tip;
  v << 0, 0, std::cos(a) * wa, std::sin(a) * wa, std::cos(a) * wa, std::sin(a) * wa, velocity;
  exact.start_from(q, v);
  const Dynamics at_end(exact);
  return {(system.state().q.tail<2>() - tip).norm(), (system.state().v.tail<2>() - velocity).norm(),
          (system.state().lambda - at_end.state().lambda).norm() / at_end.state().lambda.norm()};
}

}  // namespace

TEST_CASE("generalized-alpha is of second order in q, v and lambda on rigid bodies", "[mbs]") {
  for (const double rho : {1.0, 0.8, 0.5, 0.0}) {
    const double h = 2.5e-3;
    const Errors coarse = errors(rho, h), fine = errors(rho, h / 2);
    CAPTURE(rho, fine.q, fine.v, fine.lambda);
    CHECK(std::log2(coarse.q / fine.q) == Approx(2).margin(0.15));
    CHECK(std::log2(coarse.v / fine.v) == Approx(2).margin(0.15));
    CHECK(std::log2(coarse.lambda / fine.lambda) == Approx(2).margin(0.25));
    CHECK(fine.q < 1e-3);
  }
}

TEST_CASE("a pendulum without numerical damping keeps its energy over ten seconds", "[mbs]") {
  PlanarMechanism mechanism;
  mechanism.gravity = {0, -9.81};
  const auto bar = mechanism.add(test::thin_bar({0, 0}, {1, 0}));
  mechanism.add(joints::pinned(bar.start(), mechanism.q(), "root"));
  Dynamics<PlanarMechanism, solvers::SparseLDLT> system(mechanism);
  const double start = system.energies().total();
  const double turnover = 9.81 / 2;  // of potential to kinetic energy [J]
  double largest = 0;
  sphmbs::run(
      system,
      GeneralizedAlpha{.spectral_radius = 1,
                       .newton = {.tolerance = 1e-13, .acceleration_tolerance = 1e-8}},
      {.until = 10, .step = 2e-4}, [](const auto&, const sphmbs::sph::StepLimit&) {},
      sphmbs::Every(0.05, [&](auto& s) {
        largest = std::max(largest, std::abs(s.energies().total() - start));
      }));
  CHECK(largest / turnover < 1e-6);
}
