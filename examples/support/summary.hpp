// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sphmbs/version.hpp"

namespace sphmbs::examples {

/// Time spent in one part of the program.
struct Phase {
  std::string name{};
  /// Wall-clock time [s].
  double seconds = 0.0;
};

/// Relative change of the conserved quantities over the run, [-]; NaN where it has no meaning. The
/// energy of a structure alone is set against its largest kinetic energy; its mass is constant, and
/// joints take its momentum.
struct Conservation {
  double mass = 0.0;
  double momentum = 0.0;
  double energy = 0.0;
};

/// A number that the run was made for.
struct Result {
  std::string name{};
  double value = 0.0;
  /// Published, exact or measured value in the same unit, if there is one.
  std::optional<double> reference{};
  /// SI unit, "-" for none.
  std::string unit = "-";
};

/// Number of particles at the end of the run.
struct ParticleCounts {
  std::int64_t gas = 0;
  /// Particles that represent walls and bodies.
  std::int64_t virtual_particles = 0;
};

/// Size of a structure and what its integrator did.
struct StructureCounts {
  std::int64_t coordinates = 0;
  std::int64_t conditions = 0;
  std::int64_t redundant = 0;
  std::int64_t iterations = 0;
  std::int64_t factorisations = 0;
  std::int64_t halvings = 0;
  std::int64_t rejected = 0;
  /// Largest violation of a condition at the end, over the size of the structure [-].
  double violation = 0.0;
};

/// What went wrong with the gas of a run, and went on.
struct Incidents {
  /// Particles that left the domain where it lets none out by openings.
  std::int64_t lost = 0;
  /// Steps that failed, and were tried again in shorter ones.
  std::int64_t retries = 0;
  /// Pairs of particles whose reconstruction was not admissible, and that did without.
  std::int64_t refused = 0;
  /// Gas particles that went through thin bodies, where there are such.
  std::optional<std::int64_t> leaked{};
};

/// What the steps of a run sent over the bus of a device, without output.
struct BusCounts {
  double bytes_per_step = 0.0;
  double bytes_per_particle_and_step = 0.0;
  double loops_per_step = 0.0;
  /// Of the loops: what their bodies hold, pointers and parameters.
  double argument_bytes_per_step = 0.0;
};

/// What a run did, for people (Report::finish) and for programs (write_summary).
struct Summary {
  std::string case_name{};
  std::string version{sphmbs::version};
  std::string backend{};
  int threads = 1;
  ParticleCounts particles{};
  /// Of a run with a structure. Without particles beside it, nothing is said of gas.
  std::optional<StructureCounts> structure{};
  /// Of a run on a device.
  std::optional<BusCounts> bus{};
  std::int64_t steps = 0;
  /// Physical time reached [s].
  double time_end = 0.0;
  /// Duration of the run [s].
  double wall_seconds = 0.0;
  std::vector<Phase> phases{};
  /// Number of pairs of neighbours evaluated, over all steps.
  std::int64_t pair_interactions = 0;
  /// Largest amount of memory in use at a time [bytes]; see peak_memory().
  std::uint64_t peak_memory_bytes = 0;
  Conservation conservation{};
  /// Of a run with gas.
  Incidents incidents{};
  std::vector<Result> results{};
};

/// Whether there is gas to speak of.
inline bool has_gas(const Summary& summary) {
  return !summary.structure || summary.particles.gas > 0;
}

/// Pairs of neighbours evaluated per second of wall-clock time; 0 for a run of no duration.
double pair_interactions_per_second(const Summary& summary);

/// Largest amount of memory this process has used so far [bytes].
std::uint64_t peak_memory();

/// Writes the summary as JSON (UTF-8, keys in fixed order; a number that is not finite becomes
/// null). The file appears complete or not at all. Throws OutputError with path and reason; an
/// earlier file is then untouched.
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace sphmbs::examples
