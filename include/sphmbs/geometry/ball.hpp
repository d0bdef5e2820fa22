// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/geometry/shape.hpp>

namespace sphmbs::geometry {

/// Ball: an interval, a disc or a sphere with its inside [m].
template <int Dim>
struct Ball {
  static constexpr int dim = Dim;  ///< dimension of space
  Vec<Dim> centre;                 ///< [m]
  double radius;                   ///< [m]

  /// Signed distance of x from the surface, exact [m].
  double distance(Vec<Dim> x) const { return std::sqrt(norm2(x - centre)) - radius; }
};

static_assert(Shape<Ball<3>>);

}  // namespace sphmbs::geometry
