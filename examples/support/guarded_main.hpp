// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <iosfwd>

#include "support/parameters.hpp"

namespace sphmbs::examples {

/// Exit codes of all example programs.
enum class ExitCode : int {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  numerical_failure = 3,
  refused_checkpoint = 4,
  output_failed = 5,
  out_of_memory = 6,
  interrupted = 130,  // by SIGINT, with a valid checkpoint
  terminated = 143,   // by SIGTERM, with a valid checkpoint
};

/// Reads the parameters and calls `run` with the settings; the whole body of a main(). Every error
/// ends as a line "error <id> ..." on `err`, or as a line for each bad parameter, and as an exit
/// code: InvalidInput 2, NumericalFailure 3, RefusedCheckpoint 4, OutputError 5, std::bad_alloc 6,
/// any other 1.
int guarded_main(int argc, const char* const* argv, Parameters& parameters,
                 const std::function<void(const Settings&)>& run, std::ostream& out,
                 std::ostream& err);

/// The same on std::cout and std::cerr.
int guarded_main(int argc, const char* const* argv, Parameters& parameters,
                 const std::function<void(const Settings&)>& run);

}  // namespace sphmbs::examples
