// SPDX-License-Identifier: MIT
// Order of the integrators in time, on the gas itself. The particles stay the same, so that the
// error in space is the same in all runs and only that of the steps is left between them.
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::Vec;

constexpr double heat_ratio = 1.4;
constexpr double k = 2 * sphmbs::math::pi;  // one wave in a box of unit length

/// Gas of unit density and sound speed in a periodic box of unit length, at the moment when a
/// standing sound wave of the given amplitude (velocity / sound speed) has no pressure.
template <int Dim>
sphmbs::particles::Cloud<Dim> standing_wave(int per_side, double amplitude) {
  auto cloud = test::lattice_cloud<Dim>(per_side, 1.0 / per_side, {.rho = 1, .p = 1 / heat_ratio});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec<Dim>& x = cloud.r[i];
    if constexpr (Dim == 1) {
      cloud.v[i] = {amplitude * std::sin(k * x[0])};
    } else {
      cloud.v[i] = {amplitude * std::sin(k * x[0]) * std::cos(k * x[1]),
                    amplitude * std::cos(k * x[0]) * std::sin(k * x[1])};
    }
  }
  return cloud;
}

template <int Dim>
struct Run {
  test::State<Dim> state;
  double energy_drift;    // share of the initial energy
  double momentum_drift;  // share of sum m |v|
};

template <int Dim, class Integrator>
Run<Dim> run(const Integrator& integrator, const sphmbs::particles::Cloud<Dim>& cloud, double until,
             int steps) {
  sphmbs::sph::Fluid<test::Gas<Dim>, sphmbs::execution::Serial> fluid(
      test::Gas<Dim>{.eos = {.gamma = heat_ratio}}, test::cube<Dim>(1, true), cloud);
  const auto start = fluid.totals();
  double size = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) size += cloud.m[i] * test::length(cloud.v[i]);
  test::take_steps(fluid, integrator, steps, until / steps);
  const auto end = fluid.totals();
  return {test::state_of(fluid), (end.energy() - start.energy()) / start.energy(),
          test::length(end.momentum - start.momentum) / size};
}

/// Root mean square of the differences of all fields, each in units of the gas at rest (lengths in
/// those of the box, smoothing lengths in those of their mean).
template <int Dim>
double distance(const test::State<Dim>& a, const test::State<Dim>& b) {
  const auto period = test::cube<Dim>(1, true).template periodicity<double>();
  const double h = 1.25 / std::pow(static_cast<double>(a.size()), 1.0 / Dim);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double drho = a.rho[i] - b.rho[i];
    const double de = a.e[i] - b.e[i];
    const double dh = (a.h[i] - b.h[i]) / h;
    sum += norm2(period.nearest(a.r[i] - b.r[i])) + norm2(a.v[i] - b.v[i]) + drho * drho + de * de +
           dh * dh;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// log2 of the ratio of errors of two runs, the second with half the step.
double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

// How far an observed order may lie from the method's: at a Courant number of 0.2, the next term of
// the errors is some per cent of the leading one.
constexpr double slack = 0.15;

// Runs with steps dt, dt/2 and dt/4 against one with dt/32 of the third-order method, whose error
// is below 1/500 of theirs. The right-hand side conserves momentum and energy, so that the energy
// drifts by what the steps do to it: at least with the order of the method.
template <int Dim, class Integrator>
void check_order(const std::string& name, const Integrator& integrator, double expected,
                 int per_side, double amplitude) {
  const auto cloud = standing_wave<Dim>(per_side, amplitude);
  const double until = 0.25;  // a quarter of a period in one dimension
  const int steps = per_side;
  const auto fine = run<Dim>(sphmbs::time::ShuOsher{}, cloud, until, 32 * steps);
  double error[3];
  double drift[3];
  for (int level = 0; level < 3; ++level) {
    const auto result = run<Dim>(integrator, cloud, until, steps << level);
    error[level] = distance(result.state, fine.state);
    drift[level] = result.energy_drift;
    CHECK(result.momentum_drift < 1e-13);  // some hundred roundings
  }
  std::cout << "order in time, " << Dim << "D, amplitude " << amplitude << ", " << name
            << ": error " << error[0] << ' ' << error[1] << ' ' << error[2] << ", order "
            << order(error[0], error[1]) << ' ' << order(error[1], error[2]) << "; energy drift "
            << drift[0] << ' ' << drift[1] << ' ' << drift[2] << ", order "
            << order(drift[0], drift[1]) << ' ' << order(drift[1], drift[2]) << '\n';
  CAPTURE(name, Dim, amplitude, error[0], error[1], error[2], drift[0], drift[1], drift[2]);
  for (int level = 0; level < 2; ++level) {
    CHECK(order(error[level], error[level + 1]) == Approx(expected).margin(slack).epsilon(0));
    CHECK(order(drift[level], drift[level + 1]) >= expected - slack);
  }
}

template <int Dim>
void check_all(int per_side, double amplitude) {
  check_order<Dim>("PredictorCorrector", sphmbs::time::PredictorCorrector{}, 2, per_side,
                   amplitude);
  check_order<Dim>("Heun", sphmbs::time::Heun{}, 2, per_side, amplitude);
  check_order<Dim>("ShuOsher", sphmbs::time::ShuOsher{}, 3, per_side, amplitude);
}

}  // namespace

TEST_CASE("integrators have their order on a standing sound wave in 1D", "[time]") {
  check_all<1>(32, 1e-3);
  check_all<1>(32, 0.1);
}

TEST_CASE("integrators have their order on a standing sound wave in 2D", "[time]") {
  check_all<2>(16, 1e-3);
  check_all<2>(16, 0.1);
}
