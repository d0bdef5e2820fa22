// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/summary.hpp"

namespace sphmbs::examples {

/// One line of the banner: "key  value", and a second text at the right.
struct BannerLine {
  std::string key{};
  std::string value{};
  std::string aside{};
};

/// Where a run is. Report::progress() is cheap enough to be called in each step.
struct Progress {
  std::int64_t step = 0;
  /// Physical time, last time step, and end of the run [s].
  double time = 0.0;
  double time_step = 0.0;
  double until = 0.0;
  /// What made the time step as short as it is, for example "acoustic".
  std::string_view limited_by{};
  /// Since the start: pairs of neighbours evaluated, in a run with gas, and iterations of Newton's
  /// method, in one with a structure. What is given has a column in a log.
  std::optional<std::int64_t> pair_interactions{};
  std::optional<std::int64_t> iterations{};
};

/// Where and how a Report prints.
struct ReportStyle {
  /// Print nothing but warnings.
  bool quiet = false;
  /// One line of progress that is updated, instead of lines that are appended.
  bool terminal = false;
  /// Columns of the terminal.
  std::size_t width = 100;
  /// Monotonic time [s]; without it, std::chrono::steady_clock.
  std::function<double()> clock{};
};

/// The style for standard output: asks the operating system whether it is a terminal, and its
/// width.
ReportStyle console_style(bool quiet);

/// Prints what a run is, how far it is, and what came out.
///
/// On a terminal the progress is one line that is updated up to ten times per second. In a log it
/// is a line at each 10 % of the physical time and otherwise at most every five seconds.
class Report {
 public:
  /// Warnings go to `err`, all else to `out`; both must outlive the report.
  Report(std::ostream& out, std::ostream& err, ReportStyle style);
  /// For std::cout and std::cerr.
  explicit Report(bool quiet);

  /// Prints "sphmbs <version>  <title>" and the lines below it, aligned.
  void banner(std::string_view title, const std::vector<BannerLine>& lines);
  /// Prints the state if it is time to.
  void progress(const Progress& state);
  /// Prints the first warning of a kind, counts all; finish() prints the counts. `kind` is a short
  /// name such as "time step halved".
  void warn(std::string_view kind, std::string_view message);
  /// Prints steps, times, pairs, memory, conservation, results against references, the warnings and
  /// what was written.
  void finish(const Summary& summary, const std::vector<std::string>& written);

 private:
  struct Warning {
    std::string kind{};
    std::int64_t count = 0;
  };

  void print_bar(const Progress& state, double now);
  void print_row(const Progress& state, double now);
  void clear_bar();
  double seconds_left(const Progress& state, double now) const;

  std::ostream* out_;
  std::ostream* err_;
  ReportStyle style_;
  std::vector<Warning> warnings_{};
  bool started_ = false;
  bool bar_shown_ = false;
  double start_clock_ = 0.0;
  double start_time_ = 0.0;
  double last_clock_ = 0.0;
  std::int64_t last_pairs_ = 0;
  std::int64_t last_iterations_ = 0;
  std::int64_t last_step_ = 0;
  int last_tenth_ = 0;
  int rows_ = 0;
};

}  // namespace sphmbs::examples
