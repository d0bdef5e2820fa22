// SPDX-License-Identifier: MIT
#include "support/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <cairo-svg.h>

#include "support/canvas.hpp"
#include "support/curves.hpp"

namespace sphmbs::examples {

using namespace canvas;

namespace {

constexpr Colour grid_grey{.red = 0.87, .green = 0.87, .blue = 0.87};
constexpr double label_font = 11.0;
constexpr double tick_font = 10.0;
constexpr double panel_top = 30.0;
constexpr double panel_bottom = 39.0;
constexpr double panel_right = 16.0;

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

}  // namespace

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

}  // namespace sphmbs::examples
