// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sphmbs::examples {

/// What every example program lets its user choose.
struct Settings {
  /// Distance of neighbouring particles [m]; of a program with gas.
  double spacing = 0.0;
  /// Physical time at which the run ends [s].
  double until = 0.0;
  /// Fixed time step [s]; without it the step follows from `cfl` in gas, from `accuracy` else.
  std::optional<double> step{};
  /// Courant number of the time step, in (0, 1]; of a program with gas.
  double cfl = 0.3;
  /// Error of a position that the steps of a structure aim at [m].
  std::optional<double> accuracy{};
  /// Spectral radius of generalized-alpha at infinite frequency, in [0, 1]; of a structure.
  double spectral_radius = 0.8;
  /// Number of threads; 0 among the defaults of a program: as many as OpenMP offers.
  int threads = 0;
  /// Name of the execution policy; empty among the defaults: the first of Program::backends.
  std::string backend{};
  /// Number type of the fields of a gas: "double" or "float".
  std::string precision = "double";
  /// Directory of the results; empty among the defaults: results/<name of the program>.
  std::filesystem::path output{};
  /// Files of the same names in `output` may be replaced.
  bool overwrite = false;
  /// Print nothing but warnings and errors.
  bool quiet = false;
  /// Draw pictures and curves.
  bool plots = true;
  /// Read, validate and prepare, but do not run.
  bool check = false;
  /// Go on from a checkpoint; an empty path means the newest one in `output`.
  std::optional<std::filesystem::path> resume{};
  /// Time on the clock after which the run ends with a checkpoint [s].
  std::optional<double> walltime{};
  /// Time on the clock between checkpoints [s].
  double checkpoint_every = 600;
  /// Number of steps after which the run ends.
  std::optional<std::int64_t> steps{};
  /// All parameters as a parameter file, for used.toml; empty writes none.
  std::string used{};
};

/// Limits of a number. Whatever they are, NaN and infinity are refused.
struct Bounds {
  std::optional<double> above{};
  std::optional<double> at_least{};
  std::optional<double> below{};
  std::optional<double> at_most{};
};

/// A command shown by --help.
struct UsageExample {
  /// What follows the name of the program, for example "--spacing 0.25 --until 2".
  std::string options{};
  std::string meaning{};
};

/// What a program says about itself.
struct Program {
  /// Name of the case, for example "gas_cylinder".
  std::string name{};
  /// One line, for example "airflow around a circular cylinder".
  std::string title{};
  /// Execution policies that are compiled in, at least one.
  std::vector<std::string> backends{};
  /// Number types of fields that are compiled in, of a program with gas; --precision chooses where
  /// there are several.
  std::vector<std::string> precisions{"double"};
  Settings defaults{};
  /// What is simulated decides on the options: --spacing and --cfl belong to a gas,
  /// --spectral-radius to a structure, and --accuracy to a structure without gas.
  bool gas = true;
  bool structure = false;
  /// Without any, --help shows two that fit every program.
  std::vector<UsageExample> usage_examples{};
};

/// Command line of an example program: the common options and those that the program adds.
///
/// The current value of the variable behind an added option is its default. All variables keep
/// their values until the whole command line is accepted.
class CommandLine {
 public:
  /// Throws std::invalid_argument if the description is not complete: no name, no back end, or
  /// defaults that the user could not give either.
  explicit CommandLine(Program program);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;
  CommandLine& operator=(CommandLine&&) noexcept;

  /// Adds `name` (with its two dashes) for a number in `unit` ("" for none). `help` is one line.
  void add_number(const std::string& name, double& value, const Bounds& bounds,
                  const std::string& unit, const std::string& help);
  /// The same for a whole number.
  void add_whole_number(const std::string& name, int& value, const Bounds& bounds,
                        const std::string& unit, const std::string& help);
  /// Adds `name` for one of `choices`.
  void add_choice(const std::string& name, std::string& value,
                  const std::vector<std::string>& choices, const std::string& help);
  /// Adds `name` without a value; giving it sets `value` to true.
  void add_flag(const std::string& name, bool& value, const std::string& help);

  /// Reads and validates the command line. Creates and writes nothing. Returns nothing when --help
  /// or --version is answered on `out`. Throws InvalidInput with one line that names the option,
  /// its value and what is allowed.
  std::optional<Settings> parse(int argc, const char* const* argv, std::ostream& out);

  /// The text of --help, with units, defaults, limits and two examples.
  std::string help() const;
  /// The line of --version: versions, compiler, relevant flags and back ends.
  std::string version_line() const;
  /// How to make a run fit into the memory: "a larger --spacing means fewer particles".
  std::string memory_advice() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Checks an option against the problem, after parse(). Throws InvalidInput with the line
/// "<option> <value>: must be <allowed>" unless the condition holds.
void require(bool condition, std::string_view option, double value, std::string_view allowed);
void require(bool condition, std::string_view option, std::string_view value,
             std::string_view allowed);

/// Checks that about `particles` of them fit into the memory of this computer. Throws InvalidInput
/// naming --spacing, its value and how many would fit.
void require_memory(double particles, double spacing);

}  // namespace sphmbs::examples
