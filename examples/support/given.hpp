// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "support/complaints.hpp"

namespace sphmbs::examples {

/// A value as it was given in a parameter file, where it has a type, or on the command line, where
/// it is a word until a parameter reads it.
struct Given {
  struct Word {
    std::string text;
  };
  /// Dates and times, which no parameter takes.
  struct Other {};
  struct Member;
  using List = std::vector<Given>;
  using Table = std::vector<Member>;

  std::variant<Word, double, std::int64_t, bool, std::string, List, Table, Other> value;
  Place place;

  /// As it is shown in messages: 0.9, "text", [1, 2].
  std::string shown() const;
};

/// A value in a table and where its key stands.
struct Given::Member {
  std::string key;
  Place place;
  Given value;
};

/// The value as a number, a whole number, ...; nothing if it is something else. A word is read
/// whatever the locale; numbers that are too large become infinite.
std::optional<double> as_number(const Given& given);
std::optional<std::int64_t> as_whole_number(const Given& given);
std::optional<bool> as_flag(const Given& given);
std::optional<std::string> as_text(const Given& given);
/// [1, 2] or, as a word, also 1,2. Nothing too for a list of something else.
std::optional<std::vector<double>> as_numbers(const Given& given);
/// Seconds: a number, or a text such as 1h30m, 45s, 0.5h.
std::optional<double> as_duration(const Given& given);

/// Text in double quotes, as TOML has it.
std::string quoted(std::string_view text);

}  // namespace sphmbs::examples
