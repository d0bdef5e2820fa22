// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sphmbs::mbs::ancf {

/// Circular section of one material.
struct CircularSection {
  double radius = 0;          ///< [m]
  double density = 0;         ///< [kg/m^3]
  double youngs_modulus = 0;  ///< [Pa]

  double area() const { return std::numbers::pi * radius * radius; }     ///< [m^2]
  double second_moment() const { return area() * radius * radius / 4; }  ///< [m^4]
};

/// St Venant's torsion constant of a rectangle [m^4], to 1e-6: a b^3 (1/3 - 64/pi^5 (b/a) times the
/// sum over odd n of tanh(n pi a/(2 b))/n^5), a >= b the sides; from n = 3 on tanh is taken as 1
/// (Timoshenko and Goodier, Theory of Elasticity, art. 109).
inline double torsion_constant(double width, double height) {
  constexpr double pi = std::numbers::pi, rest = 0.0045237627951;  // sum of n^-5, n = 3, 5, 7 ...
  const double a = std::max(width, height), b = std::min(width, height);
  const double series = std::tanh(pi * a / (2 * b)) + rest;
  return a * b * b * b * (1.0 / 3 - 64 / (pi * pi * pi * pi * pi) * (b / a) * series);
}

}  // namespace sphmbs::mbs::ancf
