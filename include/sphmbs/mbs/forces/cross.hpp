// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/quarter_turn.hpp>

namespace sphmbs::mbs::forces {

/// The matrix of the cross product: skew(a) b = a x b.
inline Matrix<3, 3> skew(const Vector<3>& a) {
  Matrix<3, 3> S;
  S << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return S;
}

/// A direction u / |u| and its derivative in u.
template <int Dim>
struct Direction {
  Vector<Dim> along;       ///< the unit vector u/|u|
  Matrix<Dim, Dim> slope;  ///< its derivative by u

  /// @param u       a vector, not zero
  /// @param length  its length
  Direction(const Vector<Dim>& u, double length)
      : along(u / length),
        slope((Matrix<Dim, Dim>::Identity() - along * along.transpose()) / length) {}
};

}  // namespace sphmbs::mbs::forces
