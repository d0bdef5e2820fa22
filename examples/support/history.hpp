// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/io/csv.hpp>

#include "support/pictures.hpp"

namespace sphmbs::examples {

/// Quantities over time: kept in memory for pictures and results, and written to a CSV file row by
/// row, so that a run that fails leaves what it had.
class History {
 public:
  /// Adds a quantity; all are added before begin().
  void add(const std::string& name, const std::string& unit);

  /// Creates the file; after a restore, goes on with the earlier one behind the rows that were
  /// restored. @throws OutputError with path and reason.
  void begin(const std::filesystem::path& path, const std::string& comment);

  /// All rows, and how long the file is.
  template <Archive A>
  void visit_state(A& archive) {
    std::uint64_t bytes = file_ ? file_->bytes() : 0;
    archive("time", time_);
    archive("values", values_);
    archive("bytes", bytes);
    if constexpr (A::restores) restored_bytes_ = bytes;
  }

  /// Adds a row: the time [s] and one value a quantity, in the order they were added.
  void row(double time, const std::vector<double>& values);

  const std::vector<double>& time() const { return time_; }
  /// All values of a quantity. @throws std::out_of_range for an unknown name.
  const std::vector<double>& of(const std::string& name) const;
  bool has(const std::string& name) const;
  /// Linear interpolation of a quantity at a time; NaN outside the rows.
  double at(const std::string& name, double time) const;
  /// The quantity as a curve.
  Curve curve(const std::string& name, const std::string& label) const;

 private:
  std::vector<io::CsvWriter::Column> columns_;
  std::vector<double> time_;
  std::vector<std::vector<double>> values_;
  std::unique_ptr<io::CsvWriter> file_;
  std::uint64_t restored_bytes_ = 0;
};

/// Root mean square of (value - reference) / scale over the reference times in [from, to] that the
/// history has reached; NaN if there are none.
double rms_difference(const History& history, const std::string& name,
                      const std::vector<double>& time, const std::vector<double>& reference,
                      const std::vector<double>& scale, double from, double to);

/// Mean of a quantity over [from, to], and its standard deviation about the parabola that fits it
/// best there; NaN for fewer than four rows.
struct Spread {
  double mean;
  double deviation;
};
Spread spread_of(const History& history, const std::string& name, double from, double to);

/// Times and values of a quantity, published or by another solution.
struct ReferenceCurve {
  std::vector<double> time;
  std::vector<double> value;

  /// As open circles, not more than some thirty, up to a time.
  Curve curve(const std::string& label, double until) const;
  /// Its value at one of its times; NaN at others.
  double at(double when) const;
  /// What a quantity of the history has more, at the reference times that the history has reached.
  Curve difference(const History& history, const std::string& name, const std::string& label) const;
};

/// Column `member` of a table of rows with a time t.
template <class Rows, class Row>
ReferenceCurve reference_curve(const Rows& rows, double Row::*member) {
  ReferenceCurve reference;
  for (const Row& row : rows) {
    reference.time.push_back(row.t);
    reference.value.push_back(row.*member);
  }
  return reference;
}

/// Largest magnitude of a curve up to a time.
double largest_until(const Curve& curve, double time);

}  // namespace sphmbs::examples
