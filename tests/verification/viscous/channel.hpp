// SPDX-License-Identifier: MIT
// A plane channel of viscous gas between walls at y = 0 and y = 1, periodic along it and as short
// as the scheme allows. Units: height, density, sound speed and gas constant are 1.
#pragma once

#include <cmath>
#include <cstddef>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/state.hpp"

namespace channel {

using sphmbs::Vec;
using std::numbers::pi;

constexpr double heat_ratio = 1.4;
constexpr double heat_capacity = heat_ratio / (heat_ratio - 1);  // at constant pressure
constexpr double pressure = 1 / heat_ratio;
constexpr double temperature = pressure;
constexpr double prandtl = 1.4;
constexpr int lower = 1;  // sets of virtual particles
constexpr int upper = 2;

template <class Wall, class Riemann = sphmbs::riemann::Acoustic,
          class Limiter = sphmbs::reconstruction::VanLeer>
using Gas =
    sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<2>, Riemann, sphmbs::eos::IdealGas,
                            sphmbs::sph::Shifting, Wall, sphmbs::sph::Newtonian,
                            sphmbs::reconstruction::Muscl<Limiter>, sphmbs::sph::VolumeForm>;

/// Whose temperature is p / rho.
inline sphmbs::eos::IdealGas unit_gas() {
  return {.gamma = heat_ratio, .molar_mass = 1, .gas_constant = 1};
}

/// At pressure 1 / gamma, between walls of one temperature, which keep the heat of friction from
/// thinning the gas near them: adiabatic ones do so by some percent.
template <class Gas>
Gas isothermal(double viscosity) {
  return {.eos = unit_gas(),
          .background = pressure,
          .wall = {.isothermal = true},
          .stress = {.viscosity = viscosity, .conductivity = heat_capacity * viscosity / prandtl}};
}

/// What lies below a height (side 1) or above it (side -1).
struct HalfPlane {
  static constexpr int dim = 2;
  double height;
  double side;

  double distance(const Vec<2>& x) const { return side * (x[1] - height); }
};

/// The upper wall slides in its own plane.
struct Sliding {
  double speed = 0;

  template <class T>
  Vec<2, T> position(sphmbs::boundary::Mark, const Vec<2, T>& r, double, double) const {
    return r;
  }
  template <class T>
  Vec<2, T> velocity(sphmbs::boundary::Mark mark, const Vec<2, T>&, double) const {
    return {static_cast<T>(mark.set == upper ? speed : 0), T(0)};
  }
};

struct Plan {
  int rows;
  double smoothing_ratio = 1.25;

  double spacing() const { return 1.0 / rows; }
  /// Two supports of 3 h, and room for h to grow by 4 %.
  int columns() const { return static_cast<int>(std::ceil(6 * 1.04 * smoothing_ratio)); }
  double length() const { return columns() * spacing(); }
  sphmbs::geometry::Domain<2> domain() const { return {{{0, 0}, {length(), 1}}, {true, false}}; }

  /// Gas at rest between two walls.
  sphmbs::particles::Cloud<2> cloud() const {
    const int layers = static_cast<int>(std::ceil(3 * 1.04 * smoothing_ratio)) + 1;
    std::vector<Vec<2>> gas, below, above;
    for (int i = 0; i < columns(); ++i)
      for (int j = -layers; j < rows + layers; ++j) {
        const Vec<2> x{(i + 0.5) * spacing(), (j + 0.5) * spacing()};
        (j < 0 ? below : j < rows ? gas : above).push_back(x);
      }
    const sphmbs::particles::State<2> still{.rho = 1, .p = pressure, .v = {}};
    const sphmbs::particles::Resolution size{spacing(), smoothing_ratio};
    sphmbs::particles::Cloud<2> cloud;
    cloud.add_gas(gas, still, size);
    cloud.add_virtual(below, still, size, HalfPlane{0, 1});
    cloud.add_virtual(above, still, size, HalfPlane{1, -1});
    return cloud;
  }
};

/// Sets the gas of a cloud in the steady motion of Couette flow.
inline void shear(sphmbs::particles::Cloud<2>& cloud, double speed) {
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.set[i] == sphmbs::particles::gas) cloud.v[i][0] = speed * cloud.r[i][1];
}

template <class Gas>
using Fluid = sphmbs::sph::Fluid<Gas, sphmbs::execution::Serial, Sliding>;

template <class Fluid>
void advance(Fluid& fluid, double until, double cfl = 0.4) {
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = until, .cfl = cfl},
              sphmbs::no_report);
}

/// Difference of the gas from a profile over y, relative L2.
/// @param value  of a particle: value(state, i)
template <class Fluid, class Value, class Exact>
double error(Fluid& fluid, const Value& value, const Exact& exact) {
  const auto state = test::state_of(fluid);
  double difference = 0;
  double size = 0;
  for (std::size_t i = 0; i < fluid.gas_count(); ++i) {
    const double expected = exact(state.r[i][1]);
    const double off = value(state, i) - expected;
    difference += off * off;
    size += expected * expected;
  }
  return std::sqrt(difference / size);
}

/// Velocity along the channel.
inline constexpr auto along = [](const auto& state, std::size_t i) { return state.v[i][0]; };
/// Temperature above that of the walls.
inline constexpr auto warmth = [](const auto& state, std::size_t i) {
  return (heat_ratio - 1) * state.e[i] - temperature;
};

/// Energy of the gas and of the background pressure in its volume.
template <class Fluid>
double energy(Fluid& fluid) {
  const auto totals = fluid.totals();
  return totals.energy() + fluid.scheme().background * totals.volume;
}

/// Orders of convergence of errors at resolutions that double, printed.
inline std::vector<double> orders(const std::string& what, const std::vector<double>& errors) {
  std::vector<double> found;
  std::cout << what << ": errors";
  for (const double e : errors) std::cout << ' ' << 100 * e << " %";
  std::cout << ", orders";
  for (std::size_t i = 1; i < errors.size(); ++i) {
    found.push_back(std::log2(errors[i - 1] / errors[i]));
    std::cout << ' ' << found.back();
  }
  std::cout << '\n';
  return found;
}

}  // namespace channel
