// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/core/vec.hpp>

#include "support/gas_parameters.hpp"

namespace sphmbs::examples {

/// Place and material of the plates, and the air.
struct PlatesCase {
  Vec<3> corner{3, 1.5, 5};       // of plate I, the one with the smallest coordinates [m]
  double side = 2;                // of each plate [m]
  double thickness = 2e-3;        // [m]
  double density = 1000;          // [kg/m^3]
  double youngs_modulus = 1.0e7;  // [Pa]
  double poisson_ratio = 0.3;
  Vec<3> gravity{0, 0, -9.81};  // [m/s^2]
  Vec<3> channel{10, 5, 7};     // [m]
  StillGas air{.density = 1.293, .pressure = 1e4};

  void add(Parameters& parameters) {
    const auto add = [&](const char* key, double& value, const char* unit, const char* meaning) {
      parameters.add_number(key, value, {.above = 0.0}, unit, meaning);
    };
    parameters.add_vector("plates.corner", corner, {}, "m", "of plate I, nearest to the origin");
    add("plates.side", side, "m", "of each square plate");
    add("plates.thickness", thickness, "m", "of the plates");
    add("plates.density", density, "kg/m^3", "of the plates");
    add("plates.youngs_modulus", youngs_modulus, "Pa", "of the plates");
    parameters.add_number("plates.poisson_ratio", poisson_ratio, {.above = -1.0, .below = 0.5}, "",
                          "of the plates");
    parameters.add_vector("forces.gravity", gravity, {}, "m/s^2", "acceleration by weight");
    parameters.add_vector("channel.size", channel, {.above = 0.0}, "m", "of the channel of air");
    add_still_gas(parameters, air);
  }
  std::vector<Requirement> requirements() const {
    std::vector<Requirement> all;
    const Vec<3> far = corner + Vec<3>{2 * side, side, 0};
    for (int k = 0; k < 3; ++k)
      all.emplace_back(corner[k] > 0 && far[k] < channel[k], "channel.size", channel[k],
                       "so large that the plates lie inside the channel");
    return all;
  }
  bool operator==(const PlatesCase&) const = default;
};

}  // namespace sphmbs::examples
