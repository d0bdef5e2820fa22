// SPDX-License-Identifier: MIT
#pragma once

// The tests are written for Catch2 2.13 and also compile with Catch2 3.
#if __has_include(<catch2/catch_all.hpp>)
#include <string>

#include <catch2/catch_all.hpp>

using Catch::Approx;

namespace Catch {
using namespace Matchers;

namespace Matchers {
// Catch2 3 means by Contains that a range has an element, also for text.
inline auto Contains(const char* text) { return ContainsSubstring(text); }
inline auto Contains(const std::string& text) { return ContainsSubstring(text); }
inline auto Contains(std::string& text) { return ContainsSubstring(text); }
inline auto Contains(std::string&& text) { return ContainsSubstring(text); }
}  // namespace Matchers
}  // namespace Catch
#else
#include <catch2/catch.hpp>
#endif
