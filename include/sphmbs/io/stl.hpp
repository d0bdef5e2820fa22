// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <sphmbs/io/geometry_file.hpp>

namespace sphmbs::io {

namespace detail {

constexpr std::size_t stl_head = 80, stl_facet = 50;  // [B]

inline std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;)
    value = (value << 8) | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// Case does not matter in STL, and some programs begin with blanks.
inline bool is_word(std::string_view found, std::string_view wanted) {
  return std::equal(found.begin(), found.end(), wanted.begin(), wanted.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

/// Binary where the number of facets that it states fits its size, even if it begins with "solid"
/// as texts do; else by how it begins, where zeros are in no text.
inline bool is_binary_stl(std::string_view content) {
  if (content.size() >= stl_head + 4 &&
      content.size() == stl_head + 4 + stl_facet * std::size_t{little_endian(content, stl_head)})
    return true;
  std::string_view start = content.substr(0, 1024);
  if (start.find('\0') != std::string_view::npos) return true;
  Words words(start, "", "E151", 1);
  return !is_word(words.next_anywhere(), "solid");
}

inline geometry::Facets<3> binary_stl(std::string_view content, std::string_view name,
                                      double unit) {
  const auto refuse = [&](std::size_t byte, const std::string& what) {
    return InvalidInput(std::string(name) + ":byte " + std::to_string(byte) + ": " + what, "E151");
  };
  if (content.size() < stl_head + 4)
    throw refuse(
        content.size(),
        "end of file: must be STL, a text that begins with \"solid\" or at least 84 bytes");
  const std::size_t count = little_endian(content, stl_head);
  const std::size_t room = (content.size() - stl_head - 4) / stl_facet;
  if (count > room)
    throw refuse(stl_head, std::to_string(count) + " triangles stated: must be at most the " +
                               std::to_string(room) + " that the file has room for");
  geometry::Facets<3> facets;
  facets.points.reserve(3 * count);
  facets.corners.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(facets.points.size());
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec<3> x;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = stl_head + 4 + stl_facet * i + 12 * (corner + 1) + 4 * k;
        const double value = std::bit_cast<float>(little_endian(content, at));
        x[static_cast<int>(k)] = unit * value;
        if (!(std::abs(unit * value) <= geometry::Facets<3>::farthest))
          throw refuse(at, "coordinate " + std::to_string(value) + " of triangle " +
                               std::to_string(i) + ": must be finite and below 1e30 m");
      }
      facets.points.push_back(x);
    }
    facets.corners.push_back({first, first + 1, first + 2});
  }
  return facets;
}

inline geometry::Facets<3> text_stl(std::string_view content, std::string_view name, double unit) {
  Words words(content, name, "E151", unit);
  const auto expect = [&](std::string_view wanted) {
    const std::string_view word = words.next_anywhere();
    if (!is_word(word, wanted)) words.fail(word, quoted(wanted));
  };
  geometry::Facets<3> facets;
  constexpr std::size_t shortest = 85;  // characters of a facet
  facets.points.reserve(3 * (content.size() / shortest + 1));
  facets.corners.reserve(content.size() / shortest + 1);
  expect("solid");
  while (true) {
    words.next_line();  // what follows "solid" is a name
    for (std::string_view word = words.next_anywhere(); !is_word(word, "endsolid");
         word = words.next_anywhere()) {
      if (!is_word(word, "facet")) words.fail(word, "\"facet\" or \"endsolid\"");
      expect("normal");
      for (int k = 0; k < 3; ++k) words.next_anywhere();  // follows from the corners
      expect("outer");
      expect("loop");
      const auto first = static_cast<std::uint32_t>(facets.points.size());
      for (int corner = 0; corner < 3; ++corner) {
        expect("vertex");
        Vec<3> x;
        for (int k = 0; k < 3; ++k) x[k] = words.coordinate(words.next_anywhere());
        facets.points.push_back(x);
      }
      expect("endloop");
      expect("endfacet");
      facets.corners.push_back({first, first + 1, first + 2});
    }
    words.next_line();
    const std::string_view word = words.next_anywhere();
    if (word.empty()) return facets;
    if (!is_word(word, "solid")) words.fail(word, "\"solid\" or the end of the file");
  }
}

}  // namespace detail

/// Triangles from the content of an STL file, text or binary. Points are not shared by triangles.
/// @param name  of the file, for messages
/// @param unit  of the file's coordinates [m]
/// @throws InvalidInput E151 with the line, or the byte of a binary file, that is wrong.
inline geometry::Facets<3> parse_stl(std::string_view content, std::string_view name,
                                     double unit = metre) {
  detail::check_unit(unit);
  return detail::is_binary_stl(content) ? detail::binary_stl(content, name, unit)
                                        : detail::text_stl(content, name, unit);
}

/// The same from a file: `read_stl("body.stl", io::millimetre)`.
/// @throws InvalidInput also E150 for a file that cannot be read.
inline geometry::Facets<3> read_stl(const std::filesystem::path& path, double unit = metre) {
  return parse_stl(detail::read_geometry_file(path), path.string(), unit);
}

}  // namespace sphmbs::io
