// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "support/gas_parameters.hpp"

namespace sphmbs::examples {

/// Lengths [m]; x is 0 at the panel and y on the floor.
struct PanelSetup {
  double height = 0.08;
  double end = 0.265;      // where the channel is closed
  double opening = -0.35;  // where gas comes in, as it is behind the shock
  double shock = -0.05;    // at the start
  double mach = 1.21;      // of the shock
  StillGas ahead{.density = 1.1886, .pressure = 1e5};
  double length = 0.05;            // of the panel
  double thickness = 1e-3;         // of the panel
  double density = 7600;           // of the panel [kg/m^3]
  double youngs_modulus = 2.2e11;  // of the panel [Pa]
  double poisson_ratio = 0;        // of the panel across the plane; 0: a beam

  /// Of the panel, per metre of depth [N m].
  double stiffness() const {
    return youngs_modulus * std::pow(thickness, 3) / 12 / (1 - poisson_ratio * poisson_ratio);
  }
  void add(Parameters& parameters) {
    parameters.add_number("channel.height", height, {.above = 0.0}, "m", "of the channel");
    parameters.add_number("channel.end", end, {.at_least = 0.05}, "m",
                          "where the channel is closed, behind the panel");
    parameters.add_number("channel.opening", opening, {.at_most = -0.05}, "m",
                          "where gas comes in, in front of the panel");
    parameters.add_number("shock.place", shock, {.below = 0.0}, "m",
                          "of the shock at the start, in front of the panel");
    parameters.add_number("shock.mach", mach, {.above = 1.0, .at_most = 10.0}, "", "of the shock");
    add_still_gas(parameters, ahead);
    const auto add = [&](const char* key, double& value, const char* unit, const char* meaning) {
      parameters.add_number(key, value, {.above = 0.0}, unit, meaning);
    };
    add("panel.length", length, "m", "of the panel, upwards from the floor");
    add("panel.thickness", thickness, "m", "of the panel");
    add("panel.density", density, "kg/m^3", "of the panel");
    add("panel.youngs_modulus", youngs_modulus, "Pa", "of the panel");
    parameters.add_number("panel.poisson_ratio", poisson_ratio, {.above = -1.0, .below = 0.5}, "",
                          "of the panel, which is wide; 0 makes it a beam");
  }
  std::vector<Requirement> requirements() const {
    return {{opening < shock, "shock.place", shock, "behind the opening of the channel"},
            {length < height, "panel.length", length,
             "below the height of the channel, " + length_text(height)}};
  }
  bool operator==(const PanelSetup&) const = default;
};

/// The chosen set-up, with what the parameters change of it.
struct PanelChoice {
  std::string setup = "reference";
  PanelSetup own = {};
  int elements = 12;
  std::string coupling = "staggered";

  bool known() const { return setup == "reference" && own == PanelSetup{}; }
};

/// As the reference has it, or as others have computed the experiment.
inline PanelSetup setup_named(const std::string& name) {
  if (name == "reference") return {};
  return {.height = 0.065,
          .end = 0.25,
          .shock = -0.02,
          .ahead = {.density = 1.2, .pressure = 1.01e5},
          .poisson_ratio = 0.3};
}

}  // namespace sphmbs::examples
