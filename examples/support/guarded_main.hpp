// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <iosfwd>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// Exit codes of all example programs.
enum class ExitCode : int {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  numerical_failure = 3,
  output_failed = 5,
  out_of_memory = 6,
};

/// Reads the command line and calls `run` with the settings; the whole body of a main(). Every
/// error ends as a line "error: ..." on `err` and an exit code:
/// InvalidInput 2, NumericalFailure 3, OutputError 5, std::bad_alloc 6, any other 1.
int guarded_main(int argc, const char* const* argv, CommandLine& command_line,
                 const std::function<void(const Settings&)>& run, std::ostream& out,
                 std::ostream& err);

/// The same on std::cout and std::cerr.
int guarded_main(int argc, const char* const* argv, CommandLine& command_line,
                 const std::function<void(const Settings&)>& run);

}  // namespace sphmbs::examples
