// SPDX-License-Identifier: MIT
#pragma once

#if !defined(_OPENMP)
#error "execution::OpenMP needs a compiler with OpenMP: compile with -fopenmp"
#endif

#include <cstddef>

#include <omp.h>

#include <sphmbs/core/pack.hpp>
#include <sphmbs/execution/execution_policy.hpp>
#include <sphmbs/execution/first_error.hpp>
#include <sphmbs/execution/host_loop.hpp>
#include <sphmbs/execution/host_memory.hpp>

namespace sphmbs::execution {

/// The threads of the host, by OpenMP; their number is OpenMP's (omp_set_num_threads). Results do
/// not depend on it, to the last bit: no loop body reads what another one writes.
struct OpenMP : HostMemory {
  ///@{ As `ExecutionPolicy` asks.
  static constexpr std::string_view name = "openmp";
  using Host = OpenMP;
  template <class T>
  static constexpr int lanes = native_lanes<T>;

  template <LoopBody F>
  static void for_each(std::size_t n, const F& body) {
    // Short chunks handed out on demand even out walls, edges and disturbances by other programs.
    const std::size_t even = n / (16 * static_cast<std::size_t>(concurrency()));
    const std::size_t chunk = even < 1 ? 1 : even > 256 ? 256 : even;
    const std::size_t chunks = (n + chunk - 1) / chunk;
    FirstError error;
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t c = 0; c < chunks; ++c)
      error.guard(c, [&] { run_range(body, c * chunk, c + 1 < chunks ? (c + 1) * chunk : n); });
    error.rethrow();
  }

  static int concurrency() { return omp_get_max_threads(); }
  ///@}
};

static_assert(ExecutionPolicy<OpenMP>);

}  // namespace sphmbs::execution
