// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/core/expects.hpp>

namespace sphmbs::mbs::forces {

/// One-sided spring and damper that pushes against a depth delta, and never pulls:
///   N = k delta^p max(0, 1 + a delta') for delta > 0,
/// Hunt and Crossley 1975 (Journal of Applied Mechanics 42, 440). A mass that arrives with a speed
/// V << 1 / a leaves with V (1 - 2/3 a V), for every p. With p > 1 its tangent is continuous, which
/// Newton's method likes.
struct Penalty {
  double stiffness = 1e5;  ///< k [N/m^p]
  double exponent = 1.5;   ///< p: 1 linear, 1.5 Hertz's spheres [-]
  double damping = 0;      ///< a [s/m]

  /// The force and its derivatives.
  struct Push {
    double force = 0;        ///< N [N]
    double by_depth = 0;     ///< dN/d delta [N/m]
    double by_rate = 0;      ///< dN/d delta' [N s/m]
    double energy = 0;       ///< k delta^(p + 1) / (p + 1) [J]
    double dissipation = 0;  ///< (N - k delta^p) delta' [W]
  };

  /// At a depth [m] that grows at a rate [m/s]; nothing for a depth of zero or less.
  Push push(double depth, double rate) const {
    if (!(depth > 0)) return {};
    const double slope = stiffness * std::pow(depth, exponent - 1), spring = slope * depth;
    const double energy = spring * depth / (exponent + 1);
    const double factor = 1 + damping * rate;
    if (factor <= 0) return {.energy = energy, .dissipation = -spring * rate};
    return {.force = spring * factor,
            .by_depth = exponent * slope * factor,
            .by_rate = spring * damping,
            .energy = energy,
            .dissipation = spring * damping * rate * rate};
  }

  /// @throws InvalidInput for a stiffness or damping below zero, or an exponent outside [1, 3].
  void check() const {
    expects(std::isfinite(stiffness) && stiffness >= 0, "stiffness", stiffness,
            "zero or positive [N/m^p]");
    expects(exponent >= 1 && exponent <= 3, "exponent", exponent, "between 1 and 3 [-]");
    expects(std::isfinite(damping) && damping >= 0, "damping", damping, "zero or positive [s/m]");
  }
};

}  // namespace sphmbs::mbs::forces
