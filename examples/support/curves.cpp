// SPDX-License-Identifier: MIT
#include "support/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sphmbs::examples::canvas {
namespace {

constexpr double legend_font = 9.5;
constexpr double legend_row = 1.45 * legend_font;
constexpr double legend_pad = 5.0;
constexpr double legend_sample = 26.0;

bool holds(const Box& box, const Point& p, double margin = 0.0) {
  return p.x >= box.left - margin && p.x <= box.left + box.width + margin &&
         p.y >= box.top - margin && p.y <= box.top + box.height + margin;
}

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

}  // namespace

void draw_curve(cairo_t* cr, const PlacedCurve& placed, const Box& plot) {
  cairo_save(cr);
  cairo_rectangle(cr, plot.left, plot.top, plot.width, plot.height);
  cairo_clip(cr);
  draw_polyline(cr, placed);
  cairo_restore(cr);
  if (placed.curve->style.marker == Marker::none) return;
  const auto every = static_cast<std::size_t>(std::max(placed.curve->style.marker_every, 1));
  for (std::size_t i = 0; i < placed.points.size(); i += every) {
    if (holds(plot, placed.points[i], 0.5)) draw_marker(cr, placed, placed.points[i]);
  }
}

std::vector<Point> ink_samples(std::span<const PlacedCurve> curves, const Box& plot) {
  std::vector<Point> samples;
  const auto add = [&](const Point& p) {
    if (holds(plot, p)) samples.push_back(p);
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
        if (holds(box, p))
          ++hidden;
        else if (holds(box, p, 5.0))
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

}  // namespace sphmbs::examples::canvas

namespace sphmbs::examples {

Colour palette_colour(int index) {
  constexpr std::array<Colour, 6> colours{Colour{0.000, 0.447, 0.698}, Colour{0.835, 0.369, 0.000},
                                          Colour{0.000, 0.620, 0.451}, Colour{0.800, 0.475, 0.655},
                                          Colour{0.902, 0.624, 0.000}, Colour{0.337, 0.706, 0.914}};
  const int count = static_cast<int>(colours.size());
  return colours[static_cast<std::size_t>((index % count + count) % count)];
}

}  // namespace sphmbs::examples
