// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <sphmbs/io/geometry_file.hpp>

namespace sphmbs::io {

namespace detail {

/// Reads the points and faces of Wavefront OBJ, and counts them before it keeps any.
class ObjReader {
 public:
  ObjReader(std::string_view content, std::string_view name, double unit)
      : words_(content, name, "E152", unit) {
    Words counted = words_;
    std::size_t points = 0, triangles = 0;
    do {
      const std::string_view word = counted.next();
      if (word == "v") ++points;
      if (word != "f") continue;
      std::size_t corners = 0;
      while (!counted.next().empty()) ++corners;
      triangles += corners > 2 ? corners - 2 : 0;
    } while (counted.next_line());
    facets_.points.reserve(points);
    facets_.corners.reserve(triangles);
    points_ = points;
  }

  geometry::Facets<3> read() {
    do {
      const std::string_view word = words_.next();
      if (word == "v") read_point();
      if (word == "f") read_face();
    } while (words_.next_line());
    return std::move(facets_);
  }

 private:
  void read_point() {
    Vec<3> x;
    for (int k = 0; k < 3; ++k) x[k] = words_.coordinate(words_.next());
    facets_.points.push_back(x);  // a weight or colours may follow
  }

  void read_face() {
    std::uint32_t first = 0, last = 0;
    std::size_t corners = 0;
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next(), ++corners) {
      const std::uint32_t corner = point(word);
      if (corners == 0) first = corner;
      if (corners > 1) facets_.corners.push_back({first, last, corner});
      last = corner;
    }
    if (corners < 3) words_.fail({}, "a third corner of the face");
  }

  // Points count from 1 on, or backwards from the last one so far; texture and normal follow after
  // a slash.
  std::uint32_t point(std::string_view word) const {
    const std::string_view digits = word.substr(0, word.find('/'));
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = error == std::errc{} && end == digits.data() + digits.size();
    const auto all = static_cast<std::int64_t>(points_);
    const auto so_far = static_cast<std::int64_t>(facets_.points.size());
    if (!whole || number == 0 || number > all || number < -so_far)
      words_.fail(word, "a point from 1 to " + std::to_string(all) + ", or from -1 to -" +
                            std::to_string(so_far) + " counted backwards");
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : so_far + number);
  }

  Words words_;
  geometry::Facets<3> facets_;
  std::size_t points_ = 0;  // in the whole file
};

}  // namespace detail

/// Triangles from the content of a Wavefront OBJ file: its points `v` and its faces `f`, of which
/// those with more than three corners become fans around their first one. All else is ignored.
/// @param name  of the file, for messages
/// @param unit  of the file's coordinates [m]
/// @throws InvalidInput E152 with the line that is wrong.
inline geometry::Facets<3> parse_obj(std::string_view content, std::string_view name,
                                     double unit = metre) {
  detail::check_unit(unit);
  return detail::ObjReader(content, name, unit).read();
}

/// The same from a file: `read_obj("body.obj", io::millimetre)`.
/// @throws InvalidInput also E150 for a file that cannot be read.
inline geometry::Facets<3> read_obj(const std::filesystem::path& path, double unit = metre) {
  return parse_obj(detail::read_geometry_file(path), path.string(), unit);
}

}  // namespace sphmbs::io
