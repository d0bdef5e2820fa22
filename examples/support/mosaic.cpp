// SPDX-License-Identifier: MIT
#include "support/mosaic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sphmbs::examples {

using namespace canvas;

namespace {

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
  double below = 0.0;  // of the lowest tiles, for their axes
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

MosaicLayout layout_mosaic(cairo_t* cr, std::span<const std::string> titles, int columns,
                           const ImageOptions& options, const MosaicRanges& ranges,
                           const std::string& what) {
  MosaicLayout layout;
  layout.unit = std::max(options.width / 1000.0, 0.8);
  layout.columns = std::min(columns, static_cast<int>(titles.size()));
  layout.rows = (static_cast<int>(titles.size()) + layout.columns - 1) / layout.columns;
  const double u = layout.unit;
  const bool tile_titles = std::any_of(titles.begin(), titles.end(),
                                       [](const std::string& title) { return !title.empty(); });
  const double aspect = (ranges.y.upper - ranges.y.lower) / (ranges.x.upper - ranges.x.lower);
  const double rough_width = 0.85 * options.width / layout.columns;
  layout.bar_below = layout.rows * rough_width * aspect < 0.4 * options.width;

  layout.y_ticks = vertical_ticks(ranges.y, false, rough_width * aspect, layout.tick_size());
  layout.left = 24.0 * u;
  if (options.axes)
    layout.left += 1.7 * layout.label_size() + widest_label(cr, layout.y_ticks, layout.tick_size());
  layout.below = (options.axes ? 62.0 : 14.0) * u;
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
    throw std::invalid_argument(what + ": a picture " + std::to_string(options.width) +
                                " pixels wide cannot show this box");
  }
  layout.tile_height = static_cast<int>(tile_height);
  layout.x_ticks = horizontal_ticks(cr, ranges.x, false, layout.tile_width, layout.tick_size());
  if (layout.bar_below) {
    layout.bar_ticks =
        horizontal_ticks(cr, ranges.value, false, 0.7 * layout.grid_width(), layout.tick_size());
  }
  const double below_tiles = layout.below + (layout.bar_below ? 84.0 * u : 0.0);
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
    const double top = bottom + layout.below + 4.0 * u;
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

void draw_tile_frame(cairo_t* cr, const MosaicLayout& layout, const Box& box, bool first_column,
                     bool last_row, const ImageOptions& options, const MosaicRanges& ranges) {
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
  const auto label = [](const std::string& name, const Ticks& ticks) {
    return name + " [" + (ticks.factor.empty() ? "" : ticks.factor + " ") + "m]";
  };
  if (last_row) {
    draw_text(cr, label(options.x_name, layout.x_ticks), box.left + 0.5 * box.width,
              bottom + 52.0 * u, layout.label_size(), {.across = 0.5, .down = 1.0});
  }
  if (first_column) {
    draw_text(cr, label(options.y_name, layout.y_ticks), 10.0 * u + 0.5 * layout.label_size(),
              box.top + 0.5 * box.height, layout.label_size(),
              {.across = 0.5, .down = 0.5, .upwards = true});
  }
}

}  // namespace

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

namespace canvas {

void draw_mosaic(const std::filesystem::path& file, std::span<const std::string> titles,
                 int columns, const ImageOptions& options, const MosaicRanges& ranges,
                 const std::string& what, const PaintTile& paint) {
  // Text is measured before the height of the picture is known.
  const Surface ruler(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1));
  const MosaicLayout layout =
      layout_mosaic(make_context(ruler.get()).get(), titles, columns, options, ranges, what);

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

  for (std::size_t i = 0; i < titles.size(); ++i) {
    Box box = layout.tile(i);
    // On whole pixels, so that images are copied and not resampled.
    box.left = std::round(box.left);
    box.top = std::round(box.top);
    cairo_save(cr);
    paint(cr, i, box);
    cairo_restore(cr);
    set_colour(cr, black);
    const auto column_count = static_cast<std::size_t>(layout.columns);
    if (options.axes)
      draw_tile_frame(cr, layout, box, i % column_count == 0, i + column_count >= titles.size(),
                      options, ranges);
    draw_text(cr, titles[i], box.left + 0.5 * box.width, box.top - 8.0 * layout.unit,
              layout.label_size(), {.across = 0.5, .down = 1.0}, box.width);
  }
  draw_bar(cr, layout, options, ranges);
  require_success(cairo_status(cr), file);
  write_png(file, surface.get());
}

}  // namespace canvas

}  // namespace sphmbs::examples
