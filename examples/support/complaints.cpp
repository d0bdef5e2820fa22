// SPDX-License-Identifier: MIT
#include "support/complaints.hpp"

#include <algorithm>
#include <tuple>

#include "support/text.hpp"

namespace sphmbs::examples {

std::string to_text(const Place& place) {
  if (place.line == 0) return place.source;
  return place.source + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

void Complaints::add(const Place& place, std::string_view id, const std::string& text) {
  all_.push_back({place, id, text});
}

void Complaints::raise() const {
  if (all_.empty()) return;
  std::vector<Complaint> sorted = all_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Complaint& a, const Complaint& b) {
    const auto order = [](const Place& p) {
      return std::tuple(p.source == "command line", p.line, p.column);
    };
    return order(a.place) < order(b.place);
  });
  std::string message;
  for (const Complaint& c : sorted)
    message += one_line(to_text(c.place) + ": error " + std::string(c.id) + " " + c.text) + "\n";
  const std::size_t count = sorted.size();
  message += format_count(static_cast<std::int64_t>(count)) + (count == 1 ? " error" : " errors") +
             "; nothing was written";
  throw BadParameters(message, sorted.front().id);
}

}  // namespace sphmbs::examples
