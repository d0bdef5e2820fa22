// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/geometry/shape.hpp>

namespace sphmbs::geometry {

/// Plane polygon by its corners in order, either way round; closed by itself [m]. Inside is where
/// a ray crosses the outline an odd number of times.
class Polygon {
 public:
  static constexpr int dim = 2;  ///< dimension of space

  /// @throws InvalidInput for fewer than three corners.
  explicit Polygon(std::vector<Vec<2>> corners) : corners_(std::move(corners)) {
    expects(corners_.size() >= 3, "polygon corners", corners_.size(), "at least 3");
  }

  /// Signed distance of x from the outline, exact [m].
  double distance(Vec<2> x) const {
    bool inside = false;
    double nearest2 = 1e300;
    Vec<2> a = corners_.back();
    for (const Vec<2>& b : corners_) {
      const Vec<2> along = b - a;
      const double length2 = norm2(along);
      const double s = length2 > 0 ? std::clamp(dot(x - a, along) / length2, 0.0, 1.0) : 0.0;
      nearest2 = std::min(nearest2, norm2(x - a - s * along));
      const bool crosses = (a[1] > x[1]) != (b[1] > x[1]);
      if (crosses && x[0] < a[0] + (x[1] - a[1]) / along[1] * along[0]) inside = !inside;
      a = b;
    }
    return (inside ? -1 : 1) * std::sqrt(nearest2);
  }

 private:
  std::vector<Vec<2>> corners_;
};

static_assert(Shape<Polygon>);

}  // namespace sphmbs::geometry
