// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <random>

#include <sphmbs/core/pack.hpp>

namespace bench {

/// Numbers in a column: a few of them fit into the first cache.
inline constexpr std::size_t column_size = 1024;

/// Numbers spread evenly between two bounds, in no order.
template <class T>
std::array<T, column_size> column(double from, double to) {
  std::mt19937_64 engine(1);
  std::array<T, column_size> x;
  for (T& value : x)
    value = static_cast<T>(from + (to - from) * static_cast<double>(engine() >> 11) * 0x1p-53);
  return x;
}

/// A number or a pack of them from memory.
template <class N>
SPHMBS_INLINE N load(const sphmbs::Scalar<N>* p) {
  if constexpr (std::is_same_v<N, sphmbs::Scalar<N>>)
    return *p;
  else
    return N::load(p);
}

/// A number or a pack of them to memory.
template <class N>
SPHMBS_INLINE void store(sphmbs::Scalar<N>* p, const N& x) {
  __builtin_memcpy(p, &x, sizeof x);
}

}  // namespace bench
