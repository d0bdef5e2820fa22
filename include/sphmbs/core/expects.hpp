// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string_view>

#include <sphmbs/core/error.hpp>

namespace sphmbs {

/// Precondition on a parameter, checked on the host before any work starts.
/// @throws InvalidInput naming the parameter, its value and what is allowed, in one sentence.
template <class T>
void expects(bool condition, std::string_view parameter, const T& value, std::string_view allowed) {
  if (condition) return;
  std::ostringstream message;
  message << parameter << " = " << value << ": must be " << allowed;
  throw InvalidInput(message.str());
}

}  // namespace sphmbs
