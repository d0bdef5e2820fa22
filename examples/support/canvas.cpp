// SPDX-License-Identifier: MIT
#include "support/canvas.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <ios>
#include <new>
#include <numbers>
#include <stdexcept>
#include <system_error>

#include "sphmbs/core/error.hpp"

namespace sphmbs::examples::canvas {
namespace {

constexpr double capital_height = 0.73;  // of DejaVu Sans, in font sizes

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

Ticks axis_ticks(const Range& range, bool logarithmic, double wanted) {
  return logarithmic ? log_ticks(range, wanted) : linear_ticks(range, wanted);
}

}  // namespace

bool drawable(double value) { return std::abs(value) <= 1e300; }

// ---- cairo handles and files --------------------------------------------------------------------

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

void require_extension(const std::filesystem::path& file, std::string_view first,
                       std::string_view second) {
  const std::string extension = file.extension().string();
  if (extension == first || (!second.empty() && extension == second)) return;
  throw std::invalid_argument("pictures: cannot write " + file.string() + ", expected " +
                              std::string(first) +
                              (second.empty() ? "" : " or " + std::string(second)));
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

// ---- text and lines -----------------------------------------------------------------------------

double text_width(cairo_t* cr, const std::string& text, double size, bool bold) {
  cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size,
               const TextPlace& place, double available) {
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

void draw_line(cairo_t* cr, double x0, double y0, double x1, double y1) {
  cairo_move_to(cr, x0, y0);
  cairo_line_to(cr, x1, y1);
}

// ---- ranges -------------------------------------------------------------------------------------

void Extent::include(double value) {
  lower = std::min(lower, value);
  upper = std::max(upper, value);
}

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

// ---- ticks and axes -----------------------------------------------------------------------------

double Axis::at(double value) const {
  const double fraction = logarithmic
                              ? std::log(value / range.lower) / std::log(range.upper / range.lower)
                              : (value - range.lower) / (range.upper - range.lower);
  return from + fraction * (to - from);
}

double Axis::place(double value) const {
  if (!drawable(value) || (logarithmic && value <= 0.0)) return nan;
  // Coordinates beyond cairo's 24-bit integers are brought back to its limits, far outside of any
  // picture.
  return std::clamp(at(value), -4e6, 4e6);
}

double widest_label(cairo_t* cr, const Ticks& ticks, double font) {
  double widest = 0.0;
  for (const std::string& label : ticks.labels) {
    widest = std::max(widest, text_width(cr, label, font));
  }
  return widest;
}

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

Ticks vertical_ticks(const Range& range, bool logarithmic, double length, double font) {
  return axis_ticks(range, logarithmic, std::clamp(length / (3.4 * font), 2.0, 10.0));
}

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

void draw_vertical_ticks(cairo_t* cr, const Axis& axis, const Ticks& ticks, double x,
                         const TickStyle& style, bool labels_right) {
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

}  // namespace sphmbs::examples::canvas
