// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <omp.h>

#include <sphmbs/execution/compiled.hpp>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// The execution policies that the example programs are compiled with, the default first.
inline std::vector<std::string> backends() {
  std::vector<std::string> names;
  execution::for_compiled([&](auto policy) { names.emplace_back(policy.name); });
  return names;
}

/// Those that run on the host, for bodies alone, which have no work for a device.
inline std::vector<std::string> host_backends() {
  std::vector<std::string> names;
  execution::for_compiled([&]<class Policy>(Policy policy) {
    if (execution::on_host<Policy>) names.emplace_back(policy.name);
  });
  return names;
}

/// The number types of fields that a program is compiled with, the default first.
inline std::vector<std::string> precisions() {
#if defined(SPHMBS_WITH_FLOAT)
  return {"double", "float"};
#else
  return {"double"};
#endif
}

/// Calls run.operator()<T>(settings, policy) with the policy and the number type T of fields that
/// the settings name, on as many threads as they say.
/// @throws InvalidInput where the policy's device is missing.
template <class Run>
void with_backend(const Settings& settings, Run&& run) {
  execution::with_policy(settings.backend, [&]<class Policy>(Policy policy) {
    Settings adapted = settings;
    if constexpr (std::is_same_v<typename Policy::Host, execution::Serial>) adapted.threads = 1;
    Policy::device();
    omp_set_num_threads(adapted.threads);
#if defined(SPHMBS_WITH_FLOAT)
    if (settings.precision == "float") return run.template operator()<float>(adapted, policy);
#endif
    run.template operator()<double>(adapted, policy);
  });
}

/// The same for bodies alone: run(settings, policy) with a policy of the host.
template <class Run>
void with_host_backend(const Settings& settings, Run&& run) {
  bool found = false;
  execution::for_compiled([&]<class Policy>(Policy policy) {
    if constexpr (execution::on_host<Policy>) {
      if (settings.backend != policy.name) return;
      found = true;
      omp_set_num_threads(settings.threads);
      run(settings, policy);
    }
  });
  require(found, "--backend", settings.backend,
          "a policy of the host: bodies alone have no work for a device");
}

/// "openmp, 2 threads".
inline std::string threads_of(const Settings& settings) {
  return settings.backend + ", " + std::to_string(settings.threads) +
         (settings.threads == 1 ? " thread" : " threads");
}

/// Where the loops of a policy run, in words.
template <class Policy>
std::string place_of_loops(const Settings& settings) {
  if (execution::on_host<Policy>) return threads_of(settings);
  return settings.backend + " on " + Policy::device().name;
}

}  // namespace sphmbs::examples
