// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace sphmbs::examples {

/// A piston of mass m that gas at rest, of pressure p and sound speed c, drives into a vacuum: a
/// simple wave, exact until the expansion comes back from the far end (Love and Pidduck 1922).
/// Masses are per area.
struct LagrangeGun {
  double mass;         // [kg/m^2]
  double pressure;     // [Pa]
  double sound_speed;  // [m/s]
  double gamma;        // heat capacity ratio [-]

  double velocity(double t) const { return fastest() * (1 - fall(t)); }  // [m/s]
  /// Pressure on the piston [Pa].
  double face_pressure(double t) const {
    return pressure * std::pow(fall(t), 2 * gamma / (gamma - 1));
  }
  /// Way of the piston [m].
  double way(double t) const {
    const double rest = 1 - exponent();
    return fastest() * (t - (std::pow(1 + rate() * t, rest) - 1) / (rate() * rest));
  }

 private:
  double fastest() const { return 2 * sound_speed / (gamma - 1); }
  double rate() const { return (gamma + 1) * pressure / (2 * mass * sound_speed); }
  double exponent() const { return (gamma - 1) / (gamma + 1); }
  /// Sound speed at the piston by that at rest [-].
  double fall(double t) const { return std::pow(1 + rate() * t, -exponent()); }
};

}  // namespace sphmbs::examples
