// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <initializer_list>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// A point, vector or gradient of a part or of the ground: x = x0 + N q, over the coordinates that
/// `index` lists. Joints, loads and sensors know nothing else about the parts they act on.
template <int Dim>
struct Marker {
  Index index = {};                                             ///< columns of N
  Matrix<Dim, Dynamic> N = Matrix<Dim, Dynamic>::Zero(Dim, 0);  ///< [x per coordinate]
  Vector<Dim> x0 = Vector<Dim>::Zero();                         ///< [m], or [-] of a direction

  /// The quantity for all coordinates q of the structure; with v, without x0, its rate.
  Vector<Dim> at(const VectorXd& q) const { return x0 + rate(q); }
  /// Velocity [m/s], or rate of a vector, at rates v of the structure.
  Vector<Dim> rate(const VectorXd& v) const {
    Vector<Dim> x = Vector<Dim>::Zero();
    for (std::size_t k = 0; k < index.size(); ++k) x += N.col(static_cast<int>(k)) * v[index[k]];
    return x;
  }

  /// The quantity for the coordinates that `index` lists.
  Vector<Dim> local(VectorIn q) const { return x0 + N * q; }
};

/// A point or a direction of the ground.
template <int Dim>
Marker<Dim> ground(const Vector<Dim>& x) {
  return {.x0 = x};
}

/// All coordinates of several markers, ascending, each once.
template <int Dim>
Index merged_index(std::initializer_list<Marker<Dim>> markers) {
  Index index;
  for (const Marker<Dim>& m : markers) index.insert(index.end(), m.index.begin(), m.index.end());
  std::sort(index.begin(), index.end());
  index.erase(std::unique(index.begin(), index.end()), index.end());
  return index;
}

/// The same marker over a wider ascending list of coordinates.
template <int Dim>
Marker<Dim> over(const Index& index, const Marker<Dim>& marker) {
  Marker<Dim> wide{.index = index, .x0 = marker.x0};
  wide.N = Matrix<Dim, Dynamic>::Zero(Dim, static_cast<int>(index.size()));
  for (std::size_t k = 0; k < marker.index.size(); ++k) {
    const auto place = std::lower_bound(index.begin(), index.end(), marker.index[k]);
    wide.N.col(static_cast<int>(place - index.begin())) += marker.N.col(static_cast<int>(k));
  }
  return wide;
}

/// a + s b: sums and differences of markers are markers; b - a of two points is a vector.
template <int Dim>
Marker<Dim> combined(const Marker<Dim>& a, double s, const Marker<Dim>& b) {
  const Index index = merged_index({a, b});
  Marker<Dim> sum = over(index, a);
  const Marker<Dim> other = over(index, b);
  sum.N += s * other.N;
  sum.x0 += s * other.x0;
  return sum;
}

/// Point or vector a less b, on the coordinates of both.
template <int Dim>
Marker<Dim> operator-(const Marker<Dim>& a, const Marker<Dim>& b) {
  return combined(a, -1.0, b);
}

/// Point or vector a plus b, on the coordinates of both.
template <int Dim>
Marker<Dim> operator+(const Marker<Dim>& a, const Marker<Dim>& b) {
  return combined(a, 1.0, b);
}

}  // namespace sphmbs::mbs
