// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <sphmbs/core/inline.hpp>
#include <sphmbs/execution/field.hpp>

namespace sphmbs::execution {

namespace detail {

template <class Result, class Map>
struct FoldChunk {
  Map map;
  Result identity;
  Result* partial;
  std::size_t n;
  std::size_t chunk;

  SPHMBS_INLINE void operator()(std::size_t c) const {
    Result r = identity;
    const std::size_t begin = c * chunk;
    const std::size_t end = begin + chunk < n ? begin + chunk : n;
    for (std::size_t i = begin; i < end; ++i) r.combine(map(i));
    partial[c] = r;
  }
};

template <class Result>
struct Partial {
  const Result* partial;
  SPHMBS_INLINE const Result& operator()(std::size_t i) const { return partial[i]; }
};

/// One level of a reduction: the partial results of all chunks.
template <ExecutionPolicy Policy, class Result, LoopBody Map>
Field<Result, Policy> fold_chunks(std::size_t n, const Result& identity, const Map& map) {
  Field<Result, Policy> partial((n + Policy::chunk - 1) / Policy::chunk);
  Policy::for_each(partial.size(),
                   FoldChunk<Result, Map>{map, identity, partial.data(), n, Policy::chunk});
  return partial;
}

}  // namespace detail

/// Folds map(0) ... map(n - 1) into one Result, starting from `identity`; Result is plain data with
/// a member `combine(const Result&)`. The order is fixed by the policy: bitwise the same for any
/// thread count. From a device one Result comes back.
template <ExecutionPolicy Policy, class Result, LoopBody Map>
Result reduce(std::size_t n, const Result& identity, const Map& map) {
  if (n == 0) return identity;
  Field<Result, Policy> partial = detail::fold_chunks<Policy>(n, identity, map);
  while (!on_host<Policy> && partial.size() > 1)
    partial = detail::fold_chunks<Policy>(partial.size(), identity,
                                          detail::Partial<Result>{partial.data()});
  Result r = identity;
  for (const Result& next : partial.download()) r.combine(next);
  return r;
}

}  // namespace sphmbs::execution
