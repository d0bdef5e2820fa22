// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <sphmbs/core/inline.hpp>
#include <sphmbs/execution/field.hpp>

namespace sphmbs::execution {

namespace detail {

inline constexpr std::size_t scan_block = 4096;

template <class Count>
struct SumBlock {
  const Count* count;
  std::uint64_t* total;
  std::size_t n;

  SPHMBS_INLINE void operator()(std::size_t block) const {
    const std::size_t begin = block * scan_block;
    const std::size_t end = begin + scan_block < n ? begin + scan_block : n;
    std::uint64_t sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += count[i];
    total[block] = sum;
  }
};

template <class Count, class Offset>
struct OffsetBlock {
  const Count* count;
  const std::uint64_t* start;
  Offset* first;
  std::size_t n;

  SPHMBS_INLINE void operator()(std::size_t block) const {
    const std::size_t begin = block * scan_block;
    const std::size_t end = begin + scan_block < n ? begin + scan_block : n;
    std::uint64_t sum = start[block];
    for (std::size_t i = begin; i < end; ++i) {
      first[i] = static_cast<Offset>(sum);
      sum += count[i];
    }
    if (end == n) first[n] = static_cast<Offset>(sum);
  }
};

}  // namespace detail

/// Exclusive prefix sum: first[i] = count[0] + ... + count[i-1] for i = 0 ... n; returns first[n].
/// `first` has n + 1 entries; n > 0. `count` and `first` may not overlap.
template <ExecutionPolicy Policy, class Count, class Offset>
std::uint64_t exclusive_scan(std::size_t n, const Count* count, Offset* first) {
  const std::size_t blocks = (n + detail::scan_block - 1) / detail::scan_block;
  Field<std::uint64_t, Policy> total(blocks);
  Policy::for_each(blocks, detail::SumBlock<Count>{count, total.data(), n});
  std::vector<std::uint64_t> start = total.download();
  std::uint64_t sum = 0;
  for (std::uint64_t& s : start) {
    const std::uint64_t block_sum = s;
    s = sum;
    sum += block_sum;
  }
  total.upload(start);
  Policy::for_each(blocks, detail::OffsetBlock<Count, Offset>{count, total.data(), first, n});
  return sum;
}

}  // namespace sphmbs::execution
