// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sphmbs::examples {

/// Red, green and blue of sRGB, each in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

/// Values from lower to upper, in the unit of whatever is shown.
struct Range {
  double lower = 0.0;
  double upper = 1.0;
};

/// Colour of the curve `index`: six colours that differ for colour-blind readers too (Okabe and
/// Ito), then again from the first.
Colour palette_colour(int index);

/// Perceptually uniform colour map viridis, from dark violet at 0 to yellow at 1. Fractions outside
/// of [0, 1] have the colour of the nearer end.
Colour viridis(double fraction);

/// How the points of a curve are joined.
enum class Line { none, solid, dashed, dotted };

/// Symbol at the points of a curve; `dot` is small enough for all particles of a simulation.
enum class Marker { none, dot, circle, square, triangle, diamond, cross };

/// Appearance of a curve.
struct Style {
  Line line = Line::solid;
  Marker marker = Marker::none;
  /// Index for palette_colour; without it, the curves of a panel take the colours in turn.
  std::optional<int> colour{};
  /// A symbol at each point (1), at every second one (2), ...
  int marker_every = 1;
};

/// Points (x, y), joined or marked. A NaN interrupts the line, and so does a magnitude above 1e300
/// and a value that is not positive on a logarithmic axis.
struct Curve {
  /// Text in the legend; without it, the curve has no entry there.
  std::string label{};
  /// Abscissae and ordinates, as many of each.
  std::vector<double> x{};
  std::vector<double> y{};
  Style style{};
  /// Exact, published or measured data to compare with: drawn in black behind the other curves,
  /// dashed where `style` says solid, with open symbols.
  bool reference = false;
};

/// One diagram. Ranges that are not given follow from the curves.
struct Panel {
  std::string title{};
  /// Axis labels with unit, e.g. "t [s]". UTF-8.
  std::string x_label{};
  std::string y_label{};
  std::vector<Curve> curves{};
  std::optional<Range> x_range{};
  std::optional<Range> y_range{};
  bool log_x = false;
  bool log_y = false;
};

/// Size of a figure of panels.
struct FigureSize {
  /// Width and height of one panel with its labels [points of 1/72 inch].
  double panel_width = 400.0;
  double panel_height = 290.0;
  /// Pixels per point in a PNG file.
  double png_scale = 2.0;
};

/// Draws panels row by row in `columns` columns under a common title (empty: none).
///
/// @param file  .svg or .png, which selects the format
///
/// Throws std::invalid_argument for another extension, for no panel, for columns < 1, for a range
/// that is empty or not positive on a logarithmic axis, or if x and y of a curve differ in length;
/// OutputError with path and reason if the file cannot be written.
void draw_panels(const std::filesystem::path& file, const std::string& title,
                 std::span<const Panel> panels, int columns, const FigureSize& size = {});

/// Particles in the plane at one time, with the value that gives their colour. Only views: the
/// caller keeps the data. Particles with a position that is not finite are left out; a value that
/// is not finite is shown grey.
struct ParticleField {
  /// Positions [m] and values, one of each per particle.
  std::span<const double> x{};
  std::span<const double> y{};
  std::span<const double> value{};
  /// Drawn diameter [m], at least one pixel: about the particle spacing, or 1.5 times as much for a
  /// picture without gaps of an irregular arrangement. Where particles overlap, the nearest shows.
  double diameter = 0.0;
};

/// Appearance of pictures of particles.
struct ImageOptions {
  std::string title{};
  /// Label of the colour bar with unit, e.g. "pressure [Pa]". UTF-8.
  std::string bar_label{};
  /// Values at the ends of the colour bar; without it, the smallest and the largest value of all
  /// fields. Values beyond have the colour of the nearer end, and the bar then ends in an arrow.
  std::optional<Range> value_range{};
  /// Shown box [m]: without it, the smallest one that holds the particles of all fields. Particles
  /// are cut at its edge.
  std::optional<Range> x_range{};
  std::optional<Range> y_range{};
  /// Names of the axes, and whether they are drawn at all.
  std::string x_name = "x";
  std::string y_name = "y";
  bool axes = true;
  /// Width of the picture with all labels [pixels]; the height follows from the box.
  int width = 1200;
  /// Colour where there is no particle.
  Colour background{.red = 1.0, .green = 1.0, .blue = 1.0};
};

/// One picture of a mosaic with its own title, e.g. the time.
struct MosaicTile {
  ParticleField field{};
  std::string title{};
};

/// Draws particles coloured by a value, with axes in metres and a colour bar, as a PNG file.
///
/// Throws std::invalid_argument if the extension is not .png, if the lengths of a field differ, if
/// a diameter is not positive and finite, if a given range is empty, if no box can be found, or if
/// the picture would be too small for its labels or higher than 16384 pixels; OutputError with path
/// and reason if the file cannot be written.
void draw_particles(const std::filesystem::path& file, const ParticleField& field,
                    const ImageOptions& options);

/// Draws several fields row by row in `columns` columns with the same box and one colour bar.
/// Throws as draw_particles, and std::invalid_argument for no tile or columns < 1.
void draw_particle_mosaic(const std::filesystem::path& file, std::span<const MosaicTile> tiles,
                          int columns, const ImageOptions& options);

}  // namespace sphmbs::examples
