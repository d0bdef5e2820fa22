// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "support/complaints.hpp"
#include "support/parameter.hpp"
#include "support/settings.hpp"

namespace sphmbs::examples {

/// Parameters of an example program: those of every program and those that it adds. Each one has a
/// dotted key for parameter files and --set, and may have an option of its own. What the command
/// line says precedes the file, and the file precedes the defaults.
///
/// The current value of the variable behind an added parameter is its default. All variables keep
/// their values until everything is accepted.
class Parameters {
 public:
  /// Throws std::invalid_argument if the description is not complete: no name, no back end, or
  /// defaults that the user could not give either.
  explicit Parameters(Program program);
  ~Parameters();
  Parameters(Parameters&&) noexcept;
  Parameters& operator=(Parameters&&) noexcept;

  /// Adds a number in `unit` ("" for none). `meaning` is one line; `option` has its two dashes, or
  /// is empty. All of these throw std::invalid_argument if key or option are taken.
  void add_number(const std::string& key, double& value, const Bounds& bounds,
                  const std::string& unit, const std::string& meaning,
                  const std::string& option = {});
  /// The same for a whole number.
  void add_whole_number(const std::string& key, int& value, const Bounds& bounds,
                        const std::string& unit, const std::string& meaning,
                        const std::string& option = {});
  /// Adds one of `choices`.
  void add_choice(const std::string& key, std::string& value,
                  const std::vector<std::string>& choices, const std::string& meaning,
                  const std::string& option = {});
  /// Adds true or false; `option`, which takes no value, means true.
  void add_flag(const std::string& key, bool& value, const std::string& meaning,
                const std::string& option = {});
  /// Adds the path of a file.
  void add_path(const std::string& key, std::string& value, const std::string& meaning,
                const std::string& option = {});
  /// Adds a vector, whose components all keep to `bounds`.
  void add_vector(const std::string& key, std::span<double> value, const Bounds& bounds,
                  const std::string& unit, const std::string& meaning,
                  const std::string& option = {});
  template <class Vector>
  void add_vector(const std::string& key, Vector& value, const Bounds& bounds,
                  const std::string& unit, const std::string& meaning,
                  const std::string& option = {}) {
    add_vector(key, std::span<double>(&value[0], sizeof(value) / sizeof(double)), bounds, unit,
               meaning, option);
  }

  /// Reads and validates the command line and the parameter file that it names. Creates and writes
  /// nothing. Returns nothing when --help, --version, --list-params or --dump-params is answered on
  /// `out`. Throws BadParameters with a line for each mistake.
  std::optional<Settings> parse(int argc, const char* const* argv, std::ostream& out);
  /// The same for the text of a parameter file alone, whose places carry `name`.
  Settings parse_text(std::string_view text, const std::string& name);

  /// The text of --help, with units, defaults, limits and two examples.
  std::string help() const;
  /// The text of --list-params: key, type, unit, default, range and meaning of each parameter.
  std::string list() const;
  /// The text of --dump-params: a parameter file with all present values.
  std::string dump() const;
  /// The line of --version: versions, compiler, relevant flags and back ends.
  std::string version_line() const;
  /// How to make a run fit into the memory: "a larger --spacing means fewer particles".
  std::string memory_advice() const;
  /// Complaints of require() and require_all(), with the places where the values were given.
  BadParameters located(const std::vector<RefusedValue>& all) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sphmbs::examples
