// SPDX-License-Identifier: MIT
#pragma once

// What all pictures share: cairo handles, files, colours, text, ticks and axes. Internal to the
// pictures; programs include support/pictures.hpp. Lengths are in the units of the context, points
// or pixels, with y downwards.

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <cairo.h>

#include "support/pictures.hpp"

namespace sphmbs::examples::canvas {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr Colour black{.red = 0.0, .green = 0.0, .blue = 0.0};
inline constexpr Colour white{.red = 1.0, .green = 1.0, .blue = 1.0};

/// Whether a value can be shown. Also leaves out what a diverged run ends with: differences of such
/// values are not finite.
bool drawable(double value);

// ---- cairo handles and files --------------------------------------------------------------------

/// Releases what the handles below own.
struct Release {
  void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
  void operator()(cairo_pattern_t* pattern) const noexcept { cairo_pattern_destroy(pattern); }
  void operator()(cairo_font_options_t* options) const noexcept {
    cairo_font_options_destroy(options);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Release>;
using Context = std::unique_ptr<cairo_t, Release>;
using Pattern = std::unique_ptr<cairo_pattern_t, Release>;
using FontOptions = std::unique_ptr<cairo_font_options_t, Release>;

/// Stream function of cairo that appends to the std::string `closure` points to.
cairo_status_t append_bytes(void* closure, const unsigned char* data, unsigned int length);

/// Throws OutputError with the reason if cairo could not draw `file`.
void require_success(cairo_status_t status, const std::filesystem::path& file);

/// Throws std::invalid_argument unless `file` has one of the extensions; an empty `second` is none.
void require_extension(const std::filesystem::path& file, std::string_view first,
                       std::string_view second = "");

/// Writes `bytes` as they are. Throws OutputError with path and reason.
void write_file(const std::filesystem::path& file, const std::string& bytes);

/// Writes the surface as PNG. Throws as require_success and write_file.
void write_png(const std::filesystem::path& file, cairo_surface_t* surface);

/// Context without hinting: text has the same width in PNG and SVG and at every scale.
Context make_context(cairo_surface_t* surface);

/// Makes `colour` the source of what is drawn next.
void set_colour(cairo_t* cr, const Colour& colour);

// ---- text and lines -----------------------------------------------------------------------------

/// Position of a text relative to its anchor. `across`: 0 starts, 0.5 is centred, 1 ends there;
/// `down`: 0 has the top of the capitals there, 1 the base line.
struct TextPlace {
  double across = 0.5;
  double down = 0.5;
  bool bold = false;
  bool upwards = false;
};

/// Advance of a text in font size `size`. Leaves that font selected.
double text_width(cairo_t* cr, const std::string& text, double size, bool bold = false);

/// Draws black text at the anchor (x, y), smaller where it would be wider than `available`.
void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size,
               const TextPlace& place, double available = std::numeric_limits<double>::infinity());

/// Adds a line to the path.
void draw_line(cairo_t* cr, double x0, double y0, double x1, double y1);

// ---- ranges -------------------------------------------------------------------------------------

/// Smallest and largest of the values included so far.
struct Extent {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void include(double value);
  bool empty() const { return lower > upper; }
};

/// A range with room for ticks, also for a constant and for no data at all. `margin` is the part of
/// the extent that is added at each end.
Range visible_range(const Extent& extent, bool logarithmic, double margin);

/// Throws std::invalid_argument that starts with `where` if a given range cannot be an axis.
void require_range(const std::optional<Range>& range, bool logarithmic, const std::string& where);

// ---- ticks and axes -----------------------------------------------------------------------------

/// Rectangle of the drawing.
struct Box {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
};

/// Places of ticks, with one label for each major one.
struct Ticks {
  std::vector<double> major{};
  std::vector<std::string> labels{};
  std::vector<double> minor{};
  std::string factor{};  // common to all labels, e.g. "×10⁵", or empty
};

/// Maps values to coordinates of the drawing.
struct Axis {
  Range range{};
  bool logarithmic = false;
  double from = 0.0;  // device coordinate of range.lower
  double to = 0.0;    // device coordinate of range.upper

  /// Coordinate of a value that has a place on the axis.
  double at(double value) const;
  /// Coordinate of any value: NaN where there is no such place on the axis.
  double place(double value) const;
};

/// Width of the widest label.
double widest_label(cairo_t* cr, const Ticks& ticks, double font);

/// As many ticks as their labels leave room for on a horizontal axis of the given length.
Ticks horizontal_ticks(cairo_t* cr, const Range& range, bool logarithmic, double length,
                       double font);

/// Ticks for a vertical axis of the given length.
Ticks vertical_ticks(const Range& range, bool logarithmic, double length, double font);

/// Appearance of the ticks of an axis.
struct TickStyle {
  double font = 11.0;
  double length = 5.0;  // negative: away from the drawing
  bool labels = true;
};

/// Draws the ticks of a horizontal axis at height y, labels below.
void draw_horizontal_ticks(cairo_t* cr, const Axis& axis, const Ticks& ticks, double y,
                           const TickStyle& style);

/// Draws the ticks of a vertical axis at x; labels on its left, or on its right for a colour bar.
void draw_vertical_ticks(cairo_t* cr, const Axis& axis, const Ticks& ticks, double x,
                         const TickStyle& style, bool labels_right = false);

}  // namespace sphmbs::examples::canvas
