// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ancf {

/// Derivatives of the cubic Hermite polynomials on [0, 1], of order Order (0 to 3), in the order
/// value at 0, slope at 0, value at 1, slope at 1.
template <int Order>
constexpr std::array<double, 4> hermite(double xi) {
  static_assert(Order >= 0 && Order <= 3, "cubics have three derivatives");
  const double x2 = xi * xi, x3 = x2 * xi;
  if constexpr (Order == 0)
    return {1 - 3 * x2 + 2 * x3, xi - 2 * x2 + x3, 3 * x2 - 2 * x3, x3 - x2};
  else if constexpr (Order == 1)
    return {6 * (x2 - xi), 1 - 4 * xi + 3 * x2, 6 * (xi - x2), 3 * x2 - 2 * xi};
  else if constexpr (Order == 2)
    return {12 * xi - 6, 6 * xi - 4, 6 - 12 * xi, 6 * xi - 2};
  else
    return {12, 6, -12, 6};
}

/// The same on [0, length]: d^Order/dx^Order at x = xi length of the cubic with given values and
/// slopes d/dx at the ends.
template <int Order>
constexpr std::array<double, 4> hermite(double xi, double length) {
  std::array<double, 4> h = hermite<Order>(xi);
  double scale = 1;
  for (int k = 0; k < Order; ++k) scale /= length;
  h[0] *= scale;
  h[2] *= scale;
  h[1] *= scale * length;
  h[3] *= scale * length;
  return h;
}

/// Integral from 0 to length of the products of these polynomials.
constexpr std::array<std::array<double, 4>, 4> hermite_products(double length) {
  const double a = length, b = length * length, c = b * length;
  return {{{13 * a / 35, 11 * b / 210, 9 * a / 70, -13 * b / 420},
           {11 * b / 210, c / 105, 13 * b / 420, -c / 140},
           {9 * a / 70, 13 * b / 420, 13 * a / 35, -11 * b / 210},
           {-13 * b / 420, -c / 140, -11 * b / 210, c / 105}}};
}

/// Integral from 0 to length of these polynomials.
constexpr std::array<double, 4> hermite_integrals(double length) {
  return {length / 2, length * length / 12, length / 2, -length * length / 12};
}

/// N = [s_1 I, s_2 I, ...] of scalar shape functions.
template <int Dim, std::size_t n>
Matrix<Dim, Dim* static_cast<int>(n)> shape_matrix(const std::array<double, n>& s) {
  Matrix<Dim, Dim* static_cast<int>(n)> N;
  for (std::size_t k = 0; k < n; ++k)
    N.template middleCols<Dim>(Dim * static_cast<int>(k)) = s[k] * Matrix<Dim, Dim>::Identity();
  return N;
}

}  // namespace sphmbs::mbs::ancf
