// SPDX-License-Identifier: MIT
#include "support/settings.hpp"

#include <algorithm>
#include <utility>

#include "sphmbs/execution/host_memory.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

std::string sentence(std::string_view name, std::string_view value, const std::string& why) {
  std::string line(name);
  if (!value.empty()) line.append(" ").append(value);
  return one_line(line.append(": ").append(why));
}

}  // namespace

RefusedValue::RefusedValue(std::string_view parameter, std::string_view given,
                           const std::string& reason, std::string_view message)
    : InvalidInput(sentence(parameter, given, reason), message),
      name(parameter),
      value(given),
      why(reason) {}

void require(bool condition, std::string_view name, double value, std::string_view allowed) {
  require(condition, name, format_exact(value), allowed);
}

void require(bool condition, std::string_view name, std::string_view value,
             std::string_view allowed) {
  if (!condition) throw RefusedValue(name, value, "must be " + std::string(allowed));
}

Requirement::Requirement(bool condition, std::string_view name, double value,
                         std::string_view allowed)
    : Requirement(condition, name, format_exact(value), allowed) {}

Requirement::Requirement(bool condition, std::string_view name, std::string_view value,
                         std::string_view allowed)
    : holds(condition), refused(name, value, "must be " + std::string(allowed)) {}

RefusedValues::RefusedValues(std::vector<RefusedValue> some)
    : InvalidInput(some.front().what(), some.front().id), all(std::move(some)) {}

void require_all(const std::vector<Requirement>& requirements) {
  std::vector<RefusedValue> refused;
  for (const Requirement& r : requirements) {
    const auto same = [&r](const RefusedValue& other) {
      return other.name == r.refused.name && other.why == r.refused.why;
    };
    if (!r.holds && std::none_of(refused.begin(), refused.end(), same))
      refused.push_back(r.refused);
  }
  if (!refused.empty()) throw RefusedValues(std::move(refused));
}

void require_memory(double particles, double spacing) {
  constexpr double bytes_per_particle = 600;
  const double most =
      static_cast<double>(execution::HostMemory::device().memory) / bytes_per_particle;
  require(particles < most, "--spacing", spacing,
          "wide enough for the memory of this computer, about " + format_number(most, 2) +
              " particles");
}

}  // namespace sphmbs::examples
