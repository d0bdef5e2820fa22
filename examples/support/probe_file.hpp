// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/io/csv.hpp>

#include "support/probe_spec.hpp"

namespace sphmbs::examples {

/// The space that probes lie in: as many axes as `dim`, the rest is zero.
struct ProbeSpace {
  int dim = 3;
  std::array<double, 3> lower{}, upper{};  // of the domain [m]
  std::array<bool, 3> periodic{};
};

/// Where a probe samples.
struct ProbePlaces {
  std::vector<std::array<double, 3>> points{};  // of a volume: its lower and its upper corner [m]
  std::vector<double> arc{};                    // from the first point, of a line [m]
  int along_row = 0;                            // points in a row, of a plane
};

/// The points of a probe. Along a period places may lie beyond the domain.
/// @throws InvalidInput naming the probe and what is wrong: E050 for a place outside the domain,
///         E052 for a description that is none.
ProbePlaces places_of(const ProbeSpec& spec, const ProbeSpace& space);

/// How far a probe's output is: plain numbers, for a checkpoint.
struct ProbeProgress {
  std::int64_t samples = 0;    // times that were sampled
  std::int64_t rows = 0;       // of the CSV file, without its two lines of head
  std::int64_t bytes = 0;      // of the CSV file
  std::int64_t blind = 0;      // values that are nan because there was no gas
  std::int64_t intervals = 0;  // number of the next interval that begins with a sample
  double sampled = -1;         // time of the last sample [s]

  template <Archive A>
  void visit_state(A& archive) {
    archive("samples", samples);
    archive("rows", rows);
    archive("bytes", bytes);
    archive("blind", blind);
    archive("intervals", intervals);
    archive("sampled", sampled);
  }
};

/// The results of one probe: probe_<name>.csv and, of a plane, probe_<name>_0001.vtp and so on.
class ProbeFile {
 public:
  /// @param space  of the domain
  /// @throws InvalidInput as places_of.
  ProbeFile(ProbeSpec spec, const ProbeSpace& space);

  const ProbeSpec& spec() const { return spec_; }
  const ProbePlaces& places() const { return places_; }

  /// Creates the CSV file, or goes on after what the progress says was written.
  /// @param columns  those of the fields; time, places and particles seen are added
  /// @throws OutputError with path and reason.
  void begin(const std::filesystem::path& folder, const std::string& comment,
             const std::vector<io::CsvWriter::Column>& columns,
             const std::optional<ProbeProgress>& resume);

  /// Writes the values of all points at a time, point after point, and of a plane a .vtp file.
  /// @throws OutputError with path and reason.
  void write(double time, std::span<const double> values);

  /// Of what was written.
  ProbeProgress& progress() { return progress_; }
  const ProbeProgress& progress() const { return progress_; }
  /// File names, relative to the folder.
  std::vector<std::string> names() const;

 private:
  std::vector<io::CsvWriter::Column> head(const std::vector<io::CsvWriter::Column>& columns) const;
  void write_surface(double time, std::span<const double> values) const;

  ProbeSpec spec_;
  ProbeSpace space_;
  ProbePlaces places_;
  std::filesystem::path folder_;
  std::vector<io::CsvWriter::Column> columns_;
  std::optional<io::CsvWriter> csv_;
  ProbeProgress progress_;
};

}  // namespace sphmbs::examples
