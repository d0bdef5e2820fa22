// SPDX-License-Identifier: MIT
#include "support/pictures.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <cairo-svg.h>
#include <cairo.h>

#include "sphmbs/core/error.hpp"

namespace sphmbs::examples {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Colour black{.red = 0.0, .green = 0.0, .blue = 0.0};
constexpr Colour white{.red = 1.0, .green = 1.0, .blue = 1.0};
constexpr Colour grid_grey{.red = 0.87, .green = 0.87, .blue = 0.87};
constexpr Colour missing_grey{.red = 0.6, .green = 0.6, .blue = 0.6};

// Also leaves out what a diverged run ends with: differences of such values are not finite.
bool drawable(double value) { return std::abs(value) <= 1e300; }

// ---- cairo handles and files --------------------------------------------------------------------

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

cairo_status_t append_bytes(void* closure, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(closure)->append(data, data + length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

void require_success(cairo_status_t status, const std::filesystem::path& file) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw OutputError("cannot draw " + file.string() + ": " + cairo_status_to_string(status));
  }
}

void write_file(const std::filesystem::path& file, const std::string& bytes) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) {
    throw OutputError("cannot write " + file.string() + ": " +
                      std::generic_category().message(errno));
  }
}

void write_png(const std::filesystem::path& file, cairo_surface_t* surface) {
  std::string bytes;
  require_success(cairo_surface_write_to_png_stream(surface, append_bytes, &bytes), file);
  write_file(file, bytes);
}

// Without hinting, text has the same width in PNG and SVG and at every scale.
Context make_context(cairo_surface_t* surface) {
  Context context(cairo_create(surface));
  const FontOptions options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context.get(), options.get());
  return context;
}

void set_colour(cairo_t* cr, const Colour& colour) {
  cairo_set_source_rgb(cr, colour.red, colour.green, colour.blue);
}

// ---- text ---------------------------------------------------------------------------------------

// Position of a text relative to its anchor. `across`: 0 starts, 0.5 is centred, 1 ends there;
// `down`: 0 has the top of the capitals there, 1 the base line.
struct TextPlace {
  double across = 0.5;
  double down = 0.5;
  bool bold = false;
  bool upwards = false;
};

constexpr double capital_height = 0.73;  // of DejaVu Sans, in font sizes

double text_width(cairo_t* cr, const std::string& text, double size, bool bold = false) {
  cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size,
               const TextPlace& place, double available = std::numeric_limits<double>::infinity()) {
  if (text.empty()) return;
  double width = text_width(cr, text, size, place.bold);
  if (width > available) {
    size *= available / width;
    width = text_width(cr, text, size, place.bold);
  }
  cairo_save(cr);
  cairo_translate(cr, x, y);
  if (place.upwards) cairo_rotate(cr, -std::numbers::pi / 2.0);
  cairo_move_to(cr, -place.across * width, (1.0 - place.down) * capital_height * size);
  set_colour(cr, black);
  cairo_show_text(cr, text.c_str());
  cairo_restore(cr);
}

std::string fixed_number(double value, int decimals) {
  std::array<char, 400> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  const std::string text(digits.data(), end);
  if (text.find_first_not_of("-0.") == std::string::npos) return text.substr(text[0] == '-');
  return text[0] == '-' ? "−" + text.substr(1) : text;
}

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> superscripts{"⁰", "¹", "²", "³", "⁴",
                                                          "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) {
    text += superscripts[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

// ---- ticks --------------------------------------------------------------------------------------

struct Ticks {
  std::vector<double> major{};
  std::vector<std::string> labels{};
  std::vector<double> minor{};
  std::string factor{};  // common to all labels, e.g. "×10⁵", or empty
};

std::vector<double> multiples_within(const Range& range, double step) {
  std::vector<double> values;
  const double slack = 1e-9 * (range.upper - range.lower);
  const double first = std::ceil((range.lower - slack) / step);
  const double last = std::floor((range.upper + slack) / step);
  const int count = static_cast<int>(std::max(last - first + 1.0, 0.0));
  for (int i = 0; i < count; ++i) values.push_back((first + i) * step);
  return values;
}

Ticks linear_ticks(const Range& range, double wanted) {
  const double raw = (range.upper - range.lower) / std::max(wanted, 1.0);
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / decade <= 1.0   ? 1.0
                       : raw / decade <= 2.0 ? 2.0
                       : raw / decade <= 5.0 ? 5.0
                                             : 10.0;
  const double step = digit * decade;
  Ticks ticks{.major = multiples_within(range, step),
              .minor = multiples_within(range, step / (digit == 2.0 ? 4.0 : 5.0))};

  const double largest = std::max(std::abs(range.lower), std::abs(range.upper));
  int exponent = 0;
  if (largest >= 1e5 || largest < 1e-2)
    exponent = static_cast<int>(std::floor(std::log10(largest)));
  const double factor = std::pow(10.0, exponent);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step / factor) - 1e-9)));
  for (const double value : ticks.major) {
    ticks.labels.push_back(fixed_number(value / factor, decimals));
  }
  if (exponent != 0) ticks.factor = "×" + power_of_ten(exponent);
  return ticks;
}

Ticks log_ticks(const Range& range, double wanted) {
  const int first = static_cast<int>(std::floor(std::log10(range.lower) + 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(range.upper) + 1e-9));
  const auto inside = [&range](double value) {
    return value >= range.lower * (1.0 - 1e-9) && value <= range.upper * (1.0 + 1e-9);
  };
  const bool many_decades = last - first >= 3;
  const int stride =
      std::max(1, static_cast<int>(std::ceil((last - first + 1) / std::max(wanted, 1.0))));
  const bool plain_numbers = first >= -4 && last <= 4;

  Ticks ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, exponent);
      if (!inside(value)) continue;
      const bool labelled = many_decades ? digit == 1 && exponent % stride == 0
                                         : digit == 1 || digit == 2 || digit == 5;
      if (!labelled) {
        if (digit == 1 || stride == 1) ticks.minor.push_back(value);
        continue;
      }
      ticks.major.push_back(value);
      if (!many_decades && plain_numbers) {
        ticks.labels.push_back(fixed_number(value, std::max(0, -exponent)));
      } else {
        ticks.labels.push_back((digit == 1 ? "" : std::to_string(digit) + "·") +
                               power_of_ten(exponent));
      }
    }
  }
  return ticks.major.size() < 2 ? linear_ticks(range, wanted) : ticks;
}

// ---- axes ---------------------------------------------------------------------------------------

struct Axis {
  Range range{};
  bool logarithmic = false;
  double from = 0.0;  // device coordinate of range.lower
  double to = 0.0;    // device coordinate of range.upper

  double at(double value) const {
    const double fraction =
        logarithmic ? std::log(value / range.lower) / std::log(range.upper / range.lower)
                    : (value - range.lower) / (range.upper - range.lower);
    return from + fraction * (to - from);
  }

  // NaN where there is no such place on the axis. Coordinates beyond cairo's 24-bit integers are
  // brought back to its limits, far outside of any picture.
  double place(double value) const {
    if (!drawable(value) || (logarithmic && value <= 0.0)) return nan;
    return std::clamp(at(value), -4e6, 4e6);
  }
};

Ticks axis_ticks(const Range& range, bool logarithmic, double wanted) {
  return logarithmic ? log_ticks(range, wanted) : linear_ticks(range, wanted);
}

double widest_label(cairo_t* cr, const Ticks& ticks, double font) {
  double widest = 0.0;
  for (const std::string& label : ticks.labels) {
    widest = std::max(widest, text_width(cr, label, font));
  }
  return widest;
}

// As many ticks as their labels leave room for on a horizontal axis of the given length.
Ticks horizontal_ticks(cairo_t* cr, const Range& range, bool logarithmic, double length,
                       double font) {
  double wanted = std::clamp(length / (4.0 * font), 2.0, 12.0);
  for (;;) {
    Ticks ticks = axis_ticks(range, logarithmic, wanted);
    const double widest = widest_label(cr, ticks, font);
    const double room = length / std::max<double>(1.0, static_cast<double>(ticks.labels.size()));
    if (widest + 0.9 * font <= room || wanted <= 2.0) return ticks;
    wanted = std::max(2.0, wanted - 1.0);
  }
}

void draw_line(cairo_t* cr, double x0, double y0, double x1, double y1) {
  cairo_move_to(cr, x0, y0);
  cairo_line_to(cr, x1, y1);
}

struct TickStyle {
  double font = 11.0;
  double length = 5.0;  // negative: away from the drawing
  bool labels = true;
};

// Ticks of a horizontal axis at height y, labels below.
void draw_horizontal_ticks(cairo_t* cr, const Axis& axis, const Ticks& ticks, double y,
                           const TickStyle& style) {
  for (const double value : ticks.major) {
    draw_line(cr, axis.at(value), y, axis.at(value), y - style.length);
  }
  for (const double value : ticks.minor) {
    draw_line(cr, axis.at(value), y, axis.at(value), y - 0.5 * style.length);
  }
  set_colour(cr, black);
  cairo_stroke(cr);
  if (!style.labels) return;
  const double top = y + std::max(0.0, -style.length) + 0.5 * style.font;
  double free_from = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    const double x = axis.at(ticks.major[i]);
    const double half = 0.5 * text_width(cr, ticks.labels[i], style.font);
    if (x - half < free_from) continue;
    free_from = x + half + 0.5 * style.font;
    draw_text(cr, ticks.labels[i], x, top, style.font, {.across = 0.5, .down = 0.0});
  }
}

// Ticks of a vertical axis at x; labels on its left, or on its right for a colour bar.
void draw_vertical_ticks(cairo_t* cr, const Axis& axis, const Ticks& ticks, double x,
                         const TickStyle& style, bool labels_right = false) {
  const double inwards = labels_right ? -style.length : style.length;
  for (const double value : ticks.major) {
    draw_line(cr, x, axis.at(value), x + inwards, axis.at(value));
  }
  for (const double value : ticks.minor) {
    draw_line(cr, x, axis.at(value), x + 0.5 * inwards, axis.at(value));
  }
  set_colour(cr, black);
  cairo_stroke(cr);
  if (!style.labels) return;
  const double gap = std::max(0.0, -style.length) + 0.45 * style.font;
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    draw_text(cr, ticks.labels[i], labels_right ? x + gap : x - gap, axis.at(ticks.major[i]),
              style.font, {.across = labels_right ? 0.0 : 1.0, .down = 0.5});
  }
}

// ---- ranges -------------------------------------------------------------------------------------

struct Extent {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void include(double value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  bool empty() const { return lower > upper; }
};

// A range with room for ticks, also for a constant and for no data at all.
Range visible_range(const Extent& extent, bool logarithmic, double margin) {
  if (extent.empty()) return logarithmic ? Range{0.1, 10.0} : Range{0.0, 1.0};
  if (logarithmic) {
    const double ratio = std::max(extent.upper / extent.lower, 1.0);
    const double factor = ratio < 1.0 + 1e-9 ? 2.0 : std::pow(ratio, margin);
    return {extent.lower / factor, extent.upper * factor};
  }
  const double largest = std::max(std::abs(extent.lower), std::abs(extent.upper));
  const double span = extent.upper - extent.lower;
  // Round-off about a constant is not worth an axis of its own.
  if (span <= 1e-12 * largest) {
    const double half = largest > 0.0 ? 0.05 * largest : 1.0;
    return {extent.lower - half, extent.upper + half};
  }
  return {extent.lower - margin * span, extent.upper + margin * span};
}

void require_range(const std::optional<Range>& range, bool logarithmic, const std::string& where) {
  if (!range) return;
  const bool valid = drawable(range->lower) && drawable(range->upper) &&
                     range->lower < range->upper && (!logarithmic || range->lower > 0.0);
  if (!valid) {
    throw std::invalid_argument(where + ": the range from " + std::to_string(range->lower) +
                                " to " + std::to_string(range->upper) + " cannot be shown");
  }
}

void require_extension(const std::filesystem::path& file, std::string_view first,
                       std::string_view second = "") {
  const std::string extension = file.extension().string();
  if (extension == first || (!second.empty() && extension == second)) return;
  throw std::invalid_argument("pictures: cannot write " + file.string() + ", expected " +
                              std::string(first) +
                              (second.empty() ? "" : " or " + std::string(second)));
}

// ---- curves -------------------------------------------------------------------------------------

constexpr double label_font = 11.0;
constexpr double tick_font = 10.0;
constexpr double legend_font = 9.5;
constexpr double line_width = 1.5;

struct Point {
  double x = 0.0;
  double y = 0.0;
};

struct Box {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  bool holds(const Point& p, double margin = 0.0) const {
    return p.x >= left - margin && p.x <= left + width + margin && p.y >= top - margin &&
           p.y <= top + height + margin;
  }
};

// A curve with the appearance and the place it has in its panel.
struct PlacedCurve {
  const Curve* curve = nullptr;
  Colour colour{};
  Line line = Line::solid;
  std::vector<Point> points{};
};

void set_dashes(cairo_t* cr, Line line) {
  constexpr std::array<double, 2> dashed{5.5, 3.0};
  constexpr std::array<double, 2> dotted{0.1, 3.0};
  cairo_set_line_cap(cr, line == Line::dotted ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  if (line == Line::dashed) {
    cairo_set_dash(cr, dashed.data(), 2, 0.0);
  } else if (line == Line::dotted) {
    cairo_set_dash(cr, dotted.data(), 2, 0.0);
  } else {
    cairo_set_dash(cr, nullptr, 0, 0.0);
  }
}

void draw_polyline(cairo_t* cr, const PlacedCurve& placed) {
  if (placed.line == Line::none) return;
  bool pen_down = false;
  Point last{};
  Point skipped{};
  bool has_skipped = false;
  const auto finish = [&] {
    if (has_skipped) cairo_line_to(cr, skipped.x, skipped.y);
    has_skipped = false;
  };
  for (const Point& p : placed.points) {
    if (std::isnan(p.x) || std::isnan(p.y)) {
      finish();
      pen_down = false;
    } else if (!pen_down) {
      cairo_move_to(cr, p.x, p.y);
      pen_down = true;
      last = p;
    } else if (std::hypot(p.x - last.x, p.y - last.y) < 0.2) {
      // Millions of samples would make SVG files nobody can open and change nothing on paper.
      skipped = p;
      has_skipped = true;
    } else {
      finish();
      cairo_line_to(cr, p.x, p.y);
      last = p;
    }
  }
  finish();
  set_dashes(cr, placed.line);
  cairo_set_line_width(cr, line_width);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  set_colour(cr, placed.colour);
  cairo_stroke(cr);
  set_dashes(cr, Line::solid);
}

void draw_marker(cairo_t* cr, const PlacedCurve& placed, const Point& p) {
  const double r = 2.9;
  cairo_new_path(cr);
  switch (placed.curve->style.marker) {
    case Marker::none:
      return;
    case Marker::dot:
      cairo_arc(cr, p.x, p.y, 0.9, 0.0, 2.0 * std::numbers::pi);
      break;
    case Marker::circle:
      cairo_arc(cr, p.x, p.y, r, 0.0, 2.0 * std::numbers::pi);
      break;
    case Marker::square:
      cairo_rectangle(cr, p.x - 0.9 * r, p.y - 0.9 * r, 1.8 * r, 1.8 * r);
      break;
    case Marker::triangle:
      cairo_move_to(cr, p.x, p.y - 1.25 * r);
      cairo_line_to(cr, p.x + 1.15 * r, p.y + 0.8 * r);
      cairo_line_to(cr, p.x - 1.15 * r, p.y + 0.8 * r);
      cairo_close_path(cr);
      break;
    case Marker::diamond:
      cairo_move_to(cr, p.x, p.y - 1.3 * r);
      cairo_line_to(cr, p.x + 1.3 * r, p.y);
      cairo_line_to(cr, p.x, p.y + 1.3 * r);
      cairo_line_to(cr, p.x - 1.3 * r, p.y);
      cairo_close_path(cr);
      break;
    case Marker::cross:
      draw_line(cr, p.x - r, p.y - r, p.x + r, p.y + r);
      draw_line(cr, p.x - r, p.y + r, p.x + r, p.y - r);
      cairo_set_line_width(cr, line_width);
      set_colour(cr, placed.colour);
      cairo_stroke(cr);
      return;
  }
  const bool open = placed.curve->reference && placed.curve->style.marker != Marker::dot;
  set_colour(cr, open ? white : placed.colour);
  if (!open) {
    cairo_fill(cr);
    return;
  }
  cairo_fill_preserve(cr);
  set_colour(cr, placed.colour);
  cairo_set_line_width(cr, 1.1);
  cairo_stroke(cr);
}

void draw_curve(cairo_t* cr, const PlacedCurve& placed, const Box& plot) {
  cairo_save(cr);
  cairo_rectangle(cr, plot.left, plot.top, plot.width, plot.height);
  cairo_clip(cr);
  draw_polyline(cr, placed);
  cairo_restore(cr);
  if (placed.curve->style.marker == Marker::none) return;
  const auto every = static_cast<std::size_t>(std::max(placed.curve->style.marker_every, 1));
  for (std::size_t i = 0; i < placed.points.size(); i += every) {
    if (plot.holds(placed.points[i], 0.5)) draw_marker(cr, placed, placed.points[i]);
  }
}

// Points about 3 units apart along everything that is drawn: what a legend could hide.
std::vector<Point> ink_samples(std::span<const PlacedCurve> curves, const Box& plot) {
  std::vector<Point> samples;
  const auto add = [&](const Point& p) {
    if (plot.holds(p)) samples.push_back(p);
  };
  for (const PlacedCurve& placed : curves) {
    Point last{nan, nan};
    double since = 0.0;
    for (const Point& p : placed.points) {
      const double length = std::hypot(p.x - last.x, p.y - last.y);
      if (placed.curve->style.marker != Marker::none || std::isnan(length)) {
        add(p);
      }
      if (placed.line != Line::none && length > 0.0) {
        since += length;
        const int pieces = static_cast<int>(std::min(since / 3.0, 1000.0));
        for (int i = 1; i <= pieces; ++i) {
          const double f = static_cast<double>(i) / pieces;
          add({last.x + f * (p.x - last.x), last.y + f * (p.y - last.y)});
        }
        if (pieces > 0) since = 0.0;
      }
      last = p;
    }
  }
  return samples;
}

struct LegendSize {
  double width = 0.0;
  double height = 0.0;
};

constexpr double legend_row = 1.45 * legend_font;
constexpr double legend_pad = 5.0;
constexpr double legend_sample = 26.0;

LegendSize legend_size(cairo_t* cr, std::span<const PlacedCurve> curves) {
  LegendSize size;
  for (const PlacedCurve& placed : curves) {
    if (placed.curve->label.empty()) continue;
    size.width = std::max(size.width, text_width(cr, placed.curve->label, legend_font));
    size.height += legend_row;
  }
  if (size.height > 0.0) {
    size.width += legend_sample + 6.0 + 2.0 * legend_pad;
    size.height += 2.0 * legend_pad - 0.3 * legend_font;
  }
  return size;
}

struct LegendPlace {
  Box box{};
  std::size_t hidden = 0;  // samples of curves behind it
};

LegendPlace place_legend(const LegendSize& size, const Box& plot, std::span<const Point> samples) {
  const double gap = 7.0;
  LegendPlace best;
  double best_cost = std::numeric_limits<double>::infinity();
  constexpr int steps = 8;
  for (int row = 0; row <= steps; ++row) {
    for (int column = steps; column >= 0; --column) {
      const Box box{
          .left = plot.left + gap + (plot.width - size.width - 2.0 * gap) * column / steps,
          .top = plot.top + gap + (plot.height - size.height - 2.0 * gap) * row / steps,
          .width = size.width,
          .height = size.height};
      std::size_t hidden = 0;
      std::size_t close = 0;
      for (const Point& p : samples) {
        if (box.holds(p))
          ++hidden;
        else if (box.holds(p, 5.0))
          ++close;
      }
      // Equally good places: a corner rather than an edge, an edge rather than the middle.
      const int off_edges = (row % steps != 0 ? 1 : 0) + (column % steps != 0 ? 1 : 0);
      const double cost = static_cast<double>(hidden) + 0.3 * static_cast<double>(close) +
                          3.0 * off_edges + (row == steps ? 0.5 : 0.0);
      if (cost < best_cost) {
        best_cost = cost;
        best = {.box = box, .hidden = hidden};
      }
    }
  }
  return best;
}

void draw_legend(cairo_t* cr, const Box& box, std::span<const PlacedCurve> curves) {
  cairo_rectangle(cr, box.left, box.top, box.width, box.height);
  cairo_set_source_rgba(cr, 1.0, 1.0, 1.0, 0.85);
  cairo_fill_preserve(cr);
  cairo_set_line_width(cr, 0.6);
  set_colour(cr, {.red = 0.75, .green = 0.75, .blue = 0.75});
  cairo_stroke(cr);
  double y = box.top + legend_pad + 0.5 * (legend_row - 0.3 * legend_font);
  for (const PlacedCurve& placed : curves) {
    if (placed.curve->label.empty()) continue;
    const double x = box.left + legend_pad;
    PlacedCurve sample = placed;
    sample.points = {{x, y}, {x + legend_sample, y}};
    draw_polyline(cr, sample);
    draw_marker(cr, sample, {x + 0.5 * legend_sample, y});
    draw_text(cr, placed.curve->label, x + legend_sample + 6.0, y, legend_font,
              {.across = 0.0, .down = 0.5});
    y += legend_row;
  }
}

struct PanelRanges {
  Range x{};
  Range y{};
};

PanelRanges panel_ranges(const Panel& panel) {
  const auto shown = [](double value, bool logarithmic) {
    return drawable(value) && (!logarithmic || value > 0.0);
  };
  Extent x;
  Extent y;
  bool markers = false;
  for (const Curve& curve : panel.curves) {
    markers = markers || (curve.style.marker != Marker::none && curve.style.marker != Marker::dot);
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!shown(curve.x[i], panel.log_x) || !shown(curve.y[i], panel.log_y)) continue;
      if (panel.x_range &&
          (curve.x[i] < panel.x_range->lower || curve.x[i] > panel.x_range->upper)) {
        continue;
      }
      x.include(curve.x[i]);
      y.include(curve.y[i]);
    }
  }
  const double x_margin = panel.log_x ? 0.06 : markers ? 0.03 : 0.0;
  return {.x = panel.x_range ? *panel.x_range : visible_range(x, panel.log_x, x_margin),
          .y = panel.y_range ? *panel.y_range : visible_range(y, panel.log_y, 0.06)};
}

// Everything of a panel that is known before its place in the figure.
struct PanelLayout {
  PanelRanges ranges{};
  Ticks y_ticks{};
  double left_margin = 0.0;
};

constexpr double panel_top = 30.0;
constexpr double panel_bottom = 39.0;
constexpr double panel_right = 16.0;

Ticks vertical_ticks(const Range& range, bool logarithmic, double length, double font) {
  return axis_ticks(range, logarithmic, std::clamp(length / (3.4 * font), 2.0, 10.0));
}

PanelLayout layout_panel(cairo_t* cr, const Panel& panel, const FigureSize& size) {
  PanelLayout layout{.ranges = panel_ranges(panel)};
  layout.y_ticks = vertical_ticks(layout.ranges.y, panel.log_y,
                                  size.panel_height - panel_top - panel_bottom, tick_font);
  layout.left_margin = widest_label(cr, layout.y_ticks, tick_font) + 0.5 * tick_font + 8.0 +
                       (panel.y_label.empty() ? 0.0 : 1.6 * label_font);
  return layout;
}

std::vector<PlacedCurve> place_curves(const Panel& panel, const Axis& x_axis, const Axis& y_axis) {
  std::vector<PlacedCurve> curves;
  int next_colour = 0;
  for (const Curve& curve : panel.curves) {
    PlacedCurve placed{.curve = &curve, .line = curve.style.line};
    if (curve.reference) {
      placed.colour = black;
      if (placed.line == Line::solid) placed.line = Line::dashed;
    } else {
      placed.colour = palette_colour(curve.style.colour.value_or(next_colour));
      ++next_colour;
    }
    placed.points.reserve(curve.x.size());
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      placed.points.push_back({x_axis.place(curve.x[i]), y_axis.place(curve.y[i])});
    }
    curves.push_back(std::move(placed));
  }
  return curves;
}

void draw_grid(cairo_t* cr, const Box& plot, const Axis& x_axis, const Ticks& x_ticks,
               const Axis& y_axis, const Ticks& y_ticks) {
  for (const double value : x_ticks.major) {
    draw_line(cr, x_axis.at(value), plot.top, x_axis.at(value), plot.top + plot.height);
  }
  for (const double value : y_ticks.major) {
    draw_line(cr, plot.left, y_axis.at(value), plot.left + plot.width, y_axis.at(value));
  }
  set_colour(cr, grid_grey);
  cairo_set_line_width(cr, 0.6);
  cairo_stroke(cr);
}

void draw_panel(cairo_t* cr, const Panel& panel, const PanelLayout& layout, const Box& cell,
                double left_margin) {
  const Box plot{.left = cell.left + left_margin,
                 .top = cell.top + panel_top,
                 .width = cell.width - left_margin - panel_right,
                 .height = cell.height - panel_top - panel_bottom};
  const double right = plot.left + plot.width;
  const double bottom = plot.top + plot.height;
  const Axis x_axis{layout.ranges.x, panel.log_x, plot.left, right};
  Axis y_axis{layout.ranges.y, panel.log_y, bottom, plot.top};
  Ticks y_ticks = layout.y_ticks;
  const Ticks x_ticks = horizontal_ticks(cr, x_axis.range, panel.log_x, plot.width, tick_font);

  std::vector<PlacedCurve> curves = place_curves(panel, x_axis, y_axis);
  const LegendSize size = legend_size(cr, curves);
  LegendPlace legend = place_legend(size, plot, ink_samples(curves, plot));
  // No free place: make one above the curves, as long as they keep most of the height.
  if (size.height > 0.0 && legend.hidden > 8 && !panel.y_range && !panel.log_y &&
      size.height < 0.3 * plot.height) {
    const double share = (size.height + 8.0) / plot.height;
    y_axis.range.upper += (y_axis.range.upper - y_axis.range.lower) * share / (1.0 - share);
    y_ticks = vertical_ticks(y_axis.range, false, plot.height, tick_font);
    curves = place_curves(panel, x_axis, y_axis);
    legend = place_legend(size, plot, ink_samples(curves, plot));
  }

  draw_grid(cr, plot, x_axis, x_ticks, y_axis, y_ticks);
  for (const bool reference : {true, false}) {
    for (const PlacedCurve& placed : curves) {
      if (placed.curve->reference == reference) draw_curve(cr, placed, plot);
    }
  }
  cairo_set_line_width(cr, 0.8);
  const TickStyle tick_style{.font = tick_font, .length = 4.5};
  draw_horizontal_ticks(cr, x_axis, x_ticks, bottom, tick_style);
  draw_vertical_ticks(cr, y_axis, y_ticks, plot.left, tick_style);
  cairo_rectangle(cr, plot.left, plot.top, plot.width, plot.height);
  cairo_stroke(cr);

  draw_text(cr, panel.title, plot.left + 0.5 * plot.width, plot.top - 9.0, label_font,
            {.across = 0.5, .down = 1.0, .bold = true},
            plot.width - 2.0 * text_width(cr, y_ticks.factor, tick_font));
  draw_text(cr, y_ticks.factor, plot.left, plot.top - 6.0, tick_font, {.across = 0.0, .down = 1.0});
  draw_text(cr, panel.x_label, plot.left + 0.5 * plot.width, cell.top + cell.height - 7.0,
            label_font, {.across = 0.5, .down = 1.0}, plot.width);
  draw_text(cr, x_ticks.factor, right, cell.top + cell.height - 7.0, tick_font,
            {.across = 1.0, .down = 1.0});
  draw_text(cr, panel.y_label, cell.left + 5.0 + 0.5 * label_font, plot.top + 0.5 * plot.height,
            label_font, {.across = 0.5, .down = 0.5, .upwards = true}, plot.height);
  if (size.height > 0.0) draw_legend(cr, legend.box, curves);
}

void require_panels(std::span<const Panel> panels) {
  if (panels.empty()) throw std::invalid_argument("draw_panels: no panels");
  for (const Panel& panel : panels) {
    require_range(panel.x_range, panel.log_x, "draw_panels: x axis of \"" + panel.title + "\"");
    require_range(panel.y_range, panel.log_y, "draw_panels: y axis of \"" + panel.title + "\"");
    for (const Curve& curve : panel.curves) {
      if (curve.x.size() == curve.y.size()) continue;
      throw std::invalid_argument("draw_panels: curve \"" + curve.label + "\" has " +
                                  std::to_string(curve.x.size()) + " x but " +
                                  std::to_string(curve.y.size()) + " y values");
    }
  }
}

// ---- particles ----------------------------------------------------------------------------------

constexpr std::size_t colour_steps = 1024;

std::uint32_t packed(const Colour& colour) {
  const auto byte = [](double part) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
  };
  return byte(colour.red) << 16U | byte(colour.green) << 8U | byte(colour.blue);
}

struct View {
  Range x{};
  Range y{};
  int width = 0;   // pixels
  int height = 0;  // pixels
};

// First and one past the last of `count` pixels whose centres lie within `radius` of `centre` (in
// pixels), at least the pixel that holds the centre. A hair more than that, so that round-off opens
// no gap between neighbours that just touch.
std::pair<int, int> covered_pixels(double centre, double radius, int count) {
  constexpr double hair = 0.01;
  double first = std::ceil(centre - radius - 0.5 - hair);
  double end = std::ceil(centre + radius - 0.5 + hair);
  if (end <= first) {
    first = std::floor(centre);
    end = first + 1.0;
  }
  const double limit = count;
  return {static_cast<int>(std::clamp(first, 0.0, limit)),
          static_cast<int>(std::clamp(end, 0.0, limit))};
}

class Raster {
 public:
  Raster(int width, int height, const Colour& background)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                packed(background)),
        distances_(pixels_.size(), std::numeric_limits<float>::infinity()) {}

  // Centre and radius in pixels, y downwards. A pixel belongs to the nearest particle that covers
  // it, so that the picture does not depend on the order of the particles.
  void paint(double x, double y, double radius, bool disc, std::uint32_t colour) {
    const auto [i0, i1] = covered_pixels(x, radius, width_);
    const auto [j0, j1] = covered_pixels(y, radius, height_);
    const double reach = disc ? radius * radius : std::numeric_limits<double>::infinity();
    for (int j = j0; j < j1; ++j) {
      const double dy = j + 0.5 - y;
      const std::size_t row = static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
      for (int i = i0; i < i1; ++i) {
        const double dx = i + 0.5 - x;
        const double squared = dx * dx + dy * dy;
        const std::size_t at = row + static_cast<std::size_t>(i);
        if (squared > reach || squared >= static_cast<double>(distances_[at])) continue;
        distances_[at] = static_cast<float>(squared);
        pixels_[at] = colour;
      }
    }
  }

  // Means of blocks of `factor` x `factor` pixels, which makes the edges of discs smooth.
  Surface surface(int factor) const {
    Surface image(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_ / factor, height_ / factor));
    if (cairo_surface_status(image.get()) != CAIRO_STATUS_SUCCESS) return image;
    cairo_surface_flush(image.get());
    unsigned char* const data = cairo_image_surface_get_data(image.get());
    const int stride = cairo_image_surface_get_stride(image.get());
    for (int j = 0; j < height_ / factor; ++j) {
      auto* const row = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t{j} * stride);
      for (int i = 0; i < width_ / factor; ++i) row[i] = mean(i, j, factor);
    }
    cairo_surface_mark_dirty(image.get());
    return image;
  }

 private:
  std::uint32_t mean(int i, int j, int factor) const {
    std::uint32_t red = 0;
    std::uint32_t green = 0;
    std::uint32_t blue = 0;
    for (int b = j * factor; b < (j + 1) * factor; ++b) {
      for (int a = i * factor; a < (i + 1) * factor; ++a) {
        const std::uint32_t pixel =
            pixels_[static_cast<std::size_t>(b) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(a)];
        red += pixel >> 16U & 0xFFU;
        green += pixel >> 8U & 0xFFU;
        blue += pixel & 0xFFU;
      }
    }
    const auto count = static_cast<std::uint32_t>(factor * factor);
    const auto rounded = [count](std::uint32_t sum) { return (sum + count / 2) / count; };
    return rounded(red) << 16U | rounded(green) << 8U | rounded(blue);
  }

  int width_;
  int height_;
  std::vector<std::uint32_t> pixels_;
  std::vector<float> distances_;
};

Surface particle_image(const ParticleField& field, const View& view, const Range& values,
                       const Colour& background) {
  const double pixel = (view.x.upper - view.x.lower) / view.width;
  // Discs only where they are seen as such: small squares leave no gaps in a regular arrangement.
  const bool discs = field.diameter >= 6.0 * pixel;
  const int factor = discs ? 3 : 1;
  const double scale = factor / pixel;
  const double radius = 0.5 * field.diameter * scale;

  std::array<std::uint32_t, colour_steps> colours{};
  for (std::size_t i = 0; i < colour_steps; ++i) {
    colours[i] = packed(viridis(static_cast<double>(i) / (colour_steps - 1)));
  }

  Raster raster(view.width * factor, view.height * factor, background);
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    if (!drawable(field.x[i]) || !drawable(field.y[i])) continue;
    const double x = (field.x[i] - view.x.lower) * scale;
    const double y = view.height * factor - (field.y[i] - view.y.lower) * scale;
    std::uint32_t colour = packed(missing_grey);
    if (drawable(field.value[i])) {
      const double fraction =
          std::clamp((field.value[i] - values.lower) / (values.upper - values.lower), 0.0, 1.0);
      colour = colours[static_cast<std::size_t>(std::lround(fraction * (colour_steps - 1)))];
    }
    raster.paint(x, y, radius, discs, colour);
  }
  return raster.surface(factor);
}

void require_tiles(std::span<const MosaicTile> tiles, int columns, const ImageOptions& options) {
  if (tiles.empty()) throw std::invalid_argument("draw_particle_mosaic: no tiles");
  if (columns < 1) throw std::invalid_argument("draw_particle_mosaic: columns must be at least 1");
  require_range(options.value_range, false, "draw_particles: values");
  require_range(options.x_range, false, "draw_particles: x");
  require_range(options.y_range, false, "draw_particles: y");
  for (const MosaicTile& tile : tiles) {
    const ParticleField& field = tile.field;
    if (field.x.size() != field.y.size() || field.x.size() != field.value.size()) {
      throw std::invalid_argument("draw_particles: " + std::to_string(field.x.size()) + " x, " +
                                  std::to_string(field.y.size()) + " y, " +
                                  std::to_string(field.value.size()) + " values");
    }
    if (!std::isfinite(field.diameter) || field.diameter <= 0.0) {
      throw std::invalid_argument("draw_particles: the diameter must be positive");
    }
  }
}

struct MosaicRanges {
  Range x{};
  Range y{};
  Range value{};
  bool below = false;  // there are values below the range
  bool above = false;
};

MosaicRanges mosaic_ranges(std::span<const MosaicTile> tiles, const ImageOptions& options) {
  Extent x;
  Extent y;
  Extent value;
  for (const MosaicTile& tile : tiles) {
    const double radius = 0.5 * tile.field.diameter;
    for (std::size_t i = 0; i < tile.field.x.size(); ++i) {
      const double xi = tile.field.x[i];
      const double yi = tile.field.y[i];
      if (!drawable(xi) || !drawable(yi)) continue;
      x.include(xi - radius);
      x.include(xi + radius);
      y.include(yi - radius);
      y.include(yi + radius);
      const bool shown =
          (!options.x_range || (xi >= options.x_range->lower && xi <= options.x_range->upper)) &&
          (!options.y_range || (yi >= options.y_range->lower && yi <= options.y_range->upper));
      if (shown && drawable(tile.field.value[i])) value.include(tile.field.value[i]);
    }
  }
  if ((!options.x_range || !options.y_range) && x.empty()) {
    throw std::invalid_argument("draw_particles: no particles and no box to show");
  }
  MosaicRanges ranges{.x = options.x_range.value_or(Range{x.lower, x.upper}),
                      .y = options.y_range.value_or(Range{y.lower, y.upper}),
                      .value = options.value_range.value_or(visible_range(value, false, 0.0))};
  ranges.below = value.lower < ranges.value.lower;
  ranges.above = value.upper > ranges.value.upper;
  return ranges;
}

// Places of everything in a mosaic [pixels].
struct MosaicLayout {
  double unit = 1.0;  // scale of fonts and line widths
  int rows = 1;
  int columns = 1;
  bool bar_below = false;
  double left = 0.0;
  double top = 0.0;
  double gap_x = 0.0;
  double gap_y = 0.0;
  int tile_width = 0;
  int tile_height = 0;
  int height = 0;
  Ticks x_ticks{};
  Ticks y_ticks{};
  Ticks bar_ticks{};

  double tick_size() const { return 14.0 * unit; }
  double label_size() const { return 15.5 * unit; }
  double grid_width() const { return columns * tile_width + (columns - 1) * gap_x; }
  double grid_height() const { return rows * tile_height + (rows - 1) * gap_y; }
  Box tile(std::size_t index) const {
    const auto count = static_cast<std::size_t>(columns);
    const std::size_t row_index = index / count;
    const auto column = static_cast<double>(index % count);
    const auto row = static_cast<double>(row_index);
    return {.left = left + column * (tile_width + gap_x),
            .top = top + row * (tile_height + gap_y),
            .width = static_cast<double>(tile_width),
            .height = static_cast<double>(tile_height)};
  }
};

MosaicLayout layout_mosaic(cairo_t* cr, std::span<const MosaicTile> tiles, int columns,
                           const ImageOptions& options, const MosaicRanges& ranges) {
  MosaicLayout layout;
  layout.unit = std::max(options.width / 1000.0, 0.8);
  layout.columns = std::min(columns, static_cast<int>(tiles.size()));
  layout.rows = (static_cast<int>(tiles.size()) + layout.columns - 1) / layout.columns;
  const double u = layout.unit;
  const bool tile_titles = std::any_of(tiles.begin(), tiles.end(),
                                       [](const MosaicTile& tile) { return !tile.title.empty(); });
  const double aspect = (ranges.y.upper - ranges.y.lower) / (ranges.x.upper - ranges.x.lower);
  const double rough_width = 0.85 * options.width / layout.columns;
  layout.bar_below = layout.rows * rough_width * aspect < 0.4 * options.width;

  layout.y_ticks = vertical_ticks(ranges.y, false, rough_width * aspect, layout.tick_size());
  layout.left = 12.0 * u + 1.7 * layout.label_size() +
                widest_label(cr, layout.y_ticks, layout.tick_size()) + 12.0 * u;
  // The labels at the ends of neighbouring axes stand side by side.
  const Ticks rough_ticks = horizontal_ticks(cr, ranges.x, false, rough_width, layout.tick_size());
  layout.gap_x = std::max(16.0 * u, widest_label(cr, rough_ticks, layout.tick_size()) + 10.0 * u);
  layout.gap_y = (tile_titles ? 32.0 : 16.0) * u;
  layout.top = (options.title.empty() ? 12.0 : 46.0) * u + (tile_titles ? 24.0 * u : 0.0);

  double right = 24.0 * u;
  if (!layout.bar_below) {
    layout.bar_ticks =
        vertical_ticks(ranges.value, false, layout.rows * rough_width * aspect, layout.tick_size());
    right = 18.0 * u + 20.0 * u + 12.0 * u +
            widest_label(cr, layout.bar_ticks, layout.tick_size()) + 10.0 * u +
            1.5 * layout.label_size() + 4.0 * u;
  }
  layout.tile_width = static_cast<int>(
      (options.width - layout.left - right - (layout.columns - 1) * layout.gap_x) / layout.columns);
  const double tile_height = std::round(layout.tile_width * aspect);
  if (layout.tile_width < 16 || tile_height < 1.0 || layout.rows * tile_height > 16000.0) {
    throw std::invalid_argument("draw_particles: a picture " + std::to_string(options.width) +
                                " pixels wide cannot show this box");
  }
  layout.tile_height = static_cast<int>(tile_height);
  layout.x_ticks = horizontal_ticks(cr, ranges.x, false, layout.tile_width, layout.tick_size());
  if (layout.bar_below) {
    layout.bar_ticks =
        horizontal_ticks(cr, ranges.value, false, 0.7 * layout.grid_width(), layout.tick_size());
  }
  const double below_tiles = 62.0 * u + (layout.bar_below ? 84.0 * u : 0.0);
  layout.height = static_cast<int>(std::ceil(layout.top + layout.grid_height() + below_tiles));
  return layout;
}

// The bar runs along `axis` and is `thickness` wide from `side` on; arrows stand for values beyond.
void draw_colour_bar(cairo_t* cr, const Axis& axis, bool vertical, double side, double thickness,
                     const MosaicRanges& ranges) {
  const auto move_or_line = [&](double along, double across, bool first) {
    const double x = vertical ? across : along;
    const double y = vertical ? along : across;
    if (first)
      cairo_move_to(cr, x, y);
    else
      cairo_line_to(cr, x, y);
  };
  const double direction = axis.to > axis.from ? 1.0 : -1.0;
  const double tip = 0.8 * thickness * direction;
  move_or_line(axis.from, side, true);
  if (ranges.below) move_or_line(axis.from - tip, side + 0.5 * thickness, false);
  move_or_line(axis.from, side + thickness, false);
  move_or_line(axis.to, side + thickness, false);
  if (ranges.above) move_or_line(axis.to + tip, side + 0.5 * thickness, false);
  move_or_line(axis.to, side, false);
  cairo_close_path(cr);

  const Pattern gradient(vertical ? cairo_pattern_create_linear(0.0, axis.from, 0.0, axis.to)
                                  : cairo_pattern_create_linear(axis.from, 0.0, axis.to, 0.0));
  constexpr int stops = 64;
  for (int i = 0; i <= stops; ++i) {
    const double fraction = static_cast<double>(i) / stops;
    const Colour colour = viridis(fraction);
    cairo_pattern_add_color_stop_rgb(gradient.get(), fraction, colour.red, colour.green,
                                     colour.blue);
  }
  cairo_set_source(cr, gradient.get());
  cairo_fill_preserve(cr);
  set_colour(cr, black);
  cairo_stroke(cr);
}

void draw_bar(cairo_t* cr, const MosaicLayout& layout, const ImageOptions& options,
              const MosaicRanges& ranges) {
  const double u = layout.unit;
  const double thickness = 20.0 * u;
  const TickStyle style{.font = layout.tick_size(), .length = -6.0 * u};
  const double right = layout.left + layout.grid_width();
  const double bottom = layout.top + layout.grid_height();
  if (layout.bar_below) {
    const double inset = 0.15 * layout.grid_width();
    const Axis axis{ranges.value, false, layout.left + inset, right - inset};
    const double top = bottom + 66.0 * u;
    draw_colour_bar(cr, axis, false, top, thickness, ranges);
    draw_horizontal_ticks(cr, axis, layout.bar_ticks, top + thickness, style);
    const std::string label =
        options.bar_label +
        (layout.bar_ticks.factor.empty() ? "" : "  (" + layout.bar_ticks.factor + ")");
    draw_text(cr, label, 0.5 * (axis.from + axis.to), layout.height - 10.0 * u, layout.label_size(),
              {.across = 0.5, .down = 1.0}, layout.grid_width());
    return;
  }
  const double tip = 0.8 * thickness;
  const double lower_end = bottom - (ranges.below ? tip : 0.0);
  const double upper_end = layout.top + (ranges.above ? tip : 0.0);
  const Axis axis{ranges.value, false, lower_end, upper_end};
  const double side = right + 18.0 * u;
  draw_colour_bar(cr, axis, true, side, thickness, ranges);
  draw_vertical_ticks(cr, axis, layout.bar_ticks, side + thickness, style, true);
  draw_text(cr, layout.bar_ticks.factor, side, layout.top - 9.0 * u, layout.tick_size(),
            {.across = 0.0, .down = 1.0});
  draw_text(cr, options.bar_label, options.width - 8.0 * u - 0.5 * layout.label_size(),
            0.5 * (bottom + layout.top), layout.label_size(),
            {.across = 0.5, .down = 0.5, .upwards = true}, layout.grid_height());
}

void draw_tile(cairo_t* cr, const MosaicLayout& layout, const Box& box, const std::string& title,
               bool first_column, bool last_row, const MosaicRanges& ranges) {
  const double u = layout.unit;
  const double right = box.left + box.width;
  const double bottom = box.top + box.height;
  const Axis x_axis{ranges.x, false, box.left, right};
  const Axis y_axis{ranges.y, false, bottom, box.top};
  TickStyle style{.font = layout.tick_size(), .length = -6.0 * u};
  style.labels = last_row;
  draw_horizontal_ticks(cr, x_axis, layout.x_ticks, bottom, style);
  style.labels = first_column;
  draw_vertical_ticks(cr, y_axis, layout.y_ticks, box.left, style);
  cairo_rectangle(cr, box.left, box.top, box.width, box.height);
  cairo_stroke(cr);
  draw_text(cr, title, box.left + 0.5 * box.width, box.top - 8.0 * u, layout.label_size(),
            {.across = 0.5, .down = 1.0}, box.width);
  const auto label = [](const char* name, const Ticks& ticks) {
    return std::string(name) + " [" + (ticks.factor.empty() ? "" : ticks.factor + " ") + "m]";
  };
  if (last_row) {
    draw_text(cr, label("x", layout.x_ticks), box.left + 0.5 * box.width, bottom + 52.0 * u,
              layout.label_size(), {.across = 0.5, .down = 1.0});
  }
  if (first_column) {
    draw_text(cr, label("y", layout.y_ticks), 10.0 * u + 0.5 * layout.label_size(),
              box.top + 0.5 * box.height, layout.label_size(),
              {.across = 0.5, .down = 0.5, .upwards = true});
  }
}

}  // namespace

Colour palette_colour(int index) {
  constexpr std::array<Colour, 6> colours{Colour{0.000, 0.447, 0.698}, Colour{0.835, 0.369, 0.000},
                                          Colour{0.000, 0.620, 0.451}, Colour{0.800, 0.475, 0.655},
                                          Colour{0.902, 0.624, 0.000}, Colour{0.337, 0.706, 0.914}};
  const int count = static_cast<int>(colours.size());
  return colours[static_cast<std::size_t>((index % count + count) % count)];
}

Colour viridis(double fraction) {
  // Polynomial fitted by M. Zucker (CC0) to the table of matplotlib.
  constexpr std::array<std::array<double, 3>, 7> coefficients{
      {{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
       {0.1050930431085774, 1.404613529898575, 1.384590162594685},
       {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
       {-4.634230498983486, -5.799100973351585, -19.33244095627987},
       {6.228269936347081, 14.17993336680509, 56.69055260068105},
       {4.776384997670288, -13.74514537774601, -65.35303263337234},
       {-5.435455855934631, 4.645852612178535, 26.3124352495832}}};
  const double t = std::clamp(fraction, 0.0, 1.0);
  const auto channel = [&](std::size_t c) {
    double value = 0.0;
    for (std::size_t i = coefficients.size(); i-- > 0;) value = value * t + coefficients[i][c];
    return std::clamp(value, 0.0, 1.0);
  };
  return {.red = channel(0), .green = channel(1), .blue = channel(2)};
}

void draw_panels(const std::filesystem::path& file, const std::string& title,
                 std::span<const Panel> panels, int columns, const FigureSize& size) {
  require_extension(file, ".svg", ".png");
  require_panels(panels);
  if (columns < 1) throw std::invalid_argument("draw_panels: columns must be at least 1");
  const auto column_count = std::min(static_cast<std::size_t>(columns), panels.size());
  const std::size_t row_count = (panels.size() + column_count - 1) / column_count;
  const double title_height = title.empty() ? 0.0 : 26.0;
  const double width = static_cast<double>(column_count) * size.panel_width;
  const double height = static_cast<double>(row_count) * size.panel_height + title_height;

  const bool svg = file.extension() == ".svg";
  std::string bytes;
  const Surface surface(
      svg ? cairo_svg_surface_create_for_stream(append_bytes, &bytes, width, height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                       static_cast<int>(std::ceil(width * size.png_scale)),
                                       static_cast<int>(std::ceil(height * size.png_scale))));
  const Context context = make_context(surface.get());
  cairo_t* const cr = context.get();
  if (!svg) cairo_scale(cr, size.png_scale, size.png_scale);
  set_colour(cr, white);
  cairo_paint(cr);
  draw_text(cr, title, 0.5 * width, 19.0, 14.0, {.across = 0.5, .down = 1.0, .bold = true},
            width - 20.0);

  std::vector<PanelLayout> layouts;
  std::vector<double> left_margins(column_count, 0.0);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    layouts.push_back(layout_panel(cr, panels[i], size));
    double& margin = left_margins[i % column_count];
    margin = std::max(margin, layouts[i].left_margin);
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t row = i / column_count;
    const Box cell{.left = static_cast<double>(i % column_count) * size.panel_width,
                   .top = static_cast<double>(row) * size.panel_height + title_height,
                   .width = size.panel_width,
                   .height = size.panel_height};
    draw_panel(cr, panels[i], layouts[i], cell, left_margins[i % column_count]);
  }

  require_success(cairo_status(cr), file);
  if (svg) {
    cairo_surface_finish(surface.get());
    require_success(cairo_surface_status(surface.get()), file);
    write_file(file, bytes);
  } else {
    write_png(file, surface.get());
  }
}

void draw_particles(const std::filesystem::path& file, const ParticleField& field,
                    const ImageOptions& options) {
  const MosaicTile tile{.field = field};
  draw_particle_mosaic(file, std::span(&tile, 1), 1, options);
}

void draw_particle_mosaic(const std::filesystem::path& file, std::span<const MosaicTile> tiles,
                          int columns, const ImageOptions& options) {
  require_extension(file, ".png");
  require_tiles(tiles, columns, options);
  const MosaicRanges ranges = mosaic_ranges(tiles, options);

  // Text is measured before the height of the picture is known.
  const Surface ruler(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1));
  const MosaicLayout layout =
      layout_mosaic(make_context(ruler.get()).get(), tiles, columns, options, ranges);

  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, options.width, layout.height));
  const Context context = make_context(surface.get());
  cairo_t* const cr = context.get();
  set_colour(cr, white);
  cairo_paint(cr);
  cairo_set_line_width(cr, layout.unit);
  draw_text(cr, options.title, layout.left + 0.5 * layout.grid_width(), 28.0 * layout.unit,
            18.0 * layout.unit, {.across = 0.5, .down = 1.0, .bold = true},
            options.width - 2.0 * layout.left / 3.0);

  for (std::size_t i = 0; i < tiles.size(); ++i) {
    Box box = layout.tile(i);
    // On whole pixels, so that the particles are copied and not resampled.
    box.left = std::round(box.left);
    box.top = std::round(box.top);
    const Surface image =
        particle_image(tiles[i].field, {ranges.x, ranges.y, layout.tile_width, layout.tile_height},
                       ranges.value, options.background);
    cairo_set_source_surface(cr, image.get(), box.left, box.top);
    cairo_paint(cr);
    const auto column_count = static_cast<std::size_t>(layout.columns);
    draw_tile(cr, layout, box, tiles[i].title, i % column_count == 0,
              i + column_count >= tiles.size(), ranges);
  }
  draw_bar(cr, layout, options, ranges);
  require_success(cairo_status(cr), file);
  write_png(file, surface.get());
}

}  // namespace sphmbs::examples
