// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/neighbours/find_neighbours.hpp>

namespace sphmbs::neighbours::detail {

/// Tests the candidates of a whole cell: the rows of cells around it are found once, and each pack
/// of candidates is loaded once for several particles.
template <int Dim, class T, int W, bool list_them>
struct CellNeighbours {
  using N = Number<T, W>;
  FindNeighbours<Dim, T, W> find;
  std::uint32_t* count;
  const std::uint64_t* first;
  std::uint32_t* list;

  SPHMBS_INLINE void operator()(std::size_t c) const {
    const std::uint32_t begin = find.cell_first[c];
    const std::uint32_t end = find.cell_first[c + 1];
    if (begin == end) return;
    if (!find.grid.rows_tell_image()) {
      for (std::uint32_t a = begin; a < end; ++a) {
        if constexpr (list_them)
          ListNeighbours<Dim, T, W>{find, first, list}(a);
        else
          CountNeighbours<Dim, T, W>{find, count}(a);
      }
      return;
    }
    Rows rows;
    const bool images = collect(c, rows);
    if (images)
      blocks<true>(rows, begin, end);
    else
      blocks<false>(rows, begin, end);
  }

 private:
  struct Row {
    std::uint32_t begin;
    std::uint32_t end;
    Vec<Dim, T> shift;
  };
  struct Rows {
    // Each row of the widest neighbourhood may come in two pieces.
    Row row[2 * math::power<2>(2 * CellGrid<Dim, T>::stencil + 1)];
    int size = 0;
  };

  // Returns whether any candidate is an image.
  SPHMBS_INLINE bool collect(std::size_t c, Rows& to) const {
    const auto& grid = find.grid;
    int lo[3] = {0, 0, 0};
    int hi[3] = {0, 0, 0};
    bool images = false;
    std::size_t rest = c;
    for (int k = 0; k < Dim; ++k) {
      const int at = static_cast<int>(rest % static_cast<std::size_t>(grid.count[k]));
      rest /= static_cast<std::size_t>(grid.count[k]);
      lo[k] = at - grid.stencil;
      hi[k] = at + grid.stencil;
      if (!grid.periodic[k]) {
        lo[k] = lo[k] < 0 ? 0 : lo[k];
        hi[k] = hi[k] > grid.count[k] - 1 ? grid.count[k] - 1 : hi[k];
      }
      images = images || lo[k] < 0 || hi[k] >= grid.count[k];
    }
    Vec<Dim, T> shift = Vec<Dim, T>::all(T(0));
    const int m = grid.count[0];
    const auto add = [&](std::uint32_t b, std::uint32_t e, T shift_x) SPHMBS_INLINE_LAMBDA {
      shift[0] = shift_x;
      to.row[to.size] = {b, e, shift};
      to.size += b < e ? 1 : 0;
    };
    for (int z = lo[2]; z <= hi[2]; ++z) {
      std::size_t slab = 0;
      if constexpr (Dim > 2) slab = wrapped<2>(z, shift);
      for (int y = lo[1]; y <= hi[1]; ++y) {
        std::size_t row = slab;
        if constexpr (Dim > 1)
          row = slab * static_cast<std::size_t>(grid.count[1]) + wrapped<1>(y, shift);
        const std::uint32_t* cell = find.cell_first + row * static_cast<std::size_t>(m);
        if (lo[0] < 0) add(cell[lo[0] + m], cell[m], -find.space.length[0]);
        add(cell[lo[0] < 0 ? 0 : lo[0]], cell[hi[0] >= m ? m : hi[0] + 1], T(0));
        if (hi[0] >= m) add(cell[0], cell[hi[0] - m + 1], find.space.length[0]);
      }
    }
    return images;
  }

  template <int axis>
  SPHMBS_INLINE std::size_t wrapped(int at, Vec<Dim, T>& shift) const {
    const int n = find.grid.count[axis];
    shift[axis] = at < 0 ? -find.space.length[axis] : at >= n ? find.space.length[axis] : T(0);
    return static_cast<std::size_t>(at < 0 ? at + n : at >= n ? at - n : at);
  }

  template <bool images>
  SPHMBS_INLINE void blocks(const Rows& rows, std::uint32_t a, std::uint32_t end) const {
    if constexpr (list_them) {
      for (; a < end; ++a) block<images, 1>(rows, a);
      return;
    }
    for (; end - a >= 4; a += 4) block<images, 4>(rows, a);
    if (end - a >= 2) {
      block<images, 2>(rows, a);
      a += 2;
    }
    if (end > a) block<images, 1>(rows, a);
  }

  template <bool images, int P>
  SPHMBS_INLINE void block(const Rows& rows, std::uint32_t a) const {
    const T* x[Dim];
    for (int k = 0; k < Dim; ++k) x[k] = find.fields.r[k];
    const T* const h = find.fields.h;
    const N half = N(find.half_support);
    Vec<Dim, N> at[P];
    N mine[P];
    std::uint32_t* out[P];
    std::uint32_t* last[P];
    std::uint32_t n[P];
    for (int p = 0; p < P; ++p) {
      for (int k = 0; k < Dim; ++k) at[p][k] = N(x[k][a + static_cast<std::uint32_t>(p)]);
      mine[p] = N(find.half_support * h[a + static_cast<std::uint32_t>(p)] + find.skin);
      n[p] = 0;
      if constexpr (list_them) {
        out[p] = list + first[a + static_cast<std::uint32_t>(p)];
        last[p] = list + first[a + static_cast<std::uint32_t>(p) + 1];
      }
    }
    for (int i = 0; i < rows.size; ++i) {
      const Row& row = rows.row[i];
      Vec<Dim, N> shift;
      for (int k = 0; k < Dim; ++k) shift[k] = N(row.shift[k]);
      for (std::uint32_t b = row.begin; b < row.end; b += W) {
        const unsigned inside = row.end - b < W ? (1u << (row.end - b)) - 1u : ~0u;
        Vec<Dim, N> r;
        for (int k = 0; k < Dim; ++k) r[k] = N::load(x[k] + b);
        const N its = half * N::load(h + b);
        for (int p = 0; p < P; ++p) {
          Vec<Dim, N> d = r - at[p];
          if constexpr (images) d = d + shift;
          const N reach = its + mine[p];
          unsigned bits = bits_less(norm2(d), reach * reach) & inside;
          if constexpr (!list_them) {
            n[p] += static_cast<std::uint32_t>(__builtin_popcount(bits));
          } else {
            const std::uint32_t own = a + static_cast<std::uint32_t>(p) - b;
            if (own < W) bits &= ~(1u << own);
            if (last[p] - out[p] >= W) {
              out[p] += append_set_lanes<W>(bits, b, out[p]);
            } else {
              for (; bits != 0; bits &= bits - 1)
                *out[p]++ = b + static_cast<std::uint32_t>(__builtin_ctz(bits));
            }
          }
        }
      }
    }
    if constexpr (!list_them)
      for (int p = 0; p < P; ++p) count[a + static_cast<std::uint32_t>(p)] = n[p] - 1;
  }
};

}  // namespace sphmbs::neighbours::detail
