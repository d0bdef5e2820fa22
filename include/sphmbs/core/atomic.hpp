// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <sphmbs/core/inline.hpp>

/// The two atomic operations that loop bodies need, legal on hosts and devices alike.
namespace sphmbs::atomic {

/// Adds to *p and returns what was there.
SPHMBS_INLINE std::uint32_t fetch_add(std::uint32_t* p, std::uint32_t value) {
  return __atomic_fetch_add(p, value, __ATOMIC_RELAXED);
}

/// Lowers *p to value where it is above.
SPHMBS_INLINE void lower(std::uint32_t* p, std::uint32_t value) {
  std::uint32_t now = __atomic_load_n(p, __ATOMIC_RELAXED);
  while (value < now &&
         !__atomic_compare_exchange_n(p, &now, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
}

}  // namespace sphmbs::atomic
