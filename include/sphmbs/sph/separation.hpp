// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/record.hpp>

namespace sphmbs::sph {

/// From particle a to particle b, or to its nearest image [m].
/// @tparam wraps  whether b may be a periodic image
template <bool wraps, int Dim, class T, class N>
SPHMBS_INLINE Vec<Dim, N> separation(const geometry::Periodicity<Dim, T>& space,
                                     const particles::Record<Dim, T>& a,
                                     const particles::Record<Dim, N>& b) {
  Vec<Dim, N> d = b.r - a.r;
  if constexpr (particles::splits_positions<T>) {
    Vec<Dim, N> rest = b.rest - a.rest;
    if constexpr (wraps) {
      // A period apart, the difference is rounded; and so is the period.
#pragma GCC unroll 3
      for (int k = 0; k < Dim; ++k) {
        const N v = d[k] - b.r[k];
        rest[k] += (b.r[k] - (d[k] - v)) - (N(a.r[k]) + v);
        const N left = N(space.length_rest[k]);
        rest[k] += math::select(d[k] > N(space.half[k]), N(T(0)) - left,
                                math::select(d[k] < N(-space.half[k]), left, N(T(0))));
      }
      d = space.nearest(d);
    }
    return d + rest;
  } else {
    if constexpr (wraps) d = space.nearest(d);
    return d;
  }
}

}  // namespace sphmbs::sph
