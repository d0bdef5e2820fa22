// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include <sphmbs/io/path_data.hpp>

namespace sphmbs::io {

/// How a path is read.
struct PathOptions {
  double unit = metre;  ///< of the file's coordinates [m]
  /// Distance of curves from the pieces that they become, by the path's size [-].
  double flatness = 1e-4;
};

namespace detail {

/// Path data begin with M and a number, as no row of numbers does and no usual title.
inline bool is_path_data(std::string_view content) {
  Words words(content, "", "E153", metre, ",");
  const std::string_view word = words.next_anywhere();
  if (!word.starts_with('M') && !word.starts_with('m')) return false;
  const std::string_view number = word.size() > 1 ? word.substr(1) : words.next_anywhere();
  return !number.empty() &&
         std::string_view("0123456789+-.").find(number[0]) != std::string_view::npos;
}

inline geometry::Facets<2> path_data(std::string_view content, std::string_view name,
                                     const PathOptions& options) {
  if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);
  PathExtent extent;
  PathData(content, name, options.unit, extent).follow();
  const double size = std::sqrt(norm2(extent.box.upper - extent.box.lower));
  OutlineBuilder outline(options.flatness * size);
  outline.reserve(extent.points);
  PathData(content, name, options.unit, outline).follow();
  return outline.finish();
}

inline geometry::Facets<2> path_rows(std::string_view content, std::string_view name,
                                     const PathOptions& options) {
  Words words(content, name, "E153", options.unit, ",;");
  OutlineBuilder outline(0);
  outline.reserve(content.size() / 4 + 1);  // the shortest row is four characters
  const auto close = [&] {
    const std::size_t corners = outline.close();
    if (corners == 1 || corners == 2)
      words.fail({}, "a third corner of the outline that ends here");
  };
  bool title = true;  // a line of other words may come first
  do {
    const std::string_view x = words.next();
    if (x.empty()) {
      if (!words.at_comment()) close();
      continue;
    }
    const bool number = std::string_view("0123456789+-.").find(x[0]) != std::string_view::npos;
    if (number || !title) {
      const double at = words.coordinate(x);
      outline.line({at, words.coordinate(words.next())});
      if (const std::string_view more = words.next(); !more.empty())
        words.fail(more, "the end of the line, after two coordinates");
    }
    title = false;
  } while (words.next_line());
  close();
  return outline.finish();
}

}  // namespace detail

/// Closed outlines in the plane from text: rows `x y` or `x,y`, where an empty line parts outlines,
/// or path data of SVG such as `M 0 0 H 2 A 1 1 0 0 1 0 0 Z`, whose curves become straight pieces.
/// What follows `#` is a comment. Rows may have a line with their name first.
/// @param name  of the file, for messages
/// @throws InvalidInput E153 with the line that is wrong.
inline geometry::Facets<2> parse_path(std::string_view content, std::string_view name,
                                      const PathOptions& options = {}) {
  detail::check_unit(options.unit);
  expects(options.flatness >= 1e-8 && options.flatness <= 0.1, "flatness", options.flatness,
          "between 1e-8 and 0.1 of the path's size");
  return detail::is_path_data(content) ? detail::path_data(content, name, options)
                                       : detail::path_rows(content, name, options);
}

/// The same from a file: `read_path("profile.txt", {.unit = io::millimetre})`.
/// @throws InvalidInput also E150 for a file that cannot be read.
inline geometry::Facets<2> read_path(const std::filesystem::path& path,
                                     const PathOptions& options = {}) {
  return parse_path(detail::read_geometry_file(path), path.string(), options);
}

}  // namespace sphmbs::io
