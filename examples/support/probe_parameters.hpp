// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "support/complaints.hpp"
#include "support/given.hpp"
#include "support/probe_spec.hpp"

namespace sphmbs::examples {

/// The [[probes]] tables of a parameter file for a gas of `dim` dimensions. What is wrong with them
/// is added to the complaints, and then the result is of no use.
std::vector<ProbeSpec> read_probes(const Given& given, int dim, Complaints& complaints);

/// Probes as [[probes]] tables.
std::string dump_probes(const std::vector<ProbeSpec>& probes);

}  // namespace sphmbs::examples
