// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <sphmbs/geometry/shape.hpp>

namespace sphmbs::geometry {

/// All points within `radius` of the segment from `from` to `to`: a bar with round ends [m].
template <int Dim>
struct Capsule {
  static constexpr int dim = Dim;  ///< dimension of space
  Vec<Dim> from;                   ///< centre of one end [m]
  Vec<Dim> to;                     ///< centre of the other end [m]
  double radius;                   ///< [m]

  /// Signed distance of x from the surface, exact [m].
  double distance(Vec<Dim> x) const {
    const Vec<Dim> along = to - from;
    const double length2 = norm2(along);
    const double s = length2 > 0 ? std::clamp(dot(x - from, along) / length2, 0.0, 1.0) : 0.0;
    return std::sqrt(norm2(x - from - s * along)) - radius;
  }
};

static_assert(Shape<Capsule<2>>);

}  // namespace sphmbs::geometry
