// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <sphmbs/geometry/shape.hpp>

namespace sphmbs::geometry {

/// Axis-parallel box between two corners [m].
template <int Dim>
struct Box {
  static constexpr int dim = Dim;  ///< dimension of space
  Vec<Dim> lower;                  ///< corner with the smallest coordinates [m]
  Vec<Dim> upper;                  ///< corner with the largest coordinates [m]

  /// Extent along an axis [m].
  double length(int axis) const { return upper[axis] - lower[axis]; }

  /// The box with every face moved outwards by `t` [m].
  Box grown(double t) const { return {lower - Vec<Dim>::all(t), upper + Vec<Dim>::all(t)}; }

  /// Signed distance of x from the surface, exact [m].
  double distance(Vec<Dim> x) const {
    double outside2 = 0;
    double inside = -1e300;
    for (int k = 0; k < Dim; ++k) {
      const double d = std::max(lower[k] - x[k], x[k] - upper[k]);
      outside2 += d > 0 ? d * d : 0;
      inside = std::max(inside, d);
    }
    return outside2 > 0 ? std::sqrt(outside2) : inside;
  }
};

static_assert(Shape<Box<2>>);

}  // namespace sphmbs::geometry
