// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/program.hpp"

/// The tables of docs/bad_inputs.md.
namespace test {

/// The texts between back quotes.
inline std::vector<std::string> quoted(const std::string& cell) {
  std::vector<std::string> all;
  constexpr auto none = std::string::npos;
  for (std::size_t from = cell.find('`'), to = 0; from != none; from = cell.find('`', to + 1)) {
    to = cell.find('`', from + 1);
    if (to == none) break;
    all.push_back(cell.substr(from + 1, to - from - 1));
  }
  return all;
}

/// Calls use(cells) for each row of the page that begins with a number.
template <class Use>
void for_each_row(const Use& use) {
  for (const std::string& line : lines_of(text_of(SPHMBS_DOCS "/bad_inputs.md"))) {
    if (!line.starts_with("| ") || line.find_first_of("0123456789") != 2) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(2));
    for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(cell);
    use(cells);
  }
}

/// Whether a text is as the pattern, in which … stands for anything.
inline bool is_like(std::string_view text, std::string_view pattern) {
  const std::string_view any = "…";
  const std::size_t at = pattern.find(any);
  if (at == std::string_view::npos) return text == pattern;
  const std::string_view rest = pattern.substr(at + any.size());
  if (text.substr(0, at) != pattern.substr(0, at)) return false;
  for (std::size_t k = at; k <= text.size(); ++k)
    if (is_like(text.substr(k), rest)) return true;
  return false;
}

}  // namespace test
