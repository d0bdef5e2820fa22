// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/archive.hpp>

#include "support/history.hpp"

namespace sphmbs::examples {

/// What a session samples: history.csv, at times of its own, and trajectories.csv, at every
/// multiple of an interval.
class Recorder {
 public:
  /// Interval of trajectories.csv [s].
  static constexpr double trace_interval = 5e-3;
  /// Adds the values of its columns to a row.
  using Sampler = std::function<void(std::vector<double>&)>;

  /// Columns of history.csv.
  void record(const std::vector<io::CsvWriter::Column>& columns, Sampler sampler) {
    for (const auto& column : columns) history.add(column.name, column.unit);
    sampled_.push_back(std::move(sampler));
  }
  /// A column of history.csv.
  void record(const std::string& name, const std::string& unit, std::function<double()> value) {
    record({{name, unit}},
           [value = std::move(value)](std::vector<double>& row) { row.push_back(value()); });
  }
  /// A column of trajectories.csv.
  void trace(const std::string& name, const std::string& unit, std::function<double()> value) {
    traces.add(name, unit);
    traced_.push_back(std::move(value));
  }

  /// Whether there are trajectories.
  bool has_traces() const { return !traced_.empty(); }
  /// Names of the files.
  std::vector<std::string> names() const {
    if (has_traces()) return {"history.csv", "trajectories.csv"};
    return {"history.csv"};
  }
  /// A fixed step, shortened so that trajectories meet their times.
  std::optional<double> step(std::optional<double> wanted) const {
    if (!wanted || !has_traces()) return wanted;
    return trace_interval / std::ceil(trace_interval / *wanted - 1e-9);
  }

  /// Creates the files, or goes on with them. @throws OutputError with path and reason.
  void begin(const std::filesystem::path& folder, const std::string& comment) {
    history.begin(folder / "history.csv", comment);
    if (has_traces()) traces.begin(folder / "trajectories.csv", comment);
  }

  /// Adds a row to history.csv. @throws OutputError with path and reason.
  void sample(double time) {
    std::vector<double> row;
    for (const Sampler& add : sampled_) add(row);
    history.row(time, row);
  }
  /// Adds a row to trajectories.csv, if there are any. @throws OutputError with path and reason.
  void trace(double time) {
    if (!has_traces()) return;
    std::vector<double> row;
    for (const auto& value : traced_) row.push_back(value());
    const double due = trace_interval * std::round(time / trace_interval);
    traces.row(std::abs(time - due) < 1e-9 * trace_interval ? due : time, row);
  }

  template <Archive A>
  void visit_state(A& archive) {
    archive("history", history);
    archive("traces", traces);
  }

  History history{};
  History traces{};

 private:
  std::vector<Sampler> sampled_;
  std::vector<std::function<double()>> traced_;
};

}  // namespace sphmbs::examples
