// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/marker.hpp>

namespace sphmbs::mbs::forces {

/// Several quantities as one, y = (a, b, ...), over all their coordinates: what a force looks at.
template <int Dim, class... More>
Marker<Dim*(1 + static_cast<int>(sizeof...(More)))> stacked(const Marker<Dim>& first,
                                                            const More&... more) {
  constexpr int size = Dim * (1 + static_cast<int>(sizeof...(More)));
  const Index index = merged_index<Dim>({first, more...});
  Marker<size> y{.index = index};
  y.N = Matrix<size, Dynamic>::Zero(size, static_cast<int>(index.size()));
  int row = 0;
  for (const Marker<Dim>* part : {&first, &more...}) {
    const Marker<Dim> wide = over(index, *part);
    y.N.template middleRows<Dim>(row) = wide.N;
    y.x0.template segment<Dim>(row) = wide.x0;
    row += Dim;
  }
  return y;
}

/// Coordinates themselves as a quantity: forces on single coordinates, such as an arc parameter.
template <std::size_t Size>
Marker<static_cast<int>(Size)> coordinates(const std::array<int, Size>& which) {
  constexpr int size = static_cast<int>(Size);
  return {.index = Index(which.begin(), which.end()),
          .N = Matrix<size, Dynamic>::Identity(size, size)};
}

/// f += N^T F: the generalized force of F on y = y0 + N q.
template <int Size>
void add_force(const Marker<Size>& y, const Vector<Size>& F, VectorOut f) {
  f.noalias() += y.N.transpose() * F;
}

/// k += N^T K N for K = dF/dy; column by column, which needs no memory.
template <int Size>
void add_tangent(const Marker<Size>& y, const Matrix<Size, Size>& K, MatrixOut k) {
  for (int j = 0; j < y.N.cols(); ++j) {
    const Vector<Size> column = K * y.N.col(j);
    k.col(j).noalias() += y.N.transpose() * column;
  }
}

/// Whether a marker was left at its default, or says nothing: zero for all q.
template <int Dim>
bool is_zero(const Marker<Dim>& marker) {
  return marker.x0.isZero(0.0) && marker.N.isZero(0.0);
}

/// For vectors whose direction a force needs. What is not a number passes, for solvers to see.
/// @throws NumericalFailure naming the force and the vector, for a vector of no length.
inline void needs_direction(double length, const std::string& force, const char* vector) {
  if (length != 0) return;
  throw NumericalFailure(force + ": " + vector + " has no length, and the force no direction",
                         "E338");
}

}  // namespace sphmbs::mbs::forces
