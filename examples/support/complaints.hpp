// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/core/error.hpp>

namespace sphmbs::examples {

/// Where a value was given: in a file, by line and column from 1, or else where `source` says:
/// "command line", "default".
struct Place {
  std::string source{};
  std::size_t line = 0;
  std::size_t column = 0;
};

/// "case.toml:12:9", "command line".
std::string to_text(const Place& place);

/// Parameters that are not acceptable. The message is whole: a line for each mistake, with place
/// and id, and how many there are.
struct BadParameters : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// Everything that is wrong with the parameters of a run.
class Complaints {
 public:
  /// @param id    the heading in docs/messages.md
  /// @param text  becomes one line
  void add(const Place& place, std::string_view id, const std::string& text);

  bool empty() const { return all_.empty(); }
  /// Throws BadParameters with all complaints, those about a file first and by line, if there are
  /// any.
  void raise() const;

 private:
  struct Complaint {
    Place place;
    std::string_view id;
    std::string text;
  };
  std::vector<Complaint> all_;
};

}  // namespace sphmbs::examples
