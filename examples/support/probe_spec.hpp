// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace sphmbs::examples {

/// What a [[probes]] table of a parameter file asks for: where and how often a gas is sampled.
struct ProbeSpec {
  std::string name;
  std::string kind = "point";            // point, line, plane, volume
  std::vector<double> at;                // point [m]
  std::vector<double> from, to;          // ends of a line, corners of a plane (one extent is zero)
                                         // or volume [m]
  int points = 50;                       // samples along a line or the longer side of a plane
  std::vector<std::string> fields{"p"};  // p rho e v speed c T mach
  double interval = 0;                   // [s]; 0: as history.csv
};

}  // namespace sphmbs::examples
