// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <type_traits>

#include <benchmark/benchmark.h>
#include <omp.h>

#include <sphmbs/execution/compiled.hpp>

namespace bench {

/// Anything done `amount` times an iteration, as a count a second.
inline benchmark::Counter per_second(double amount) {
  return {amount, benchmark::Counter::kIsIterationInvariantRate};
}

/// Sets the number of OpenMP threads for as long as it lives.
class Threads {
 public:
  explicit Threads(int count) : before_(omp_get_max_threads()) { omp_set_num_threads(count); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() { omp_set_num_threads(before_); }

 private:
  int before_;
};

/// Registers one benchmark that measures the time on the clock.
/// @param run  called as run(state) on `threads` OpenMP threads
template <class Run>
benchmark::internal::Benchmark* add(const std::string& name, int threads, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(),
                                      [threads, run](benchmark::State& state) {
                                        const Threads limit(threads);
                                        run(state);
                                      })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

/// Calls each(policy, its name, OpenMP threads) for every policy of this build, OpenMP on all
/// threads.
template <class Each>
void for_policies(Each each) {
  using namespace sphmbs::execution;
  for_compiled([&]<class Policy>(Policy policy) {
    each(policy, std::string(Policy::name),
         std::is_same_v<Policy, Serial> ? 1 : omp_get_max_threads());
  });
}

/// As `for_policies`, with OpenMP on one thread, two, and all of them.
template <class Each>
void for_policies_and_threads(Each each) {
  for_policies([&]<class Policy>(Policy policy, const std::string& name, int all) {
    if (name != "openmp") return each(policy, name, all);
    for (const int threads : std::set<int>{1, 2, all})
      each(policy, name + "/threads:" + std::to_string(threads), threads);
  });
}

/// A whole number known when the program is compiled.
template <int value>
using Int = std::integral_constant<int, value>;

/// Calls each(dimensions) for two and three of them.
template <class Each>
void for_dimensions(Each each) {
  each(Int<2>{});
  each(Int<3>{});
}

/// "2D" or "3D".
template <int dim>
std::string name_of(Int<dim>) {
  return std::to_string(dim) + "D";
}

}  // namespace bench
