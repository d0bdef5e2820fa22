// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/core/math.hpp>
#include <sphmbs/geometry/box.hpp>

namespace sphmbs::geometry {

/// What loop bodies need of a periodic space, in the fields' number type. Non-periodic axes have
/// length 0 and a half length that no distance exceeds.
template <int Dim, class T>
struct Periodicity {
  Vec<Dim, T> lower;        ///< of the box [m]
  Vec<Dim, T> length;       ///< of the period, 0 if there is none [m]
  Vec<Dim, T> half;         ///< half the period, or the largest number [m]
  Vec<Dim, T> length_rest;  ///< what rounding to T left of the period [m]

  /// The separation to the nearest image, for separations shorter than 1.5 periods.
  template <class N>
  SPHMBS_INLINE Vec<Dim, N> nearest(Vec<Dim, N> d) const {
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) {
      const N up = d[k] + N(length[k]);
      const N down = d[k] - N(length[k]);
      d[k] = math::select(d[k] > N(half[k]), down, math::select(d[k] < N(-half[k]), up, d[k]));
    }
    return d;
  }

  /// The image inside the box of a point, from however many periods away, sect. 3.1.
  SPHMBS_INLINE Vec<Dim, T> wrap(Vec<Dim, T> r) const {
    for (int k = 0; k < Dim; ++k) {
      if (length[k] > 0 && !(r[k] >= lower[k] && r[k] < lower[k] + length[k]))
        r[k] -= length[k] * math::floor((r[k] - lower[k]) / length[k]);
    }
    return r;
  }

  /// Whether all periods are at least so long [m].
  bool fits(double shortest) const {
    for (int k = 0; k < Dim; ++k)
      if (length[k] > 0 && static_cast<double>(length[k]) < shortest) return false;
    return true;
  }

  /// True where a particle at r can have neighbours across the border within `reach`.
  SPHMBS_INLINE bool near_border(const Vec<Dim, T>& r, T reach) const {
    bool near = false;
    for (int k = 0; k < Dim; ++k)
      near = near ||
             (length[k] > 0 && (r[k] < lower[k] + reach || r[k] > lower[k] + length[k] - reach));
    return near;
  }
};

/// What becomes of gas that leaves the box along axes that are not periodic: it goes on, it ends
/// the run, or it is removed and counted.
enum class Escape { allow, error, remove };

/// The space that gas lives in: a box, and the axes along which it repeats, which are the periodic
/// in- and outflow of sect. 3.1. Walls may lie outside the box along the other axes.
template <int Dim>
struct Domain {
  Box<Dim> box;  ///< [m]; what lies outside is bounded by virtual particles, or is a periodic image
  /// Along which axes the box repeats itself.
  std::array<bool, Dim> periodic{};
  /// What becomes of gas that leaves the box along the other axes.
  Escape escape = Escape::allow;

  /// The periodic axes, for loops.
  template <class T>
  Periodicity<Dim, T> periodicity() const {
    Periodicity<Dim, T> p;
    for (int k = 0; k < Dim; ++k) {
      const bool wraps = periodic[static_cast<std::size_t>(k)];
      p.lower[k] = static_cast<T>(box.lower[k]);
      p.length[k] = wraps ? static_cast<T>(box.length(k)) : T(0);
      p.length_rest[k] =
          wraps ? static_cast<T>(box.length(k) - static_cast<double>(p.length[k])) : T(0);
      p.half[k] = wraps ? static_cast<T>(box.length(k) / 2) : T(1e30);
    }
    return p;
  }

  /// The image inside the box of a point, from however many periods away.
  Vec<Dim> wrapped(Vec<Dim> r) const {
    for (int k = 0; k < Dim; ++k) {
      if (!periodic[static_cast<std::size_t>(k)]) continue;
      if (r[k] < box.lower[k] || r[k] >= box.upper[k])
        r[k] -= box.length(k) * std::floor((r[k] - box.lower[k]) / box.length(k));
    }
    return r;
  }
  /// The same for many: cells and nearest images take particles to be in the box.
  void wrap(std::vector<Vec<Dim>>& points) const {
    for (Vec<Dim>& r : points) r = wrapped(r);
  }

  /// @throws InvalidInput if the box is empty or not finite.
  void check() const {
    for (int k = 0; k < Dim; ++k)
      expects(std::isfinite(box.length(k)) && box.length(k) > 0, "domain length", box.length(k),
              "positive and finite [m]");
  }
};

}  // namespace sphmbs::geometry
