// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <sphmbs/core/error.hpp>

namespace test {

/// What an action complains of with an error of type E; empty where it does not complain.
template <class E, class Action>
std::string complaint(Action&& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return {};
}

/// As `complaint`, of bad input.
template <class Action>
std::string refusal(Action&& action) {
  return complaint<sphmbs::InvalidInput>(action);
}

}  // namespace test
