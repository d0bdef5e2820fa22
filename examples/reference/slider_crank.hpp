// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace sphmbs::examples {

/// Slider-crank of two thin rods and a slider, at rest with both rods in line at t = 0, under a
/// constant torque M on its crank, and its exact motion: the work of the torque is the kinetic
/// energy, M phi = J(phi) (dphi/dt)^2 / 2, with the inertia J seen by the crank. With phi = u^2,
///   du/dt = sqrt(M / (2 J(u^2))),
/// which is smooth, also at the start.
struct SliderCrankMotion {
  double crank = 0.1, rod = 0.3;                               // lengths [m]
  double crank_mass = 0.2, rod_mass = 0.2, slider_mass = 0.4;  // [kg]
  double torque = 0.1;                                         // [N m]

  struct State {
    double angle;   // of the crank [rad]
    double rate;    // of the angle [rad/s]
    double slider;  // distance of the slider from the crank's bearing [m]
  };

  /// Distance of the slider, and its derivative by the angle.
  double slider_at(double angle) const {
    const double s = crank * std::sin(angle);
    return crank * std::cos(angle) + std::sqrt(rod * rod - s * s);
  }
  double slider_slope(double angle) const {
    const double s = crank * std::sin(angle), c = crank * std::cos(angle);
    return -s - s * c / std::sqrt(rod * rod - s * s);
  }

  /// J [kg m^2]; of a thin rod the kinetic energy is m/6 (v_A^2 + v_A v_B + v_B^2) by its ends.
  double inertia(double angle) const {
    const double a = crank, x = slider_slope(angle);
    return crank_mass * a * a / 3 + rod_mass / 3 * (a * a - a * std::sin(angle) * x + x * x) +
           slider_mass * x * x;
  }

  /// The root u of the angle at a time, from what it was at an earlier one [s], by the classical
  /// Runge-Kutta method with steps of at most 1e-4 s, to eleven digits.
  double root(double u, double from, double to) const {
    const auto rate = [this](double x) { return slope(x); };
    const int steps = static_cast<int>(std::ceil((to - from) / 1e-4));
    const double h = steps > 0 ? (to - from) / steps : 0;
    for (int k = 0; k < steps; ++k) {
      const double k1 = rate(u), k2 = rate(u + h / 2 * k1), k3 = rate(u + h / 2 * k2),
                   k4 = rate(u + h * k3);
      u += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return u;
  }

  /// The motion where the root of the angle is u.
  State state(double u) const { return {u * u, 2 * u * slope(u), slider_at(u * u)}; }
  /// The motion at a time [s].
  State at(double t) const { return state(root(0, 0, t)); }

 private:
  double slope(double u) const { return std::sqrt(torque / (2 * inertia(u * u))); }
};

/// The same motion by another code, which solved the equation of the second order for the angle
/// with tolerances of 1e-13: time [s], angle, rate, slider.
inline constexpr std::array<std::array<double, 4>, 5> slider_crank_reference{{
    {0.1, 0.32963387, 5.38465295, 0.392864654},
    {0.2, 0.87394193, 5.44035846, 0.354213934},
    {0.5, 4.07313013, 15.11197228, 0.229406219},
    {1, 14.12789222, 20.53748285, 0.283771692},
    {2, 55.07244379, 39.79557704, 0.292443450},
}};

}  // namespace sphmbs::examples
