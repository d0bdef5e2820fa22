// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <sphmbs/io/vtp.hpp>

#include "support/pictures.hpp"

namespace sphmbs::examples {

/// Direction from which bodies are seen, without perspective: the unit vectors that run to the
/// right and upwards in the picture.
struct View {
  std::array<double, 3> right{1.0, 0.0, 0.0};
  std::array<double, 3> up{0.0, 1.0, 0.0};

  /// Coordinates in the picture of a point in space.
  std::array<double, 2> operator()(const double* point) const;
  /// Distance towards the viewer.
  double nearness(const double* point) const;
};

/// The plane of x and y, and that of x and z seen against y.
inline constexpr View view_xy{};
inline constexpr View view_xz{.up = {0.0, 0.0, 1.0}};

/// z upwards, seen from `elevation` above the plane of x and y and from `azimuth` counter-clockwise
/// from x [degrees].
View oblique_view(double azimuth, double elevation);

/// Bodies as they are at one time, each point of the mesh with the value that gives its colour;
/// without values they are grey. Only a view: the caller keeps the mesh.
struct BodyLayer {
  const io::Mesh* mesh = nullptr;
  std::vector<double> value{};
};

/// One picture of a mosaic: its layers lie on each other, the first one below.
struct BodyTile {
  std::vector<BodyLayer> layers{};
  std::string title{};
};

/// Length of a vector at each point of a mesh, such as its "velocity [m/s]". Throws
/// std::invalid_argument if the mesh has no such array of three components.
std::vector<double> lengths_of(const io::Mesh& mesh, const std::string& array);

/// Draws lines and surfaces coloured by their values, with one box and one colour bar, as PNG file.
/// With axes, the picture is that of a plane; without, surfaces are shaded and the first picture
/// shows the directions of x, y and z.
///
/// Throws std::invalid_argument if the extension is not .png, for no tile, columns < 1, a number of
/// values that does not fit, or if no box can be found; OutputError with path and reason if the
/// file cannot be written.
void draw_bodies(const std::filesystem::path& file, std::span<const BodyTile> tiles, int columns,
                 const View& view, const ImageOptions& options);

}  // namespace sphmbs::examples
