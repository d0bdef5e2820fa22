// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// Why `path` cannot become the directory of the results, or nothing if it can: it must be new, or
/// empty unless `overwrite` is set, and writable. Changes nothing.
std::optional<std::string> fault_of_output(const std::filesystem::path& path, bool overwrite);

/// Creates the directory of the results, once all input is accepted; existing files stay. Returns
/// whether it is new. Throws OutputError with path and reason.
bool prepare_output(const Settings& settings);

}  // namespace sphmbs::examples
