// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <sphmbs/core/math.hpp>
#include <sphmbs/geometry/facets.hpp>

/// What a point sees of one facet: its nearest point, and the share of the whole view it takes.
namespace sphmbs::geometry {

/// The point of a segment, with its ends, that is nearest to x.
template <int Dim>
Vec<Dim> nearest_on_segment(const Vec<Dim>& a, const Vec<Dim>& b, const Vec<Dim>& x) {
  const Vec<Dim> along = b - a;
  const double length2 = norm2(along);
  const double s = length2 > 0 ? std::clamp(dot(x - a, along) / length2, 0.0, 1.0) : 0.0;
  return a + s * along;
}

/// The point of a segment that is nearest to x [m].
inline Vec<2> nearest_on(const Facet<2>& f, const Vec<2>& x) {
  return nearest_on_segment(f[0], f[1], x);
}

/// The point of a triangle that is nearest to x: which of the regions of its corners, edges and
/// face holds x is told by signs (Ericson, Real-Time Collision Detection, 2005, sect. 5.1.5).
inline Vec<3> nearest_on(const Facet<3>& f, const Vec<3>& x) {
  const Vec<3> ab = f[1] - f[0], ac = f[2] - f[0], ax = x - f[0];
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return f[0];
  const Vec<3> bx = x - f[1];
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return f[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return f[0] + (d1 / (d1 - d3)) * ab;
  const Vec<3> cx = x - f[2];
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return f[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return f[0] + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return f[1] + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (f[2] - f[1]);
  const double sum = va + vb + vc;
  return f[0] + (vb / sum) * ab + (vc / sum) * ac;
}

/// Share of the view from x that a segment covers, positive where x is on its inner side: the
/// angle it is seen under by a full turn.
inline double share_of_view(const Facet<2>& f, const Vec<2>& x) {
  const Vec<2> a = f[0] - x, b = f[1] - x;
  return std::atan2(a[0] * b[1] - a[1] * b[0], dot(a, b)) / (2 * math::pi);
}

/// The same of a triangle: its solid angle by that of the whole sphere (van Oosterom and Strackee,
/// IEEE Trans. Biomed. Eng. 30, 1983).
inline double share_of_view(const Facet<3>& f, const Vec<3>& x) {
  const Vec<3> a = f[0] - x, b = f[1] - x, c = f[2] - x;
  const double la = std::sqrt(norm2(a)), lb = std::sqrt(norm2(b)), lc = std::sqrt(norm2(c));
  const double triple = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0]);
  const double parallel = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return std::atan2(triple, parallel) / (2 * math::pi);
}

/// Share of the view that a small or distant piece of surface covers, by its area vector alone.
/// @param to  from the point that looks to the piece
template <int Dim>
double distant_share(const Vec<Dim>& area, const Vec<Dim>& to) {
  const double r2 = norm2(to);
  if constexpr (Dim == 2)
    return dot(area, to) / (2 * math::pi * r2);
  else
    return dot(area, to) / (4 * math::pi * r2 * std::sqrt(r2));
}

}  // namespace sphmbs::geometry
