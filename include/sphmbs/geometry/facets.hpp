// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/geometry/box.hpp>

namespace sphmbs::geometry {

/// The corners of one flat piece of a surface [m]: a segment in the plane, a triangle in space.
template <int Dim>
using Facet = std::array<Vec<Dim>, Dim>;

/// A surface in flat pieces, segments in the plane or triangles in space, whose corners are points
/// by number. Seen from outside, the corners of a triangle go anticlockwise; a segment has the
/// inside on its left. The order of the facets is free, and they may leave holes.
template <int Dim>
struct Facets {
  static_assert(Dim == 2 || Dim == 3, "facets are segments in the plane or triangles in space");
  /// Corners of a facet: places in `points`.
  using Corners = std::array<std::uint32_t, Dim>;

  std::vector<Vec<Dim>> points;  ///< corners of facets, shared or not [m]
  std::vector<Corners> corners;  ///< one entry a facet

  /// Number of facets.
  std::size_t size() const { return corners.size(); }

  /// Where the corners of a facet are [m].
  Facet<Dim> operator[](std::size_t facet) const {
    Facet<Dim> places;
    for (std::size_t k = 0; k < Dim; ++k) places[k] = points[corners[facet][k]];
    return places;
  }

  /// The smallest box around the points; empty without any.
  Box<Dim> box() const {
    Box<Dim> around{Vec<Dim>::all(0.0), Vec<Dim>::all(0.0)};
    if (!points.empty()) around = {points[0], points[0]};
    for (const Vec<Dim>& x : points)
      for (int k = 0; k < Dim; ++k) {
        around.lower[k] = std::min(around.lower[k], x[k]);
        around.upper[k] = std::max(around.upper[k], x[k]);
      }
    return around;
  }

  /// @throws InvalidInput for a corner that is no point, or a point that is not finite or so far
  ///         away that its powers are not.
  void check() const {
    for (const Vec<Dim>& x : points)
      for (int k = 0; k < Dim; ++k)
        if (!(std::abs(x[k]) <= farthest))
          throw InvalidInput("point " + std::to_string(&x - points.data()) +
                                 " of a surface: its coordinates must be finite and below 1e30 m",
                             "E154");
    for (const Corners& facet : corners)
      for (const std::uint32_t corner : facet)
        if (corner >= points.size())
          throw InvalidInput("facet " + std::to_string(&facet - corners.data()) +
                                 " of a surface: corner " + std::to_string(corner) +
                                 " must be one of the " + std::to_string(points.size()) + " points",
                             "E154");
  }

  static constexpr double farthest = 1e30;  ///< coordinate that is allowed [m]
};

/// Normal of a facet towards the outside, as long as the facet is large [m], [m^2].
template <int Dim>
Vec<Dim> area_vector(const Facet<Dim>& f) {
  const Vec<Dim> u = f[1] - f[0];
  if constexpr (Dim == 2) {
    return {u[1], -u[0]};
  } else {
    const Vec<Dim> v = f[2] - f[0];
    return {0.5 * (u[1] * v[2] - u[2] * v[1]), 0.5 * (u[2] * v[0] - u[0] * v[2]),
            0.5 * (u[0] * v[1] - u[1] * v[0])};
  }
}

/// Mean of a facet's corners [m].
template <int Dim>
Vec<Dim> centre(const Facet<Dim>& f) {
  Vec<Dim> sum = f[0];
  for (std::size_t k = 1; k < Dim; ++k) sum += f[k];
  return (1.0 / Dim) * sum;
}

/// Volume that the facets enclose, negative where they are inside out [m^3], [m^2] in the plane.
template <int Dim>
double volume(const Facets<Dim>& facets) {
  const Box<Dim> box = facets.box();
  const Vec<Dim> middle = 0.5 * (box.lower + box.upper);  // keeps rounding errors small
  double sum = 0;
  for (std::size_t i = 0; i < facets.size(); ++i)
    sum += dot(area_vector<Dim>(facets[i]), centre<Dim>(facets[i]) - middle);
  return sum / Dim;
}

/// The facets with every point x at map(x): moved, turned, stretched, mirrored.
template <int Dim, class Map>
Facets<Dim> mapped(Facets<Dim> facets, Map&& map) {
  for (Vec<Dim>& x : facets.points) x = map(x);
  return facets;
}

/// The facets with equal points made one, so that neighbours share their corners. Files of
/// triangles that repeat the points of each need this before neighbours can be told.
template <int Dim>
Facets<Dim> welded(const Facets<Dim>& facets) {
  std::vector<std::uint32_t> order(facets.points.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const Vec<Dim>&a = facets.points[i], &b = facets.points[j];
    return std::lexicographical_compare(a.component, a.component + Dim, b.component,
                                        b.component + Dim);
  };
  std::sort(order.begin(), order.end(), less);
  Facets<Dim> result;
  std::vector<std::uint32_t> number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || less(order[k - 1], order[k])) result.points.push_back(facets.points[order[k]]);
    number[order[k]] = static_cast<std::uint32_t>(result.points.size() - 1);
  }
  result.corners = facets.corners;
  for (auto& facet : result.corners)
    for (std::uint32_t& corner : facet) corner = number[corner];
  return result;
}

}  // namespace sphmbs::geometry
