// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sphmbs::examples {

/// The name that was probably meant by an unknown one, or an empty text: the one with the fewest
/// letters changed, added or left out, at most a third of them, or one that begins like it.
std::string nearest_name(std::string_view unknown, const std::vector<std::string>& names);

/// The same for dotted keys, of which the last part alone counts too: "cfl" for "run.cfl".
std::string nearest_key(std::string_view unknown, const std::vector<std::string>& keys);

}  // namespace sphmbs::examples
