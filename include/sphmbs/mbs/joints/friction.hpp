// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/core/expects.hpp>

namespace sphmbs::mbs::joints {

/// Friction of Coulomb and viscous friction against a sliding velocity w, under a normal force of
/// size n, both smoothed at zero:
///   F = mu N tanh(w / w0) + c w,    N = sqrt(n^2 + N0^2) - N0.
/// Nothing sticks: below w0 it creeps.
struct Friction {
  double coefficient = 0;          ///< mu [-]
  double viscous = 0;              ///< c [N s/m]
  double creep_velocity = 1e-2;    ///< w0 [m/s]
  double normal_smoothing = 1e-3;  ///< N0 [N]

  /// The friction force and its derivatives.
  struct Resistance {
    double force;        ///< F [N]
    double by_velocity;  ///< dF/dw [N s/m]
    double by_normal;    ///< (dF/dn) / n, finite at n = 0 [1/N]
  };

  /// At the square of the normal force [N^2] and a velocity [m/s].
  Resistance resistance(double squared_normal, double velocity) const {
    const double root = std::sqrt(squared_normal + normal_smoothing * normal_smoothing);
    const double pressed = coefficient * (root - normal_smoothing);
    const double mobilised = std::tanh(velocity / creep_velocity);
    return {.force = pressed * mobilised + viscous * velocity,
            .by_velocity = pressed * (1 - mobilised * mobilised) / creep_velocity + viscous,
            .by_normal = coefficient * mobilised / root};
  }

  /// @throws InvalidInput for a coefficient below zero, or a smoothing that is not positive.
  void check() const {
    expects(std::isfinite(coefficient) && coefficient >= 0, "friction.coefficient", coefficient,
            "zero or positive [-]");
    expects(std::isfinite(viscous) && viscous >= 0, "friction.viscous", viscous,
            "zero or positive [N s/m]");
    expects(std::isfinite(creep_velocity) && creep_velocity > 0, "friction.creep_velocity",
            creep_velocity, "positive [m/s]");
    expects(std::isfinite(normal_smoothing) && normal_smoothing > 0, "friction.normal_smoothing",
            normal_smoothing, "positive [N]");
  }
};

}  // namespace sphmbs::mbs::joints
