// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sphmbs {

/// Base of all errors that sphmbs reports to its user. The message is complete: it names what went
/// wrong, where, and the offending value. The id, such as "E301", is the heading in
/// docs/messages.md that says more.
struct Error : std::runtime_error {
  /// @param message     one sentence: what is wrong, its value, what is allowed
  /// @param message_id  its heading in docs/messages.md
  Error(const std::string& message, std::string_view message_id)
      : std::runtime_error(message), id(message_id) {}

  std::string_view id;  ///< a literal
};

/// A parameter, an option or an input file is not acceptable. Programs end with exit code 2.
struct InvalidInput : Error {
  /// @copydoc Error::Error
  explicit InvalidInput(const std::string& message, std::string_view message_id = "E100")
      : Error(message, message_id) {}
};

/// The computation cannot go on: a state is not finite or not physical, or an iteration does not
/// converge. Programs end with exit code 3.
struct NumericalFailure : Error {
  /// @copydoc Error::Error
  /// @param culprits  ids of particles to look at
  explicit NumericalFailure(const std::string& message, std::string_view message_id = "E300",
                            std::vector<std::uint32_t> culprits = {})
      : Error(message, message_id), particles(std::move(culprits)) {}

  std::vector<std::uint32_t> particles;  ///< ids of those to look at; empty where it is none
};

/// What was computed is sound, but leaves what the model covers: bodies touch, a slider leaves its
/// rail, gas escapes. A shorter step does not help.
struct BeyondModel : NumericalFailure {
  using NumericalFailure::NumericalFailure;
};

/// A checkpoint is damaged, or of another program, precision or case. Programs end with exit code
/// 4.
struct RefusedCheckpoint : Error {
  /// @copydoc Error::Error
  explicit RefusedCheckpoint(const std::string& message, std::string_view message_id = "E400")
      : Error(message, message_id) {}
};

/// A result file cannot be created, written or replaced. The message holds the path and the reason
/// the operating system gave. Programs end with exit code 5.
struct OutputError : Error {
  /// @copydoc Error::Error
  explicit OutputError(const std::string& message, std::string_view message_id = "E500")
      : Error(message, message_id) {}
};

}  // namespace sphmbs
