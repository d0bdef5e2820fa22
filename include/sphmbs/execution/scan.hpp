// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <sphmbs/core/inline.hpp>
#include <sphmbs/execution/field.hpp>

namespace sphmbs::execution {

namespace detail {

template <class Count>
struct SumChunk {
  const Count* count;
  std::uint64_t* total;
  std::size_t n;
  std::size_t chunk;

  SPHMBS_INLINE void operator()(std::size_t c) const {
    const std::size_t begin = c * chunk;
    const std::size_t end = begin + chunk < n ? begin + chunk : n;
    std::uint64_t sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += count[i];
    total[c] = sum;
  }
};

/// Prefix sums within a chunk; what comes before the chunk is in `start`, null for the first one.
template <class Count, class Offset>
struct OffsetChunk {
  const Count* count;
  const std::uint64_t* start;
  Offset* first;
  std::size_t n;
  std::size_t chunk;

  SPHMBS_INLINE void operator()(std::size_t c) const {
    const std::size_t begin = c * chunk;
    const std::size_t end = begin + chunk < n ? begin + chunk : n;
    std::uint64_t sum = start != nullptr ? start[c] : 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t own = count[i];
      first[i] = static_cast<Offset>(sum);
      sum += own;
    }
    if (end == n) first[n] = static_cast<Offset>(sum);
  }
};

/// Fills first[0] ... first[n], chunk sums by the same function where there are several.
template <ExecutionPolicy Policy, class Count, class Offset>
void scan_chunks(std::size_t n, const Count* count, Offset* first) {
  const std::size_t chunks = (n + Policy::chunk - 1) / Policy::chunk;
  Field<std::uint64_t, Policy> total, start;
  if (chunks > 1) {
    total = Field<std::uint64_t, Policy>(chunks);
    start = Field<std::uint64_t, Policy>(chunks + 1);
    Policy::for_each(chunks, SumChunk<Count>{count, total.data(), n, Policy::chunk});
    scan_chunks<Policy>(chunks, static_cast<const std::uint64_t*>(total.data()), start.data());
  }
  Policy::for_each(chunks,
                   OffsetChunk<Count, Offset>{count, start.data(), first, n, Policy::chunk});
}

}  // namespace detail

/// Exclusive prefix sum: first[i] = count[0] + ... + count[i-1] for i = 0 ... n; returns first[n].
/// `first` has n + 1 entries; n > 0. `count` and `first` may not overlap. From a device that one
/// number comes back.
template <ExecutionPolicy Policy, class Count, class Offset>
std::uint64_t exclusive_scan(std::size_t n, const Count* count, Offset* first) {
  detail::scan_chunks<Policy>(n, count, first);
  std::array<Offset, 1> last;
  Policy::download(last.data(), first + n, sizeof last);
  return static_cast<std::uint64_t>(last[0]);
}

}  // namespace sphmbs::execution
