// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sphmbs::examples {

/// Shortest text that reads back as the same double: "0.5", "1e-05", "nan".
std::string format_exact(double value);

/// Value with so many significant digits: "0.3128", "1.234e+09".
std::string format_number(double value, int digits = 4);

/// Whole number in groups of three: "18 681".
std::string format_count(std::int64_t count);

/// Memory in the binary unit that suits it: "470 B", "9.1 MiB".
std::string format_bytes(std::uint64_t bytes);

/// Duration for reading [s]: "12.3 s", "6 min 02 s", "1 h 05 min". Not finite: "unknown".
std::string format_duration(double seconds);

/// Remaining time as on a clock [s]: "0:12", "5:32", "1:05:00". Not finite or above 99 h: "-".
std::string format_clock(double seconds);

/// Number of columns on a terminal, taken as the number of code points of a UTF-8 text.
std::size_t text_width(std::string_view text);

/// Text filled with blanks on the right to `width` columns; longer text gets one blank.
std::string padded(std::string_view text, std::size_t width);

/// Text with each control character, line ends included, replaced by a blank.
std::string one_line(std::string_view text);

}  // namespace sphmbs::examples
