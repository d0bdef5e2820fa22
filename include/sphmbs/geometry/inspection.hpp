// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <vector>

#include <sphmbs/geometry/facets.hpp>

namespace sphmbs::geometry {

/// What a surface looks like, before it is relied on.
template <int Dim>
struct Inspection {
  /// Rim where the surface ends: of a hole, or of a sheet.
  struct Hole {
    std::size_t edges = 0;  ///< open ones; in the plane an open end of an outline
    double rim = 0;         ///< length of all of them [m]
    Vec<Dim> at = {};       ///< the middle of the box around them [m]
    double size = 0;        ///< the diagonal of that box [m]
  };

  std::size_t facets = 0;         ///< all that were given
  Box<Dim> box = {};              ///< around the surface [m]
  double volume = 0;              ///< negative where the surface is inside out [m^3], [m^2]
  std::vector<Hole> holes;        ///< the largest first
  std::size_t branched = 0;       ///< edges of more than two facets
  std::size_t contradicting = 0;  ///< edges whose two facets disagree about which side is inside
  std::size_t duplicate = 0;      ///< facets that are there already, either way round
  std::size_t degenerate = 0;     ///< facets of which corners coincide

  /// Closed, with one inside.
  bool watertight() const {
    return facets > 0 && holes.empty() && branched == 0 && contradicting == 0;
  }
  /// Whether the normals of the facets point inwards on the whole.
  bool inside_out() const { return volume < 0; }
};

namespace detail {

/// Border between neighbouring facets: an edge of a triangle, an end of a segment.
template <int Dim>
struct Ridge {
  std::array<std::uint32_t, Dim - 1> points;  // in ascending order
  int direction;                              // 1 or -1: opposite ones of two facets that agree

  friend bool operator<(const Ridge& a, const Ridge& b) { return a.points < b.points; }
};

inline void add_ridges(std::vector<Ridge<2>>& ridges, const Facets<2>::Corners& c) {
  ridges.push_back({{c[0]}, -1});
  ridges.push_back({{c[1]}, 1});
}

inline void add_ridges(std::vector<Ridge<3>>& ridges, const Facets<3>::Corners& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = c[k], b = c[(k + 1) % 3];
    ridges.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1});
  }
}

/// Joins open ridges that share points to holes.
template <int Dim>
std::vector<typename Inspection<Dim>::Hole> holes(const std::vector<Vec<Dim>>& points,
                                                  const std::vector<Ridge<Dim>>& open) {
  std::map<std::uint32_t, std::uint32_t> leader;  // of each point on a rim
  const auto find = [&](std::uint32_t i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  for (const Ridge<Dim>& ridge : open)
    for (const std::uint32_t point : ridge.points) leader.try_emplace(point, point);
  for (const Ridge<Dim>& ridge : open)
    leader[find(ridge.points.front())] = find(ridge.points.back());

  struct Rim {
    typename Inspection<Dim>::Hole hole;
    Facets<Dim> points;
  };
  std::map<std::uint32_t, Rim> rims;
  for (const Ridge<Dim>& ridge : open) {
    Rim& rim = rims[find(ridge.points.front())];
    const Vec<Dim>&a = points[ridge.points.front()], &b = points[ridge.points.back()];
    ++rim.hole.edges;
    rim.hole.rim += std::sqrt(norm2(b - a));
    rim.points.points.insert(rim.points.points.end(), {a, b});
  }
  std::vector<typename Inspection<Dim>::Hole> found;
  for (auto& [point, rim] : rims) {
    const Box<Dim> box = rim.points.box();
    rim.hole.at = 0.5 * (box.lower + box.upper);
    rim.hole.size = std::sqrt(norm2(box.upper - box.lower));
    found.push_back(rim.hole);
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.size > b.size; });
  return found;
}

/// How many of the facets have the same corners as an earlier one.
template <int Dim>
std::size_t duplicates(std::vector<typename Facets<Dim>::Corners> corners) {
  for (auto& facet : corners) std::sort(facet.begin(), facet.end());
  std::sort(corners.begin(), corners.end());
  return static_cast<std::size_t>(corners.end() - std::unique(corners.begin(), corners.end()));
}

}  // namespace detail

/// Looks a surface over: holes, edges that more than two facets share or that two facets go along
/// in the same direction, facets that are there twice or have no extent. Points count as one where
/// their coordinates are equal.
/// @throws InvalidInput as Facets::check.
template <int Dim>
Inspection<Dim> inspect(const Facets<Dim>& facets) {
  facets.check();
  Facets<Dim> surface = welded(facets);
  Inspection<Dim> seen;
  seen.facets = facets.size();
  seen.box = surface.box();
  seen.volume = volume(surface);
  std::erase_if(surface.corners, [](auto facet) {
    std::sort(facet.begin(), facet.end());
    return std::adjacent_find(facet.begin(), facet.end()) != facet.end();
  });
  seen.degenerate = facets.size() - surface.size();
  seen.duplicate = detail::duplicates<Dim>(surface.corners);

  std::vector<detail::Ridge<Dim>> ridges, open;
  ridges.reserve(Dim * surface.size());
  for (const auto& corners : surface.corners) detail::add_ridges(ridges, corners);
  std::sort(ridges.begin(), ridges.end());
  for (std::size_t i = 0; i < ridges.size();) {
    std::size_t end = i;
    int directions = 0;
    for (; end < ridges.size() && ridges[end].points == ridges[i].points; ++end)
      directions += ridges[end].direction;
    if (end - i == 1) open.push_back(ridges[i]);
    if (end - i == 2 && directions != 0) ++seen.contradicting;
    if (end - i > 2) ++seen.branched;
    i = end;
  }
  seen.holes = detail::holes<Dim>(surface.points, open);
  return seen;
}

}  // namespace sphmbs::geometry
