// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

namespace sphmbs::examples {

/// A piston of mass m between two closed columns of gas of length L, of density rho and sound speed
/// c: small swings have m w = 2 rho c cot(w L / c). Masses are per area.
struct GasSpring {
  double mass;                          // [kg/m^2]
  double density = 1;                   // [kg/m^3]
  double sound_speed = std::sqrt(1.4);  // [m/s]
  double length = 1;                    // [m]

  /// Of the slowest swing [s].
  double period() const {
    double low = 0, high = std::numbers::pi / 2;  // w L / c
    for (int k = 0; k < 100; ++k) {
      const double x = (low + high) / 2;
      (mass * x * std::tan(x) < 2 * density * length ? low : high) = x;
    }
    return 2 * std::numbers::pi * length / (low * sound_speed);
  }
};

}  // namespace sphmbs::examples
