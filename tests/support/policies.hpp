// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include <omp.h>

#include <sphmbs/execution/openmp.hpp>
#include <sphmbs/execution/serial.hpp>

namespace test {

/// Every execution policy, for TEMPLATE_LIST_TEST_CASE.
using Policies = std::tuple<sphmbs::execution::Serial, sphmbs::execution::OpenMP>;

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

}  // namespace test
