// SPDX-License-Identifier: MIT
#pragma once

/// A message without an entry.
inline constexpr const char* said = "W02";
