// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include <sphmbs/particles/state.hpp>

#include "support/parameters.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {

/// An ideal gas at rest.
struct StillGas {
  double density = 1;   // [kg/m^3]
  double pressure = 1;  // [Pa]
  double gamma = 1.4;   // ratio of specific heats [-]

  template <int Dim>
  particles::State<Dim> state() const {
    return {.rho = density, .p = pressure};
  }
  /// [m/s]
  double sound_speed() const { return std::sqrt(gamma * pressure / density); }
  bool operator==(const StillGas&) const = default;
};

inline void add_gamma(Parameters& parameters, double& gamma) {
  parameters.add_number("gas.gamma", gamma, {.above = 1.0}, "", "ratio of specific heats");
}

/// Adds gas.density, gas.pressure and gas.gamma.
inline void add_still_gas(Parameters& parameters, StillGas& gas) {
  parameters.add_number("gas.density", gas.density, {.above = 0.0}, "kg/m^3",
                        "of the gas at the start");
  parameters.add_number("gas.pressure", gas.pressure, {.above = 0.0}, "Pa",
                        "of the gas at the start");
  add_gamma(parameters, gas.gamma);
}

/// A number in meanings and notes: "3 m".
inline std::string length_text(double length) { return format_exact(length) + " m"; }

/// Whether a length is so many whole spacings.
inline bool is_whole(double length, double spacing) {
  return std::abs(length / spacing - std::round(length / spacing)) < 1e-6;
}

}  // namespace sphmbs::examples
