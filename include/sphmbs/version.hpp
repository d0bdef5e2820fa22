// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// Version of the library, by semantic versioning. The build files read these three lines.
#define SPHMBS_VERSION_MAJOR 0
#define SPHMBS_VERSION_MINOR 1
#define SPHMBS_VERSION_PATCH 0

#define SPHMBS_DETAIL_TEXT(x) #x
#define SPHMBS_DETAIL_VERSION(major, minor, patch) \
  SPHMBS_DETAIL_TEXT(major) "." SPHMBS_DETAIL_TEXT(minor) "." SPHMBS_DETAIL_TEXT(patch)

namespace sphmbs {

/// Version as "major.minor.patch".
inline constexpr std::string_view version =
    SPHMBS_DETAIL_VERSION(SPHMBS_VERSION_MAJOR, SPHMBS_VERSION_MINOR, SPHMBS_VERSION_PATCH);

}  // namespace sphmbs

#undef SPHMBS_DETAIL_VERSION
#undef SPHMBS_DETAIL_TEXT
