// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/geometry/box.hpp>

namespace sphmbs::geometry {

/// Evenly spaced points from one end of a line to the other, both ends included.
/// @throws InvalidInput for fewer than two points.
template <int Dim>
std::vector<Vec<Dim>> points_along(const Vec<Dim>& from, const Vec<Dim>& to, int points) {
  expects(points >= 2, "points along a line", points, "at least 2");
  std::vector<Vec<Dim>> all;
  all.reserve(static_cast<std::size_t>(points));
  for (int i = 0; i < points; ++i)
    all.push_back(from + static_cast<double>(i) / (points - 1) * (to - from));
  return all;
}

/// Points of a rectangle, row after row; the borders belong to it.
template <int Dim>
struct PlanePoints {
  std::vector<Vec<Dim>> points;  ///< row after row [m]
  int along_row = 0;             ///< points of a row
  int rows = 0;                  ///< number of rows
};

/// Points on a plane rectangle, about evenly spaced along both sides.
/// @param rectangle  a box that in space has no extent along one axis
/// @param points     along the longer side
/// @throws InvalidInput for a box that is no rectangle, or fewer than two points.
template <int Dim>
PlanePoints<Dim> points_across(const Box<Dim>& rectangle, int points) {
  static_assert(Dim >= 2, "a line has no planes");
  expects(points >= 2, "points along the longer side of a plane", points, "at least 2");
  std::array<int, 2> axis{};
  int sides = 0;
  for (int k = 0; k < Dim; ++k) {
    if (!(rectangle.length(k) > 0)) continue;
    if (sides < 2) axis[static_cast<std::size_t>(sides)] = k;
    ++sides;
  }
  expects(sides == 2, "axes along which a plane extends", sides, "2");
  const double spacing =
      std::max(rectangle.length(axis[0]), rectangle.length(axis[1])) / (points - 1);
  const auto along = [&](int k) {
    return std::max(2, 1 + static_cast<int>(std::lround(rectangle.length(k) / spacing)));
  };
  PlanePoints<Dim> plane{.points = {}, .along_row = along(axis[0]), .rows = along(axis[1])};
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 0; i < plane.along_row; ++i) {
      Vec<Dim> x = rectangle.lower;
      x[axis[0]] += rectangle.length(axis[0]) * i / (plane.along_row - 1);
      x[axis[1]] += rectangle.length(axis[1]) * j / (plane.rows - 1);
      plane.points.push_back(x);
    }
  return plane;
}

}  // namespace sphmbs::geometry
