// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/command_line.hpp"
#include "support/parameters.hpp"

namespace sphmbs::examples {

/// What class Parameters consists of, for the files that implement it.
struct Parameters::Parts {
  Program program;
  Settings settings;
  // Parameters refer to members of this, and are referred to by what was read.
  std::deque<Parameter> all;
  std::size_t common = 0;
  // Files that parameters name: keys and paths.
  std::vector<std::pair<std::string, const std::string*>> files;
  bool dump = false;

  Parameter& add(Parameter parameter);
  /// The parameters of every program.
  void add_common();
  /// By key or option; null for an unknown name.
  Parameter* find(std::string_view name);
  /// The key of what lets the step vary.
  std::string variable_step() const { return program.gas ? "run.cfl" : "run.accuracy"; }

  void read_file(std::string_view text, const std::string& name,
                 std::vector<Assignment>& assignments, Complaints& complaints);
  void read_table(const Given::Table& table, const std::string& prefix,
                  std::vector<Assignment>& assignments, Complaints& complaints);
  /// Sets everything, or nothing but `settings`, and then complains.
  void accept(const std::vector<Assignment>& from_file, const std::vector<Assignment>& from_words,
              Complaints& complaints);
  void check_common(Complaints& complaints);
  void refuse_both_steps(const std::vector<Assignment>& assignments, Complaints& complaints) const;
};

}  // namespace sphmbs::examples
