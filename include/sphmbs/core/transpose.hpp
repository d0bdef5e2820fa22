// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <sphmbs/core/pack.hpp>

namespace sphmbs {

namespace detail {

/// Four fields of the W records that start at the given addresses, one pack a field.
template <class T, int W>
SPHMBS_INLINE void transpose_four(const T* const (&at)[W], Pack<T, W>* field) {
  if constexpr (W == 2) {
    using Two = typename VectorOf<T, 2>::type;
    using Unaligned = typename UnalignedVectorOf<T, 2>::type;
    const Two a = *reinterpret_cast<const Unaligned*>(at[0]);
    const Two b = *reinterpret_cast<const Unaligned*>(at[1]);
    const Two c = *reinterpret_cast<const Unaligned*>(at[0] + 2);
    const Two d = *reinterpret_cast<const Unaligned*>(at[1] + 2);
    field[0] = __builtin_shufflevector(a, b, 0, 2);
    field[1] = __builtin_shufflevector(a, b, 1, 3);
    field[2] = __builtin_shufflevector(c, d, 0, 2);
    field[3] = __builtin_shufflevector(c, d, 1, 3);
    return;
  }
  using Four = typename VectorOf<T, 4>::type;
  Four row[W];
#pragma GCC unroll 16
  for (int l = 0; l < W; ++l)
    row[l] = *reinterpret_cast<const typename UnalignedVectorOf<T, 4>::type*>(at[l]);
  if constexpr (W == 8) {
    using Eight = typename VectorOf<T, 8>::type;
    Eight r[4];
#pragma GCC unroll 4
    for (int l = 0; l < 4; ++l)
      r[l] = __builtin_shufflevector(row[l], row[l + 4], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a = __builtin_shufflevector(r[0], r[1], 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight b = __builtin_shufflevector(r[0], r[1], 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight c = __builtin_shufflevector(r[2], r[3], 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight d = __builtin_shufflevector(r[2], r[3], 1, 9, 3, 11, 5, 13, 7, 15);
    field[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
    field[1] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
    field[2] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
    field[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
  } else if constexpr (W == 4) {
    const Four a = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
    const Four b = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
    const Four c = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
    const Four d = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
    field[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    field[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    field[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    field[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
  } else {
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < W; ++l) field[k].v[l] = row[l][k];
  }
}

}  // namespace detail

/// The records of `fields` numbers with the given W indices, turned into one pack a field. Whole
/// cache lines are read and transposed in registers, which beats one gather a field severalfold.
/// `fields` is at least 4.
template <int fields, class T, int W>
SPHMBS_INLINE void load_transposed(const T* records, const std::uint32_t* index,
                                   Pack<T, W> (&out)[fields]) {
  static_assert(fields >= 4, "fields are read by groups of four");
  const T* at[W];
  const auto group = [&](int first) SPHMBS_INLINE_LAMBDA {
#pragma GCC unroll 16
    for (int l = 0; l < W; ++l) at[l] = records + std::size_t{index[l]} * fields + first;
    detail::transpose_four(at, out + first);
  };
#pragma GCC unroll 8
  for (int first = 0; first + 4 < fields; first += 4) group(first);
  // The last group ends with the record; it may meet the one before.
  group(fields - 4);
}

}  // namespace sphmbs
