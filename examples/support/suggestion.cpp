// SPDX-License-Identifier: MIT
#include "support/suggestion.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace sphmbs::examples {
namespace {

// Names of parameters are shorter; a longer one costs time and resembles none.
constexpr std::size_t longest = 64;
constexpr std::size_t unlike = std::numeric_limits<std::size_t>::max();

/// Letters changed, added, left out, or neighbours that changed places.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (a[i] == b[j] ? 0 : 1), last[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) {
        row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
      }
    }
    before = std::exchange(last, row);
  }
  return last.back();
}

std::string_view without_dashes(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of('-'), text.size()));
}

std::size_t distance(std::string_view unknown, std::string_view name) {
  unknown = without_dashes(unknown);
  name = without_dashes(name);
  if (unknown.empty() || unknown.size() > longest) return unlike;
  if (name.starts_with(unknown)) return 0;
  const std::size_t changes = edit_distance(unknown, name);
  return changes <= std::max<std::size_t>(1, unknown.size() / 3) ? changes : unlike;
}

template <class Distance>
std::string nearest(const std::vector<std::string>& names, const Distance& distance_to) {
  std::string found;
  std::size_t least = unlike;
  for (const std::string& name : names) {
    const std::size_t d = distance_to(name);
    if (d < least) {
      least = d;
      found = name;
    }
  }
  return found;
}

}  // namespace

std::string nearest_name(std::string_view unknown, const std::vector<std::string>& names) {
  return nearest(names, [unknown](std::string_view name) { return distance(unknown, name); });
}

std::string nearest_key(std::string_view unknown, const std::vector<std::string>& keys) {
  const auto last = [](std::string_view key) { return key.substr(key.rfind('.') + 1); };
  const std::string whole = nearest_name(unknown, keys);
  if (!whole.empty()) return whole;
  return nearest(keys, [&](std::string_view key) { return distance(last(unknown), last(key)); });
}

}  // namespace sphmbs::examples
