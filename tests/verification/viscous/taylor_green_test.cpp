// SPDX-License-Identifier: MIT
// Decaying Taylor-Green vortices in a periodic square of unit side, density and sound speed:
// velocity exp(-2 nu k^2 t) and kinetic energy exp(-4 nu k^2 t), whatever the amplitude.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <numbers>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/random.hpp"
#include "support/rates.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::Vec;
using sphmbs::sph::Newtonian;

constexpr double k = 2 * std::numbers::pi;
constexpr double heat_ratio = 1.4;
constexpr double pressure = 1 / heat_ratio;
constexpr double speed = 0.05;  // Mach number

using Kernel = sphmbs::kernels::QuinticSpline<2>;
template <class Riemann>
using Smooth =
    sphmbs::sph::RiemannSph<Kernel, Riemann, sphmbs::eos::IdealGas, sphmbs::sph::Shifting,
                            Newtonian, sphmbs::reconstruction::Muscl<>, sphmbs::sph::VolumeForm>;

Vec<2> vortices(const Vec<2>& x) {
  return {std::sin(k * x[0]) * std::cos(k * x[1]), -std::cos(k * x[0]) * std::sin(k * x[1])};
}

struct Plan {
  int per_side;
  double disorder = 0;  // how far particles stray from a lattice [spacings]
  double smoothing_ratio = 1.25;
  double side = 1;
};

sphmbs::particles::Cloud<2> cloud(const Plan& plan) {
  const double spacing = plan.side / plan.per_side;
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(test::cell_centres<2>(plan.per_side, spacing), {.rho = 1, .p = pressure, .v = {}},
                {.spacing = spacing, .smoothing_ratio = plan.smoothing_ratio});
  test::Random random(7);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.r[i] += random.vector<2>(plan.disorder * spacing);
    const Vec<2> x = (1 / plan.side) * cloud.r[i];
    cloud.v[i] = speed * vortices(x);
    // The pressure of the vortices, without which sound would take a share of their energy.
    const double rise = speed * speed / 4 * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1]));
    cloud.p[i] += rise;
    cloud.rho[i] *= 1 + rise;
    cloud.m[i] *= 1 + rise;
  }
  return cloud;
}

struct Decay {
  double viscosity;  // that the decay of kinetic energy tells
  double error;      // of velocity, relative L2
};

/// @param viscosity  that the end of the run and the exact solution follow
/// @param decays     time constants of the kinetic energy until the end
template <class Gas>
Decay decay(const Gas& gas, const Plan& plan, double viscosity, double decays) {
  sphmbs::sph::Fluid<Gas> fluid(gas, test::cube<2>(1, true), cloud(plan));
  const double time = decays / (4 * viscosity * k * k);
  const double before = fluid.totals().kinetic;
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = time}, sphmbs::no_report);
  const double left = fluid.totals().kinetic / before;
  const auto state = test::state_of(fluid);
  const double shrunk = speed * std::exp(-decays / 2);
  double off = 0;
  double size = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec<2> exact = shrunk * vortices(state.r[i]);
    off += norm2(state.v[i] - exact);
    size += norm2(exact);
  }
  return {-std::log(left) / (4 * k * k * time), std::sqrt(off / size)};
}

template <class Riemann>
Smooth<Riemann> smooth(double viscosity) {
  constexpr double heat_capacity = heat_ratio / (heat_ratio - 1);
  return {.eos = {.gamma = heat_ratio, .molar_mass = 1, .gas_constant = 1},
          .background = pressure,
          .stress = {.viscosity = viscosity, .conductivity = heat_capacity * viscosity / 0.7}};
}

}  // namespace

TEST_CASE("the paper's scheme has a numerical viscosity of 0.17 c h", "[viscous]") {
  for (const int n : {16, 32}) {
    const sphmbs::sph::RiemannSph<Kernel, sphmbs::riemann::Acoustic, sphmbs::eos::IdealGas> gas{
        .eos = {.gamma = heat_ratio}};
    const Plan plan{n};
    const double h = plan.smoothing_ratio / n;
    const double found = decay(gas, plan, 0.005, 0.25).viscosity / h;
    std::cout << "Taylor-Green, paper's scheme, " << n << " a side: viscosity / (c h) " << found
              << '\n';
    CHECK(found == Approx(0.17).epsilon(0.1));
  }
}

// Reynolds number 10: vortices decay before they turn, so that particles stay in good order. Found
// are +0.05 % of viscosity and 0.65 % of velocity; a lattice as fine as one likes has +1.2 %, see
// poiseuille_test.cpp, of which the limiter takes as much.
TEST_CASE("viscous vortices decay as they should", "[viscous]") {
  constexpr double viscosity = speed / 10;
  const Decay found =
      decay(smooth<sphmbs::riemann::LimitedAcoustic>(viscosity), {32}, viscosity, 1);
  std::cout << "Taylor-Green, limited acoustic solver, Re 10, 32 a side: viscosity found / given - "
               "1 = "
            << found.viscosity / viscosity - 1 << ", error of velocity " << found.error << '\n';
  CHECK(found.viscosity == Approx(viscosity).epsilon(0.01));
  CHECK(found.error < 0.01);
}

// It goes as c h^3 k^2 where limiters do not act. Found are 55, 8.7 and 2.1 % of the given one, the
// last with the 1.2 % of the lattice.
TEST_CASE("the numerical viscosity of reconstructed gas falls faster than h^2", "[viscous]") {
  constexpr double viscosity = speed / 10;
  std::vector<double> excess;
  for (const int n : {16, 32, 64}) {
    const Decay found = decay(smooth<sphmbs::riemann::Acoustic>(viscosity), {n}, viscosity, 0.5);
    excess.push_back(found.viscosity / viscosity - 1);
    std::cout << "Taylor-Green, acoustic solver, Re 10, " << n
              << " a side: viscosity found / given - 1 = " << excess.back()
              << ", error of velocity " << found.error << '\n';
  }
  std::cout << "orders " << std::log2(excess[0] / excess[1]) << ' '
            << std::log2(excess[1] / excess[2]) << '\n';
  CHECK(excess[1] < excess[0] / 5.5);
  CHECK(excess[2] < excess[1] / 3.6);
  CHECK(excess[2] < 0.025);
}

// Reynolds number 50: gas between vortices is stretched some times over, and only shifting keeps
// the particles apart: without it vortices decay more than twice as fast as they should. Found are
// -0.3 and 0.4 % too much viscosity and 6.5 and 0.9 % error of velocity.
TEST_CASE("shifting keeps vortices alive that stretch their particles", "[viscous][slow]") {
  constexpr double viscosity = speed / 50;
  auto gas = smooth<sphmbs::riemann::LimitedAcoustic>(viscosity);
  gas.smoothing.strength = 1;
  std::vector<double> errors;
  for (const int n : {32, 64}) {
    const Plan plan{.per_side = n, .disorder = 0.2, .smoothing_ratio = 1.5};
    const Decay found = decay(gas, plan, viscosity, 1);
    const double excess = found.viscosity / viscosity - 1;
    errors.push_back(found.error);
    std::cout << "Taylor-Green, limited acoustic solver, Re 50, " << n
              << " a side: viscosity found / given - 1 = " << excess << ", error of velocity "
              << found.error << '\n';
    CHECK(std::abs(excess) < 0.01);
  }
  std::cout << "order " << std::log2(errors[0] / errors[1]) << '\n';
  CHECK(errors[1] < 0.013);
  CHECK(errors[1] < errors[0] / 3);
}

TEST_CASE("vortices do not know the unit of length", "[viscous]") {
  const auto end = [](double side) {
    constexpr int per_side = 16;
    using Gas = Smooth<sphmbs::riemann::Acoustic>;
    const Gas gas = smooth<sphmbs::riemann::Acoustic>(side * speed / 50);
    sphmbs::sph::Fluid<Gas, sphmbs::execution::Serial> fluid(gas, test::cube<2>(side, true),
                                                             cloud({per_side, 0.2, 1.25, side}));
    test::take_steps(fluid, sphmbs::time::PredictorCorrector{}, 20, 0.02 * side);
    return test::state_of(fluid);
  };
  const auto metre = end(1);
  const auto kilometre = end(1000);
  double way = 0;
  double speeds = 0;
  for (std::size_t i = 0; i < metre.size(); ++i) {
    way = std::max(way, test::length(metre.r[i] - 1e-3 * kilometre.r[i]));
    speeds = std::max(speeds, test::length(metre.v[i] - kilometre.v[i]));
  }
  CHECK(way < 1e-9);
  CHECK(speeds < 1e-9 * speed);
}
