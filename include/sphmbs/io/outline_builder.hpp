// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include <sphmbs/core/math.hpp>
#include <sphmbs/geometry/facets.hpp>

namespace sphmbs::io::detail {

/// A curve of third degree by its control points.
struct Cubic {
  Vec<2> from, towards, away, to;
};

/// A piece of an ellipse: centre + cos(angle) first + sin(angle) second.
struct EllipseArc {
  Vec<2> centre, first, second;
  double begin, turn;  // [rad]
  Vec<2> to;           // its end, free of rounding
};

/// Puts closed loops together from points and curves, which become straight pieces.
class OutlineBuilder {
 public:
  /// @param tolerance  how far the pieces of a curve may lie from it [m]
  explicit OutlineBuilder(double tolerance) : tolerance_(tolerance) {}

  void reserve(std::size_t points) {
    outline_.points.reserve(points);
    outline_.corners.reserve(points);
  }
  std::size_t size() const { return outline_.points.size(); }

  /// A corner of the loop; the same one again changes nothing.
  void line(const Vec<2>& to) {
    if (size() == begin_ || outline_.points.back() != to) outline_.points.push_back(to);
  }

  void cubic(const Cubic& c) {
    // A piece's chord is off by at most an eighth of its squared parameter times the curvature.
    const double bend = 6 * std::sqrt(std::max(norm2(c.from - 2.0 * c.towards + c.away),
                                               norm2(c.towards - 2.0 * c.away + c.to)));
    const int n = pieces(std::sqrt(bend / (8 * tolerance_)));
    for (int k = 1; k < n; ++k) {
      const double t = static_cast<double>(k) / n, s = 1 - t;
      line((s * s * s) * c.from + (3 * s * s * t) * c.towards + (3 * s * t * t) * c.away +
           (t * t * t) * c.to);
    }
    line(c.to);
  }

  void arc(const EllipseArc& a) {
    const double radius = std::sqrt(std::max(norm2(a.first), norm2(a.second)));
    const double step = 2 * std::acos(1 - std::min(tolerance_ / radius, 0.5));
    const int n = pieces(std::max(std::abs(a.turn) / step, std::abs(a.turn) / 1.6));
    for (int k = 1; k < n; ++k) {
      const double angle = a.begin + a.turn * k / n;
      line(a.centre + std::cos(angle) * a.first + std::sin(angle) * a.second);
    }
    line(a.to);
  }

  /// Joins the last corner to the first one. Returns how many corners the loop has; one of fewer
  /// than three is left out.
  std::size_t close() {
    if (size() > begin_ + 1 && outline_.points.back() == outline_.points[begin_])
      outline_.points.pop_back();
    const std::size_t corners = size() - begin_;
    if (corners < 3) {
      outline_.points.resize(begin_);
      return corners;
    }
    for (std::size_t k = begin_; k < size(); ++k) {
      const std::size_t next = k + 1 < size() ? k + 1 : begin_;
      outline_.corners.push_back({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(next)});
    }
    begin_ = size();
    return corners;
  }

  geometry::Facets<2> finish() { return std::move(outline_); }

 private:
  // A curve that wants more than a thousand is much larger than the outline's corners are apart;
  // what is no number comes from one without extent.
  static int pieces(double wanted) {
    return wanted > 1 ? static_cast<int>(std::ceil(std::min(wanted, 1000.0))) : 1;
  }

  double tolerance_;
  geometry::Facets<2> outline_;
  std::size_t begin_ = 0;  // first point of the loop
};

}  // namespace sphmbs::io::detail
