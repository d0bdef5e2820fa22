// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ncf {

/// The point at s in [0, 1] of a polyline; every piece takes the same share of s.
template <int Dim>
Vector<Dim> along(const std::vector<Vector<Dim>>& points, double s) {
  const auto pieces = points.size() - 1;
  const double place = std::clamp(s, 0.0, 1.0) * static_cast<double>(pieces);
  const auto piece = std::min(static_cast<std::size_t>(place), pieces - 1);
  return points[piece] + (place - static_cast<double>(piece)) * (points[piece + 1] - points[piece]);
}

}  // namespace sphmbs::mbs::ncf
