// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/sph/survey.hpp>

namespace sphmbs::sph {

/// Keeps a run from going on where it leads nowhere: a step that fails is tried again half as long,
/// a few times, and steps that stay tiny end the run.
class Pace {
 public:
  static constexpr int most_retries = 8;     ///< of one step
  static constexpr int most_tiny = 20;       ///< steps in a row
  static constexpr double tiny = 1e-6;       ///< of the first step, where no floor is given [-]
  static constexpr double most_parts = 256;  ///< that a fixed step is divided into

  /// Steps below this are tiny [s].
  void set_floor(double floor) { floor_ = floor; }

  /// No try may be longer than this [s].
  double longest() const { return longest_; }
  /// Whether the last try failed.
  bool retrying() const { return retries_ > 0; }
  /// Whether no more tries are left.
  bool exhausted() const { return retries_ >= most_retries; }

  /// Whether parts of this length would be too many for what is left of a fixed step.
  static bool too_small(double part, double left, bool fixed) {
    return fixed && !(left <= most_parts * part);
  }

  /// A try of length dt failed and was undone.
  void failed(double dt) {
    ++retries_;
    longest_ = dt / 2;
  }
  /// A try was a step. @param whole  whether it ended the step that the failed ones were parts of
  void went(bool whole) {
    retries_ = 0;
    if (whole) longest_ = std::numeric_limits<double>::infinity();
  }

  /// Whether the limits of so many steps in a row were tiny. @param dt  what limits allow now [s]
  bool collapsed(double dt) {
    if (!(dt > 0)) return true;
    if (floor_ < 0 && std::isfinite(dt)) floor_ = tiny * dt;
    count_ = dt < floor_ ? count_ + 1 : 0;
    return count_ >= most_tiny;
  }

  /// What a checkpoint keeps of it, see `Archive`; between steps, when no try is under way.
  template <Archive A>
  void visit_state(A& archive) {
    archive("floor", floor_);
    archive("tiny", count_);
  }

 private:
  double floor_ = -1;  // [s]; below 0 before the first step
  double longest_ = std::numeric_limits<double>::infinity();
  int retries_ = 0;
  int count_ = 0;
};

/// The same failure, its first line saying how often the step was tried.
inline NumericalFailure after_retries(const NumericalFailure& failure) {
  std::string text = failure.what();
  text.insert(std::min(text.find('\n'), text.size()),
              " (after " + std::to_string(Pace::most_retries) + " retries with shorter steps)");
  return NumericalFailure(text, failure.id, failure.particles);
}

}  // namespace sphmbs::sph
