// SPDX-License-Identifier: MIT
// Any bytes as a parameter file: read or refused with places, never a crash.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <sphmbs/core/vec.hpp>

#include "support/parameters.hpp"

namespace {

using namespace sphmbs::examples;

/// Parameters of every kind.
struct Case {
  double gamma = 1.4;
  int order = 2;
  std::string kernel = "quintic";
  bool viscous = false;
  sphmbs::Vec<3> corner{1, 2, 3};
  Parameters parameters{{.name = "fuzz",
                         .backends = {"openmp"},
                         .defaults = {.spacing = 1, .until = 1},
                         .structure = true,
                         .dim = 3}};

  Case() {
    parameters.add_number("gas.gamma", gamma, {.above = 1.0}, "", "ratio of specific heats");
    parameters.add_whole_number("scheme.order", order, {.at_least = 1.0}, "", "order");
    parameters.add_choice("scheme.kernel", kernel, {"quintic", "wendland"}, "kernel");
    parameters.add_flag("gas.viscous", viscous, "with viscosity");
    parameters.add_vector("wedge.corner", corner, {.at_least = 0.0}, "m", "corner");
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Case fuzzed;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    fuzzed.parameters.parse_text(text, "fuzz.toml");
  } catch (const BadParameters&) {
    return 0;
  }
  // What was accepted must be accepted again as it is dumped.
  const std::string dump = fuzzed.parameters.dump();
  fuzzed.parameters.parse_text(dump, "dump.toml");
  if (fuzzed.parameters.dump() != dump) __builtin_trap();
  return 0;
}
