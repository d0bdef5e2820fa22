// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/neighbours/neighbour_search.hpp>

namespace sphmbs::neighbours {

/// Smallest box around points.
template <int Dim, class T>
struct Bounds {
  /// Smallest coordinates [m].
  Vec<Dim, T> lower = Vec<Dim, T>::all(std::numeric_limits<T>::max());
  /// Largest coordinates [m].
  Vec<Dim, T> upper = Vec<Dim, T>::all(std::numeric_limits<T>::lowest());

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Bounds& other) {
    for (int k = 0; k < Dim; ++k) {
      lower[k] = math::min(lower[k], other.lower[k]);
      upper[k] = math::max(upper[k], other.upper[k]);
    }
  }
};

namespace detail {

template <int Dim, class T>
struct PointBounds {
  particles::FieldsView<Dim, T> fields;
  SPHMBS_INLINE Bounds<Dim, T> operator()(std::size_t i) const {
    return {fields.position(i), fields.position(i)};
  }
};

}  // namespace detail

/// Cells of a plain grid, in rows along the first axis. Cells are half a reach wide: neighbours lie
/// at most `stencil` cells away, and few candidates are tested in vain.
template <int Dim, class T>
struct CellGrid {
  static constexpr int stencil = 2;  ///< cells to look at on either side
  Vec<Dim, T> lower;                 ///< corner of the first cell [m]
  Vec<Dim, T> inverse_side;          ///< [1/m]
  int count[Dim];                    ///< cells along each axis
  bool periodic[Dim];                ///< along which axes the last cell meets the first

  /// A grid for all particles. Where they are spread so far that there would be more cells than
  /// twice the particles, cells become wider.
  template <execution::ExecutionPolicy Policy>
  static CellGrid around(particles::Particles<Dim, T, Policy>& particles,
                         const geometry::Domain<Dim>& domain, const Reach& reach) {
    const auto bounds = execution::reduce<Policy>(particles.size(), Bounds<Dim, T>{},
                                                  detail::PointBounds<Dim, T>{particles.fields()});
    const double most = std::max(1024.0, 2.0 * static_cast<double>(particles.size()));
    double side = reach.largest() / stencil;
    CellGrid grid;
    for (;; side *= 1.5) {
      double cells = 1;
      for (int k = 0; k < Dim; ++k) {
        const bool wraps = domain.periodic[static_cast<std::size_t>(k)];
        const double length =
            wraps ? domain.box.length(k)
                  : static_cast<double>(bounds.upper[k]) - static_cast<double>(bounds.lower[k]);
        const double along =
            wraps ? std::max(1.0, std::floor(length / side)) : std::floor(length / side) + 1;
        cells *= along;
        grid.lower[k] = wraps ? static_cast<T>(domain.box.lower[k]) : bounds.lower[k];
        grid.inverse_side[k] = static_cast<T>(wraps ? along / length : 1 / side);
        grid.count[k] = static_cast<int>(std::min(along, 2e9));
        grid.periodic[k] = wraps;
      }
      if (cells <= most) return grid;
    }
  }

  /// Number of cells.
  std::size_t cells() const {
    std::size_t n = 1;
    for (int k = 0; k < Dim; ++k) n *= static_cast<std::size_t>(count[k]);
    return n;
  }

  /// Cell of coordinate x along an axis; border cells take what lies beyond.
  SPHMBS_INLINE int along(int axis, T x) const {
    const T s = (x - lower[axis]) * inverse_side[axis];
    const T last = static_cast<T>(count[axis] - 1);
    return static_cast<int>(s > T(0) ? (s < last ? s : last) : T(0));
  }

  /// Number of the cell that holds r.
  SPHMBS_INLINE std::uint32_t cell(const Vec<Dim, T>& r) const {
    std::uint32_t c = 0;
    for (int k = Dim - 1; k >= 0; --k)
      c = c * static_cast<std::uint32_t>(count[k]) + static_cast<std::uint32_t>(along(k, r[k]));
    return c;
  }

  /// True where a row of cells holds one image only of what lies around a cell.
  SPHMBS_INLINE bool rows_tell_image() const {
    bool tell = true;
    for (int k = 0; k < Dim; ++k) tell = tell && (!periodic[k] || count[k] > 2 * stencil + 1);
    return tell;
  }

  /// The cells along an axis that may hold neighbours of one in cell `at`: `cells` of them,
  /// beginning with `begin` and wrapping around after the last.
  struct Span {
    int begin;  ///< first one, which may be before 0 on a periodic axis
    int cells;  ///< how many
  };
  /// Cells along an axis to look at around one of them.
  SPHMBS_INLINE Span around_cell(int axis, int at) const {
    const int n = count[axis];
    if (periodic[axis]) {
      if (n <= 2 * stencil + 1) return {0, n};
      return {at >= stencil ? at - stencil : at - stencil + n, 2 * stencil + 1};
    }
    const int begin = at > stencil ? at - stencil : 0;
    const int end = at + stencil < n - 1 ? at + stencil : n - 1;
    return {begin, end - begin + 1};
  }
};

}  // namespace sphmbs::neighbours
