// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
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

/// Whether a text has all the words.
inline bool mentions(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace test
