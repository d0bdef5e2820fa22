// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <sphmbs/core/inline.hpp>
#include <sphmbs/execution/field.hpp>

namespace sphmbs::execution {

/// Elements folded one after the other into one partial result. Fixed, so that the order of a
/// reduction, and with it every bit of the result, is the same on any number of threads.
inline constexpr std::size_t reduction_block = 1024;

namespace detail {

template <class Result, class Map>
struct FoldBlock {
  Map map;
  Result identity;
  Result* partial;
  std::size_t n;

  SPHMBS_INLINE void operator()(std::size_t block) const {
    Result r = identity;
    const std::size_t begin = block * reduction_block;
    const std::size_t end = begin + reduction_block < n ? begin + reduction_block : n;
    for (std::size_t i = begin; i < end; ++i) r.combine(map(i));
    partial[block] = r;
  }
};

}  // namespace detail

/// Folds map(0) ... map(n - 1) into one Result, starting from `identity`; Result is plain data with
/// a member `combine(const Result&)`. The order is fixed: bitwise the same for any thread count.
template <ExecutionPolicy Policy, class Result, LoopBody Map>
Result reduce(std::size_t n, const Result& identity, const Map& map) {
  const std::size_t blocks = (n + reduction_block - 1) / reduction_block;
  Field<Result, Policy> partial(blocks);
  Policy::for_each(blocks, detail::FoldBlock<Result, Map>{map, identity, partial.data(), n});
  const std::vector<Result> in_order = partial.download();
  Result r = identity;
  for (std::size_t b = 0; b < blocks; ++b) r.combine(in_order[b]);
  return r;
}

}  // namespace sphmbs::execution
