// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>
#include <utility>

#include <sphmbs/execution/default.hpp>
#include <sphmbs/execution/serial.hpp>

#if defined(__CUDACC__)
#include <sphmbs/execution/cuda.hpp>
#elif defined(_OPENACC)
#include <sphmbs/execution/openacc.hpp>
#elif defined(SPHMBS_OMP_TARGET)
#include <sphmbs/execution/openmp_target.hpp>
#endif

namespace sphmbs::execution {

/// The policies that this compiler and its flags make possible, the fastest first. All files of a
/// program are compiled with the same ones.
#if defined(__CUDACC__)
using Compiled = std::tuple<Cuda, Serial>;
#elif defined(_OPENACC)
using Compiled = std::tuple<OpenACC, Serial>;
#elif defined(SPHMBS_OMP_TARGET)
using Compiled = std::tuple<OpenMPTarget, OpenMP, Serial>;
#elif defined(_OPENMP)
using Compiled = std::tuple<OpenMP, Serial>;
#else
using Compiled = std::tuple<Serial>;
#endif

/// Calls visit(policy) for each of them.
template <class Visit>
void for_compiled(Visit&& visit) {
  std::apply([&](auto... policy) { (visit(policy), ...); }, Compiled{});
}

/// Calls run(policy) with the one of that name; false where there is none.
template <class Run>
bool with_policy(std::string_view name, Run&& run) {
  bool found = false;
  for_compiled([&](auto policy) {
    if (found || policy.name != name) return;
    found = true;
    run(policy);
  });
  return found;
}

}  // namespace sphmbs::execution
