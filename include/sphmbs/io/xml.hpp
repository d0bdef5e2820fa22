// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace sphmbs::io::detail {

/// Text with the five characters that are markup in XML replaced by their entities.
inline std::string xml_escaped(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&apos;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace sphmbs::io::detail
