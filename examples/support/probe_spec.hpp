// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "support/complaints.hpp"

namespace sphmbs::examples {

/// A probe of the gas, as a user describes it.
struct ProbeSpec {
  /// Its results are probe_<name>.csv: letters, digits, - and _.
  std::string name{};
  /// point, line, plane or volume.
  std::string kind = "point";
  /// Place of a point [m].
  std::vector<double> at{};
  /// Ends of a line, opposite corners of a plane, one extent of which is zero in space, or of a
  /// volume [m].
  std::vector<double> from{}, to{};
  /// Samples along a line, or along the longer side of a plane.
  int points = 50;
  /// Of p, rho, e, v, speed, c (speed of sound), T (temperature), mach.
  std::vector<std::string> fields{"p"};
  /// Time between samples [s]; 0: as history.csv.
  double interval = 0;
  /// Where it was described, for messages; nowhere by default.
  Place place{};
};

}  // namespace sphmbs::examples
