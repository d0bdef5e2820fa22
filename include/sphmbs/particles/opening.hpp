// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include <sphmbs/particles/state.hpp>

namespace sphmbs::particles {

/// An opening, through which gas comes in and goes out: an axis-parallel zone outside the gas, one
/// face of which the gas meets, and the gas that is far away behind it. The zone is filled with
/// particles of its own, see Cloud::add_opening.
template <int Dim>
struct Opening {
  Vec<Dim> lower;   ///< lower corner of the zone [m]
  Vec<Dim> upper;   ///< upper corner [m]
  int axis;         ///< across the face
  int side;         ///< 1: gas lies beyond the zone's upper end along the axis, -1: its lower end
  State<Dim> far;   ///< of gas that comes in; where it flows outwards its velocity is not used
  double distance;  ///< of the far gas, over which pressures even out [m]
  Resolution resolution{};  ///< of its particles, set by Cloud::add_opening

  /// From the face to the far end of the zone [m].
  double length() const { return upper[axis] - lower[axis]; }

  /// Whether a point is in the zone, by more than `margin` [m].
  bool holds(const Vec<Dim>& x, double margin) const {
    bool inside = true;
    for (int k = 0; k < Dim; ++k)
      inside = inside && x[k] > lower[k] + margin && x[k] < upper[k] - margin;
    return inside;
  }

  /// @throws InvalidInput for a far state, corners, an axis, a side or a distance that are none.
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
  Vec<Dim, T> lower;  ///< [m]
  Vec<Dim, T> upper;  ///< corner of the zone with the largest coordinates [m]
  int axis;           ///< square to the face
  T side;             ///< 1 where gas is on the upper side of the face, -1 on the lower [-]
  T distance;         ///< of the far gas [m]
  T spacing;          ///< of particles in the far gas [m]
  T h;                ///< their smoothing length [m]
  T m;                ///< their mass [kg]
  T rho;              ///< of the far gas [kg/m^3]
  T p;                ///< [Pa]
  T e;                ///< [J/kg]
  T c;                ///< [m/s]
  Vec<Dim, T> v;      ///< with which it comes in [m/s]

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
    if (k == axis) return T(0);
    return r[k] < lower[k] ? r[k] - lower[k] : r[k] >= upper[k] ? r[k] - upper[k] : T(0);
  }

  /// Density of the far gas brought to another pressure along an isentrope, of which this form
  /// keeps the slope and never turns negative.
  SPHMBS_INLINE T density(T pressure) const {
    const T denser = (pressure - p) / (rho * c * c);
    return denser > T(0) ? rho * (T(1) + denser) : rho / (T(1) - denser);
  }
};

}  // namespace sphmbs::particles
