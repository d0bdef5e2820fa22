// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include "support/interruption.hpp"
#include "support/settings.hpp"

namespace sphmbs::examples {

/// A run that ends before its time, as it was asked to: guarded_main prints the message and ends
/// with the exit code.
class Stopped : public std::exception {
 public:
  Stopped(int exit_code, std::string message)
      : exit_code_(exit_code), message_(std::move(message)) {}
  int exit_code() const { return exit_code_; }
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  int exit_code_;
  std::string message_;
};

/// Decides between steps whether the state is saved and whether the run ends: by signals, the file
/// `stop` in the directory of the results, the time on the clock, the number of steps.
class RunControl {
 public:
  explicit RunControl(const Settings& settings);

  /// The steps begin: a file `stop` of an earlier run is none of this one.
  void begin();

  struct Decision {
    bool save = false;
    std::string stop = {};  // why the run ends; empty where it goes on
    int exit_code = 0;
  };

  /// @param step  number of steps since time 0
  Decision decide(std::int64_t step);

  /// A checkpoint was written.
  void saved();
  /// A checkpoint could not be written. @return whether it was the third time in a row
  bool failed();

 private:
  using Clock = std::chrono::steady_clock;

  const Settings& settings_;
  std::filesystem::path stop_file_;
  Interruption signals_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_save_ = begin_;
  int failures_ = 0;
};

}  // namespace sphmbs::examples
