// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace sphmbs {

/// Base of all errors that sphmbs reports to its user. The message is complete: it names what went
/// wrong, where, and the offending value.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter, an option or an input file is not acceptable. Programs end with exit code 2.
struct InvalidInput : Error {
  using Error::Error;
};

/// The computation cannot go on: a state is not finite or not physical, or an iteration does not
/// converge. Programs end with exit code 3.
struct NumericalFailure : Error {
  using Error::Error;
};

/// A result file cannot be created, written or replaced. The message holds the path and the reason
/// the operating system gave. Programs end with exit code 5.
struct OutputError : Error {
  using Error::Error;
};

}  // namespace sphmbs
