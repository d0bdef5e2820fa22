// SPDX-License-Identifier: MIT
#pragma once

#include <omp.h>

#include <sphmbs/execution/compiled.hpp>

namespace test {

/// Every execution policy of this build, for TEMPLATE_LIST_TEST_CASE.
using Policies = sphmbs::execution::Compiled;

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
