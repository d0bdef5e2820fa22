// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

#include <sphmbs/core/archive.hpp>

namespace sphmbs::sph {

/// Parts of a step whose time is taken.
enum class Phase : std::size_t { neighbours, slopes, rates, survey, update };
/// Parts of a step, in the order of `Statistics::seconds`.
inline constexpr std::array<std::string_view, 5> phase_names{"neighbours", "slopes", "rates",
                                                             "survey", "update"};

/// What a run has done so far.
struct Statistics {
  std::uint64_t steps = 0;              ///< taken
  std::uint64_t evaluations = 0;        ///< of the rates
  std::uint64_t rebuilds = 0;           ///< of the neighbour lists
  std::uint64_t pair_interactions = 0;  ///< ordered pairs inside the support, over all evaluations
  /// Of them those that met a reconstruction not admissible and did without.
  std::uint64_t falls = 0;
  std::uint64_t retries = 0;  ///< steps that were undone, to be taken again in shorter ones
  /// Spent in each part of the steps [s].
  std::array<double, phase_names.size()> seconds{};

  /// Counts an evaluation of the rates over so many pairs.
  void evaluated(std::uint64_t pairs, std::uint64_t refused) {
    pair_interactions += pairs;
    falls += refused;
    ++evaluations;
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("steps", steps);
    archive("evaluations", evaluations);
    archive("rebuilds", rebuilds);
    archive("pair_interactions", pair_interactions);
    archive("falls", falls);
    archive("retries", retries);
    archive("seconds", seconds);
  }

  /// Adds the time until the returned object dies to a phase.
  auto time(Phase phase) {
    using Clock = std::chrono::steady_clock;
    struct Timer {
      double& seconds;
      Clock::time_point start;
      Timer(double& s, Clock::time_point t) : seconds(s), start(t) {}
      Timer(const Timer&) = delete;
      ~Timer() { seconds += std::chrono::duration<double>(Clock::now() - start).count(); }
    };
    return Timer(seconds[static_cast<std::size_t>(phase)], Clock::now());
  }
};

}  // namespace sphmbs::sph
