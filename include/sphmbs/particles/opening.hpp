// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/particles/state.hpp>

namespace sphmbs::particles {

/// An opening, through which gas comes in and goes out: an axis-parallel zone outside the gas, one
/// face of which the gas meets, and the gas that is far away behind it. The zone is filled with
/// particles of its own, see Cloud::add_opening.
template <int Dim>
struct Opening {
  Vec<Dim> lower;   // corners of the zone [m]
  Vec<Dim> upper;   //
  int axis;         // across the face
  int side;         // 1: the gas lies beyond the zone's upper end along the axis, -1: its lower end
  State<Dim> far;   // what waves that come in bring, and what gas that comes in was
  double distance;  // of the far gas, over which pressures even out [m]
  double spacing = 0;  // of its particles, set by Cloud::add_opening [m]

  /// From the face to the far end of the zone [m].
  double length() const { return upper[axis] - lower[axis]; }
  /// How far behind the face a point is [m].
  double depth(const Vec<Dim>& x) const {
    return side > 0 ? upper[axis] - x[axis] : x[axis] - lower[axis];
  }

  /// @throws InvalidInput for a far state, corners, an axis or a side that are none.
  void check() const {
    far.check();
    expects(distance > 0, "distance of the far gas", distance, "positive [m]");
    expects(axis >= 0 && axis < Dim, "axis of an opening", axis,
            "between 0 and " + std::to_string(Dim - 1));
    expects(side == 1 || side == -1, "side of an opening", side, "1 or -1");
    for (int k = 0; k < Dim; ++k) {
      expects(std::isfinite(upper[k] - lower[k]) && upper[k] > lower[k],
              "width of an opening's zone", upper[k] - lower[k], "positive [m]");
      expects(std::isfinite(far.v[k]), "velocity of the far gas", far.v[k], "finite [m/s]");
    }
  }
};

/// The same as loop bodies see it.
template <int Dim, class T>
struct OpeningView {
  Vec<Dim, T> lower;  // [m]
  Vec<Dim, T> upper;
  int axis;
  T side;
  T distance;     // of the far gas [m]
  T spacing;      // of the particles [m]
  T rho;          // of the far gas [kg/m^3]
  T p;            // [Pa]
  T e;            // [J/kg]
  Vec<Dim, T> v;  // [m/s]

  /// The component of a vector across the face, into the gas.
  template <class N>
  SPHMBS_INLINE N along(const Vec<Dim, N>& d) const {
    return side * d[axis];
  }
  /// How far a point is inside the gas, across the face; negative in the zone [m].
  SPHMBS_INLINE T inside(const Vec<Dim, T>& r) const {
    return side > T(0) ? r[axis] - upper[axis] : lower[axis] - r[axis];
  }
  /// From the face to the far end of the zone [m].
  SPHMBS_INLINE T length() const { return upper[axis] - lower[axis]; }

  /// How far a point is out of the zone along another axis than its own; 0 where it is not [m].
  SPHMBS_INLINE T beside(const Vec<Dim, T>& r, int k) const {
    return k == axis          ? T(0)
           : r[k] < lower[k]  ? r[k] - lower[k]
           : r[k] >= upper[k] ? r[k] - upper[k]
                              : T(0);
  }
};

}  // namespace sphmbs::particles
