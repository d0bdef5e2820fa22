// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ancf {

/// Rectangle of count[0] x count[1] equal cells in space, with nodes (i, j) at their corners.
struct Raster {
  Vector<3> origin;          ///< node (0, 0) [m]
  Matrix<3, 2> axes;         ///< orthogonal unit vectors along x and y
  Vector<2> cell;            ///< sides of a cell [m]
  std::array<int, 2> count;  ///< of cells

  /// Place of node (i, j), undeformed [m].
  Vector<3> node(int i, int j) const { return origin + axes * Vector<2>(i * cell[0], j * cell[1]); }

  /// Whether a point is on the rectangle.
  bool covers(const Vector<3>& r) const {
    const Vector<2> x = cells_to(r);
    const Vector<3> foot = origin + axes * x.cwiseProduct(cell);
    return (r - foot).norm() < tolerance * cell.minCoeff() && x.minCoeff() > -tolerance &&
           x[0] < count[0] + tolerance && x[1] < count[1] + tolerance;
  }

  /// The node at a point of the rectangle.
  std::optional<std::array<int, 2>> node_at(const Vector<3>& r) const {
    if (!covers(r)) return {};
    const Vector<2> x = cells_to(r);
    const Vector<2> nearest = x.array().round();
    if ((x - nearest).cwiseAbs().maxCoeff() > tolerance) return {};
    return std::array{static_cast<int>(nearest[0]), static_cast<int>(nearest[1])};
  }

  /// Calls visit(i, j) for all nodes, i fastest.
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    for (int j = 0; j <= count[1]; ++j)
      for (int i = 0; i <= count[0]; ++i) visit(i, j);
  }

 private:
  static constexpr double tolerance = 1e-6;  // of a cell

  Vector<2> cells_to(const Vector<3>& r) const {
    return (axes.transpose() * (r - origin)).cwiseQuotient(cell);
  }
};

}  // namespace sphmbs::mbs::ancf
