// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <omp.h>

#include <sphmbs/execution/openmp.hpp>
#include <sphmbs/execution/serial.hpp>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// The execution policies that the example programs are compiled with, the default first.
inline std::vector<std::string> backends() {
  return {std::string(execution::OpenMP::name), std::string(execution::Serial::name)};
}

/// Calls run(settings, policy) with the policy the settings name, on as many threads as they say.
template <class Run>
void with_backend(const Settings& settings, Run&& run) {
  if (settings.backend == execution::Serial::name) {
    Settings one = settings;
    one.threads = 1;
    run(one, execution::Serial{});
  } else {
    omp_set_num_threads(settings.threads);
    run(settings, execution::OpenMP{});
  }
}

}  // namespace sphmbs::examples
