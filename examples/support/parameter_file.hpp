// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "support/complaints.hpp"
#include "support/given.hpp"

namespace sphmbs::examples {

/// The text of a parameter file, or nothing and a complaint: it is missing, a directory, too large
/// to be one, or no text.
std::optional<std::string> read_parameter_file(const std::string& path, Complaints& complaints);

/// The tables and values of a TOML text, or nothing and a complaint. `name` is that of the file in
/// places.
std::optional<Given> parse_toml(std::string_view text, const std::string& name,
                                Complaints& complaints);

}  // namespace sphmbs::examples
