// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "support/complaints.hpp"
#include "support/parameter.hpp"
#include "support/settings.hpp"

namespace sphmbs::examples {

/// A value for a parameter, and the parameter's name as it was typed: a key or an option.
struct Assignment {
  Parameter* parameter;
  Given given;
  std::string name;
};

/// What a command line says.
struct Words {
  std::vector<Assignment> assignments{};
  std::optional<std::string> file{};
};

/// Reads all words, each mistake becomes a complaint.
Words read_words(int argc, const char* const* argv, std::deque<Parameter>& parameters,
                 Complaints& complaints);

/// "run.until = 5: " for a key, "--until 5: " for an option.
std::string named(const std::string& name, const std::string& value);

/// The text of --help. The first `common` parameters are those of every case.
std::string help_page(const Program& program, const std::deque<Parameter>& parameters,
                      std::size_t common);

}  // namespace sphmbs::examples
