// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <sphmbs/execution/execution_policy.hpp>

namespace sphmbs::execution {

/// body(begin) ... body(end - 1). All policies that run on the host call this one function, so that
/// they share its machine code: the same rounding to the last bit, and one compilation.
template <LoopBody F>
#if __has_cpp_attribute(gnu::noclone)
[[gnu::noclone]]
#endif
[[gnu::noinline]] void
run_range(const F& body, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) body(i);
}

}  // namespace sphmbs::execution
