// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <sphmbs/io/csv.hpp>

#include "support/pictures.hpp"

namespace sphmbs::examples {

/// Quantities over time: kept in memory for pictures and results, and written to a CSV file row by
/// row, so that a run that fails leaves what it had.
class History {
 public:
  /// Adds a quantity; all are added before begin().
  void add(const std::string& name, const std::string& unit);

  /// Creates the file. @throws OutputError with path and reason.
  void begin(const std::filesystem::path& path, const std::string& comment);

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
};

/// Root mean square of (value - reference) / scale over the reference times in [from, to] that the
/// history has reached; NaN if there are none.
double rms_difference(const History& history, const std::string& name,
                      const std::vector<double>& time, const std::vector<double>& reference,
                      const std::vector<double>& scale, double from, double to);

}  // namespace sphmbs::examples
