// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/core/vec.hpp>

#include "support/gas_parameters.hpp"

namespace sphmbs::examples {

/// Places, materials and air; B is left of P, and C below B.
struct PendulumCase {
  Vec<2> O{2.98, 6.5}, P{7, 6.5};  // ends of the cable [m]
  double radius = 0.0015;          // of the cable [m]
  double density = 5208.39;        // of the cable [kg/m^3]
  double youngs_modulus = 2.0e11;  // of the cable [Pa]
  double AB = 1, BC = 1;           // lengths of the bars [m]
  double side = 0.0874;            // of the bars' section [m]
  double bar_density = 349.45;     // [kg/m^3]
  Vec<2> gravity{0, -9.81};        // [m/s^2]
  Vec<2> room{10, 10};             // [m]
  StillGas air{.density = 1.293, .pressure = 1e4};

  void add(Parameters& parameters) {
    const auto add = [&](const char* key, double& value, const char* unit, const char* meaning) {
      parameters.add_number(key, value, {.above = 0.0}, unit, meaning);
    };
    parameters.add_vector("cable.from", O, {}, "m", "pinned end O of the cable");
    parameters.add_vector("cable.to", P, {}, "m",
                          "pinned end P, where the pendulum hangs at first");
    add("cable.radius", radius, "m", "of the cable's section");
    add("cable.density", density, "kg/m^3", "of the cable");
    add("cable.youngs_modulus", youngs_modulus, "Pa", "of the cable");
    add("bars.AB", AB, "m", "length of the first bar, level at the start");
    add("bars.BC", BC, "m", "length of the second bar, upright at the start");
    add("bars.side", side, "m", "of the bars' square section");
    add("bars.density", bar_density, "kg/m^3", "of the bars");
    parameters.add_vector("forces.gravity", gravity, {}, "m/s^2", "acceleration by weight");
    parameters.add_vector("room.size", room, {.above = 0.0}, "m", "length and height of the room");
    add_still_gas(parameters, air);
  }
  std::vector<Requirement> requirements() const {
    std::vector<Requirement> all;
    const Vec<2> sizes[] = {O, P, P - Vec<2>{AB, BC}};
    for (const Vec<2>& r : sizes)
      for (int k = 0; k < 2; ++k)
        all.emplace_back(r[k] > 0 && r[k] < room[k], "room.size", room[k],
                         "so large that cable and bars lie inside the room");
    return all;
  }
  bool operator==(const PendulumCase&) const = default;
};

}  // namespace sphmbs::examples
