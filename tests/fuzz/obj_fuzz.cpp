// SPDX-License-Identifier: MIT
// Wavefront OBJ files: any bytes become a shape or are refused by InvalidInput.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <sphmbs/core/error.hpp>
#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/geometry/inspection.hpp>
#include <sphmbs/io/obj.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  try {
    const auto facets = sphmbs::io::parse_obj(content, "fuzz");
    sphmbs::geometry::inspect(facets);
    sphmbs::geometry::Faceted<3>(facets).distance({0.1, 0.2, 0.3});
  } catch (const sphmbs::InvalidInput&) {
  }
  return 0;
}
