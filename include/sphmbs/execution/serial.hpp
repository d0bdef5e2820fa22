// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/pack.hpp>
#include <sphmbs/execution/execution_policy.hpp>
#include <sphmbs/execution/host_loop.hpp>
#include <sphmbs/execution/host_memory.hpp>

namespace sphmbs::execution {

/// One thread of the host.
struct Serial : HostMemory {
  ///@{ As `ExecutionPolicy` asks.
  static constexpr std::string_view name = "serial";
  using Host = Serial;
  template <class T>
  static constexpr int lanes = native_lanes<T>;

  template <LoopBody F>
  static void for_each(std::size_t n, const F& body) {
    run_range(body, 0, n);
  }

  static int concurrency() { return 1; }
  ///@}
};

static_assert(ExecutionPolicy<Serial>);

}  // namespace sphmbs::execution
