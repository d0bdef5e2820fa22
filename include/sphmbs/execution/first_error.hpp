// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace sphmbs::execution {

/// Takes exceptions out of a parallel loop of the host, which must not leave it: that of the
/// smallest index is thrown again afterwards, whatever the number of threads.
class FirstError {
 public:
  /// Runs the action of iteration `index` and keeps what it throws, if it is the earliest.
  template <class Action>
  void guard(std::size_t index, Action&& action) {
    try {
      action();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (index < index_) {
        index_ = index;
        error_ = std::current_exception();
      }
    }
  }

  /// Throws what the earliest iteration that failed has thrown, if any.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::size_t index_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

}  // namespace sphmbs::execution
