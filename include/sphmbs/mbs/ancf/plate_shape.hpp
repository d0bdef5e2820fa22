// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include <sphmbs/mbs/ancf/quadrature.hpp>

namespace sphmbs::mbs::ancf {

namespace detail {

template <class T, int n>
using Array = T[static_cast<std::size_t>(n)];

/// The functions of one end of a line s in [0, 1] that polynomials of plates are products of, or
/// their first or second derivative. `end` is 0 or 1. `linear` and `cubic` are 1 at this end and 0
/// at the other, `cubic` with no slope at either; `slope` has the slope 1 at this end and is 0
/// otherwise (Hermite).
struct LineFunctions {
  double linear, cubic, slope;

  constexpr LineFunctions(int end, double s, int derivative) : linear(0), cubic(0), slope(0) {
    const double sign = end == 1 ? 1 : -1;
    const double u = end == 1 ? s : 1 - s;
    if (derivative == 0) {
      linear = u;
      cubic = u * u * (3 - 2 * u);
      slope = sign * u * u * (u - 1);
    } else if (derivative == 1) {
      linear = sign;
      cubic = sign * 6 * u * (1 - u);
      slope = u * (3 * u - 2);
    } else {
      cubic = 6 - 12 * u;
      slope = sign * (6 * u - 2);
    }
  }
};

}  // namespace detail

/// Polynomials of Adini, Clough and Melosh, complete up to the third degree, which Dmitrochenko and
/// Pogorelov (2003) take for the thin plate with r, r_x, r_y at its nodes. The surface is
/// continuous between elements; its normal is continuous at nodes and along edges only nearly so.
struct Acm {
  static constexpr int node_functions = 3;  ///< of r, r_x, r_y

  /// Function f of the node at the ends i, j of the unit square, differentiated ds and dt times.
  static constexpr double value(int f, int i, int j, double s, double t, int ds, int dt) {
    const detail::LineFunctions x(i, s, ds), y(j, t, dt);
    if (f == 1) return x.slope * y.linear;
    if (f == 2) return x.linear * y.slope;
    return x.cubic * y.linear + x.linear * y.cubic - x.linear * y.linear;
  }
};

/// Bicubic Hermite polynomials (Bogner, Fox and Schmit 1965) for plates with r, r_x, r_y, r_xy at
/// their nodes: the surface and its normal are continuous.
struct Bicubic {
  static constexpr int node_functions = 4;  ///< of r, r_x, r_y, r_xy

  /// As Acm::value.
  static constexpr double value(int f, int i, int j, double s, double t, int ds, int dt) {
    const detail::LineFunctions x(i, s, ds), y(j, t, dt);
    return (f % 2 == 1 ? x.slope : x.cubic) * (f >= 2 ? y.slope : y.cubic);
  }
};

/// The functions of a family on the unit square, node by node in the order (0, 0), (1, 0), (1, 1),
/// (0, 1), as r, r_s, r_t (and r_st) at the node ask for.
template <class Shape>
struct PlateFunctions {
  static constexpr int size = 4 * Shape::node_functions;      ///< number of functions
  static constexpr std::array<int, 4> node_i = {0, 1, 1, 0};  ///< s of the nodes
  static constexpr std::array<int, 4> node_j = {0, 0, 1, 1};  ///< t of the nodes

  /// Function k at (s, t), or its derivative of order ds in s and dt in t.
  static constexpr double value(int k, double s, double t, int ds = 0, int dt = 0) {
    const auto node = static_cast<std::size_t>(k / Shape::node_functions);
    return Shape::value(k % Shape::node_functions, node_i[node], node_j[node], s, t, ds, dt);
  }
};

/// What a plate element needs of its functions at the points of the n x n Gauss rule: constants of
/// the family, the same for all elements. Points are the fastest index, for packs of them.
template <class Shape, int n>
struct PlateTable {
  static constexpr int functions = PlateFunctions<Shape>::size;  ///< number of functions
  static constexpr int points = n * n;                           ///< of the Gauss rule
  static constexpr int derivatives = 5;                          ///< d/ds, d/dt, dss, dtt, dst
  static constexpr std::array<int, 5> ds = {1, 0, 2, 0, 1};      ///< orders of derivatives in s
  static constexpr std::array<int, 5> dt = {0, 1, 0, 2, 1};      ///< orders of derivatives in t

  using AtPoints = detail::Array<double, points>;  ///< a number for each point of the rule
  alignas(64) AtPoints weight = {};                ///< sum 1
  /// Of the functions.
  alignas(64) detail::Array<AtPoints, functions> value = {};
  /// Of the functions, in the order of `ds` and `dt`.
  alignas(64) detail::Array<AtPoints, functions> derivative[derivatives] = {};

  constexpr PlateTable() {
    for (int p = 0; p < points; ++p) {
      const auto i = static_cast<std::size_t>(p % n), j = static_cast<std::size_t>(p / n);
      const double s = gauss<n>.point[i], t = gauss<n>.point[j];
      weight[p] = gauss<n>.weight[i] * gauss<n>.weight[j];
      for (int k = 0; k < functions; ++k) {
        value[k][p] = PlateFunctions<Shape>::value(k, s, t);
        for (std::size_t m = 0; m < derivatives; ++m)
          derivative[m][k][p] = PlateFunctions<Shape>::value(k, s, t, ds[m], dt[m]);
      }
    }
  }

  /// Integral over the unit square of function k, or of the product of two: exact for n >= 4.
  constexpr double integral(int k) const {
    double sum = 0;
    for (int p = 0; p < points; ++p) sum += weight[p] * value[k][p];
    return sum;
  }
  /// Integral over the unit square of functions k and l, multiplied.
  constexpr double integral(int k, int l) const {
    double sum = 0;
    for (int p = 0; p < points; ++p) sum += weight[p] * (value[k][p] * value[l][p]);
    return sum;
  }
};

template <class Shape, int n>
inline constexpr PlateTable<Shape, n> plate_table{};

}  // namespace sphmbs::mbs::ancf
