// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <sphmbs/core/inline.hpp>

/// The two atomic operations that loop bodies need, legal on hosts and devices alike. CUDA's device
/// code lacks the compilers' own.
namespace sphmbs::atomic {

/// Adds to *p and returns what was there.
SPHMBS_INLINE std::uint32_t fetch_add(std::uint32_t* p, std::uint32_t value) {
#if defined(__CUDA_ARCH__) && defined(__CUDACC__)
  return atomicAdd(p, value);
#else
  return __atomic_fetch_add(p, value, __ATOMIC_RELAXED);
#endif
}

/// Lowers *p to value where it is above.
SPHMBS_INLINE void lower(std::uint32_t* p, std::uint32_t value) {
#if defined(__CUDA_ARCH__) && defined(__CUDACC__)
  atomicMin(p, value);
#else
  std::uint32_t now = __atomic_load_n(p, __ATOMIC_RELAXED);
  while (value < now &&
         !__atomic_compare_exchange_n(p, &now, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
#endif
}

}  // namespace sphmbs::atomic
