// SPDX-License-Identifier: MIT
#pragma once

// Curves at their places in a panel, and the legend that names them. Internal to the pictures.

#include <cstddef>
#include <span>
#include <vector>

#include "support/canvas.hpp"

namespace sphmbs::examples::canvas {

inline constexpr double line_width = 1.5;

/// Place in the drawing; NaN where a curve is interrupted.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// A curve with the appearance and the place it has in its panel.
struct PlacedCurve {
  const Curve* curve = nullptr;
  Colour colour{};
  Line line = Line::solid;
  std::vector<Point> points{};
};

/// Draws the line of a curve, cut at the edge of `plot`, and its whole markers inside of it.
void draw_curve(cairo_t* cr, const PlacedCurve& placed, const Box& plot);

/// Points about 3 units apart along everything that is drawn: what a legend could hide.
std::vector<Point> ink_samples(std::span<const PlacedCurve> curves, const Box& plot);

/// Size of a legend, zero without entries.
struct LegendSize {
  double width = 0.0;
  double height = 0.0;
};

/// Size of the legend of the curves that have a label.
LegendSize legend_size(cairo_t* cr, std::span<const PlacedCurve> curves);

/// Where a legend stands.
struct LegendPlace {
  Box box{};
  std::size_t hidden = 0;  // samples of curves behind it
};

/// The place in `plot` where a legend hides the fewest samples, corners first.
LegendPlace place_legend(const LegendSize& size, const Box& plot, std::span<const Point> samples);

/// Draws a legend with a piece of each labelled curve.
void draw_legend(cairo_t* cr, const Box& box, std::span<const PlacedCurve> curves);

}  // namespace sphmbs::examples::canvas
