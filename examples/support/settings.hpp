// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/core/error.hpp>

#include "support/probe_spec.hpp"

namespace sphmbs::examples {

class OutputLock;

/// What a run does about gas that cannot be accounted for.
struct Guards {
  /// "stop" ends a run whose balance goes beyond its limits, "warn" warns alone, "off" does not
  /// look. Where gas comes in and goes out, "stop" warns too.
  std::string balance = "stop";
  /// Share of the energy at the start that may be unaccounted for before a run stops [-].
  double energy = 0.2;
  /// Gas particles that may go through thin bodies before a run stops; without it, any number.
  std::optional<std::int64_t> leaks{};
};

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
  /// Bound on the error of a coordinate in a step of a structure, over the structure's size [-].
  double newton_tolerance = 1e-10;
  /// Iterations of a structure's step after which it is tried again in halves.
  int newton_iterations = 20;
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
  /// How often the fields are written until the end; without it the program chooses.
  std::optional<int> fields{};
  /// How often the history is sampled until the end; without it the program chooses.
  std::optional<int> samples{};
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
  /// Of a program with gas.
  Guards guards{};
  /// Where the gas is sampled, beside what the program samples.
  std::vector<ProbeSpec> probes{};
  /// All parameters as a parameter file, for used.toml; empty writes none.
  std::string used{};
  /// What is in the files that parameters name, by key: checksum and size.
  std::map<std::string, std::string> contents{};
  /// Keeps other runs out of `output` once prepare_output() has been called; shared by all copies.
  std::shared_ptr<OutputLock> lock{};
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
  /// What is simulated decides on the options: --spacing, --cfl and probes belong to a gas,
  /// --spectral-radius to a structure, and --accuracy to a structure without gas.
  bool gas = true;
  bool structure = false;
  /// Number of coordinates of a place in the gas.
  int dim = 2;
  /// Without any, --help shows two that fit every program.
  std::vector<UsageExample> usage_examples{};
};

/// A value that does not fit the problem. guarded_main() adds where it was given.
struct RefusedValue : InvalidInput {
  /// @param message  id of the entry in docs/messages.md
  RefusedValue(std::string_view parameter, std::string_view given, const std::string& reason,
               std::string_view message = "E023");

  std::string name;   // key or option
  std::string value;  // as it was given, or nearly
  std::string why;    // "must be ..."
};

/// Checks a parameter against the problem, after parse(). `name` is its key or its option. Throws
/// RefusedValue with the line "<name> <value>: must be <allowed>" unless the condition holds.
void require(bool condition, std::string_view name, double value, std::string_view allowed);
void require(bool condition, std::string_view name, std::string_view value,
             std::string_view allowed);

/// A condition between parameters, or of one and the problem; see require().
struct Requirement {
  Requirement(bool condition, std::string_view name, double value, std::string_view allowed);
  Requirement(bool condition, std::string_view name, std::string_view value,
              std::string_view allowed);

  bool holds;
  RefusedValue refused;  // where it does not hold
};

/// All values that do not fit the problem.
struct RefusedValues : InvalidInput {
  explicit RefusedValues(std::vector<RefusedValue> some);
  std::vector<RefusedValue> all;
};

/// Checks several together, so that all complaints come at once. Throws RefusedValues unless all
/// hold.
void require_all(const std::vector<Requirement>& requirements);

/// Checks that about `particles` of them fit into the memory of this computer. Throws RefusedValue
/// naming --spacing, its value and how many would fit.
void require_memory(double particles, double spacing);

}  // namespace sphmbs::examples
