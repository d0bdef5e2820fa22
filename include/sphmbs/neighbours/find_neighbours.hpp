// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/neighbours/cell_grid.hpp>

namespace sphmbs::neighbours::detail {

/// Walks the candidates of a particle, a row of cells at a time, and hands on which are in reach.
template <int Dim, class T, int W>
struct FindNeighbours {
  using N = Number<T, W>;
  particles::FieldsView<Dim, T> fields;  // sorted by cells
  CellGrid<Dim, T> grid;
  geometry::Periodicity<Dim, T> space;
  const std::uint32_t* cell_first;
  T half_support;  // [-]
  T skin;          // [m]
  T border;        // largest reach [m]

  /// found(begin, bits): bit l of bits says whether particle begin + l is a neighbour of a.
  template <class Found>
  SPHMBS_INLINE void operator()(std::size_t a, Found&& found) const {
    const Vec<Dim, T> r = fields.position(a);
    if (space.near_border(r, border))
      walk<true>(a, r, found);
    else
      walk<false>(a, r, found);
  }

 private:
  template <bool wraps, class Found>
  SPHMBS_INLINE void walk(std::size_t a, const Vec<Dim, T>& r, Found& found) const {
    using Span = typename CellGrid<Dim, T>::Span;
    const Span x = grid.around_cell(0, grid.along(0, r[0]));
    Span y{0, 1};
    Span z{0, 1};
    if constexpr (Dim > 1) y = grid.around_cell(1, grid.along(1, r[1]));
    if constexpr (Dim > 2) z = grid.around_cell(2, grid.along(2, r[2]));
    for (int k = 0; k < z.cells; ++k) {
      for (int j = 0; j < y.cells; ++j) {
        std::size_t row = 0;
        if constexpr (Dim > 2) row = static_cast<std::size_t>(wrapped(2, z.begin + k));
        if constexpr (Dim > 1)
          row = row * static_cast<std::size_t>(grid.count[1]) +
                static_cast<std::size_t>(wrapped(1, y.begin + j));
        const std::uint32_t* cell = cell_first + row * static_cast<std::size_t>(grid.count[0]);
        const int straight = x.begin + x.cells < grid.count[0] ? x.begin + x.cells : grid.count[0];
        test<wraps>(a, r, cell[x.begin], cell[straight], found);
        if (x.begin + x.cells > straight)
          test<wraps>(a, r, cell[0], cell[x.begin + x.cells - straight], found);
      }
    }
  }

  SPHMBS_INLINE int wrapped(int axis, int at) const {
    return at < grid.count[axis] ? at : at - grid.count[axis];
  }

  template <bool wraps, class Found>
  SPHMBS_INLINE void test(std::size_t a, const Vec<Dim, T>& r, std::uint32_t begin,
                          std::uint32_t end, Found& found) const {
    const N own = N(half_support * fields.h[a] + skin);
    for (std::uint32_t b = begin; b < end; b += W) {
      Vec<Dim, N> d;
      for (int k = 0; k < Dim; ++k) d[k] = load(fields.r[k] + b) - N(r[k]);
      if constexpr (wraps) d = space.nearest(d);
      const N reach = N(half_support) * load(fields.h + b) + own;
      unsigned bits = truth(norm2(d) < reach * reach);
      if (end - b < W) bits &= (1u << (end - b)) - 1u;
      if (a >= b && a - b < W) bits &= ~(1u << (a - b));
      if (bits != 0) found(b, bits);
    }
  }

  static SPHMBS_INLINE N load(const T* p) {
    if constexpr (W == 1)
      return *p;
    else
      return N::load(p);
  }
  static SPHMBS_INLINE unsigned truth(bool condition) { return condition ? 1u : 0u; }
  template <int lanes>
  static SPHMBS_INLINE unsigned truth(const Mask<T, lanes>& condition) {
    return condition.bits();
  }
};

/// Number of neighbours of each particle.
template <int Dim, class T, int W>
struct CountNeighbours {
  FindNeighbours<Dim, T, W> find;
  std::uint32_t* count;

  SPHMBS_INLINE void operator()(std::size_t a) const {
    std::uint32_t n = 0;
    find(a, [&n](std::uint32_t, unsigned bits) SPHMBS_INLINE_LAMBDA {
      n += W == 1 ? 1 : static_cast<std::uint32_t>(__builtin_popcount(bits));
    });
    count[a] = n;
  }
};

/// Lists the neighbours of each particle at its place.
template <int Dim, class T, int W>
struct ListNeighbours {
  FindNeighbours<Dim, T, W> find;
  const std::uint64_t* first;
  std::uint32_t* list;

  SPHMBS_INLINE void operator()(std::size_t a) const {
    struct {
      std::uint32_t* out;
      const std::uint32_t* end;
    } place{list + first[a], list + first[a + 1]};
    find(a, [&place](std::uint32_t b, [[maybe_unused]] unsigned bits) SPHMBS_INLINE_LAMBDA {
      auto& [out, end] = place;
      if constexpr (W == 1) {
        *out++ = b;
      } else if (end - out >= W) {
        out += append_set_lanes<W>(bits, b, out);
      } else {
        for (; bits != 0; bits &= bits - 1)
          *out++ = b + static_cast<std::uint32_t>(__builtin_ctz(bits));
      }
    });
  }
};

}  // namespace sphmbs::neighbours::detail
