// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/io/vtp_blocks.hpp>

namespace sphmbs::io {

/// Interleaved x, y, z coordinates [m] of positions given as a range of vectors with operator[],
/// e.g. a std::vector<std::array<double, 2>>. Components beyond `Dimension` are 0.
template <int Dimension, std::ranges::forward_range Positions>
std::vector<double> points_xyz(const Positions& positions) {
  static_assert(1 <= Dimension && Dimension <= 3);
  std::vector<double> points;
  points.reserve(3 * static_cast<std::size_t>(std::ranges::distance(positions)));
  for (const auto& position : positions) {
    points.push_back(position[0]);
    if constexpr (Dimension > 1) points.push_back(position[1]);
    if constexpr (Dimension > 2) points.push_back(position[2]);
    points.resize(points.size() + 3 - Dimension, 0.0);
  }
  return points;
}

/// Interleaved x, y, z coordinates [m] of positions in the plane, z = 0. Throws
/// std::invalid_argument if x and y differ in length.
inline std::vector<double> points_xyz(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) {
    throw std::invalid_argument("points_xyz: " + std::to_string(x.size()) + " x but " +
                                std::to_string(y.size()) + " y coordinates");
  }
  std::vector<double> points(3 * x.size(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    points[3 * i] = x[i];
    points[3 * i + 1] = y[i];
  }
  return points;
}

/// Writes particles as a VTK XML PolyData file (.vtp) for ParaView: binary, little-endian, one
/// vertex cell per particle (a single poly-vertex would make filters that select cells, such as
/// Threshold, keep or drop all particles at once), and the time as field array `TimeValue`.
///
/// @param path       file to create or replace; replaced only once complete
/// @param positions  x, y, z of each particle [m], 3 x particles values, float or double; see
///                   points_xyz
/// @param arrays     quantities of the particles; none is allowed
/// @param time       physical time [s]
///
/// Throws std::invalid_argument if a length does not fit, OutputError if writing fails.
template <std::ranges::contiguous_range Positions = std::vector<double>>
void write_vtp(const std::filesystem::path& path, const Positions& positions,
               std::span<const PointArray> arrays, double time) {
  using Coordinate = std::ranges::range_value_t<Positions>;
  const std::span<const Coordinate> positions_xyz(std::ranges::data(positions),
                                                  std::ranges::size(positions));
  const std::size_t particles = positions_xyz.size() / 3;
  // Particle i is the vertex of cell i: one array 0 ... n serves as vertices and, from its second
  // entry on, as ends of the cells.
  std::vector<std::int64_t> count(particles + 1);
  std::iota(count.begin(), count.end(), std::int64_t{0});
  const std::span<const std::int64_t> counted(count);
  const detail::VtpCells vertices{"Verts", counted.first(particles), counted.last(particles)};
  detail::write_polydata(path, positions_xyz, arrays, std::span(&vertices, 1), time, "particles");
}

/// Lines or polygons, each between points that it lists by number.
struct Cells {
  std::vector<std::int64_t> connectivity{};  ///< points of all cells, one cell after the other
  std::vector<std::int64_t> offsets{};       ///< end of each cell in `connectivity`

  /// Number of cells.
  std::size_t size() const { return offsets.size(); }
  /// Adds a cell through these points, which are counted from 0.
  void add(std::initializer_list<std::int64_t> points) {
    connectivity.insert(connectivity.end(), points);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  /// A cell of `count` points in a row, from `first` on.
  void add_row(std::int64_t first, std::int64_t count) {
    for (std::int64_t k = 0; k < count; ++k) connectivity.push_back(first + k);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("connectivity", connectivity);
    archive("offsets", offsets);
  }
};

/// Curves and surfaces, drawn as polylines and polygons, with quantities at their points.
struct Mesh {
  std::vector<double> points{};  ///< x, y, z of each point [m]
  /// Polylines.
  Cells lines{};
  /// Surfaces.
  Cells polygons{};
  /// One value or vector for each point.
  std::vector<PointArray> arrays{};

  /// Number of points.
  std::size_t size() const { return points.size() / 3; }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("points", points);
    archive("lines", lines);
    archive("polygons", polygons);
    archive("arrays", arrays);
  }
};

/// Writes a mesh as a VTK XML PolyData file, as write_vtp does particles.
///
/// Throws std::invalid_argument if a length does not fit or a cell names a point that is not there,
/// OutputError if writing fails.
inline void write_vtp(const std::filesystem::path& path, const Mesh& mesh, double time) {
  const auto points = static_cast<std::int64_t>(mesh.size());
  const auto require = [&](const Cells& cells, const std::string& name) {
    std::int64_t end = 0;
    bool good = true;
    for (const std::int64_t offset : cells.offsets)
      good = good && offset > std::exchange(end, offset);
    good = good && end == static_cast<std::int64_t>(cells.connectivity.size());
    for (const std::int64_t point : cells.connectivity) good = good && point >= 0 && point < points;
    if (!good)
      throw std::invalid_argument("write_vtp: the " + name + " do not fit to the " +
                                  std::to_string(points) + " points");
  };
  require(mesh.lines, "lines");
  require(mesh.polygons, "polygons");
  const detail::VtpCells cells[] = {{"Lines", mesh.lines.connectivity, mesh.lines.offsets},
                                    {"Polys", mesh.polygons.connectivity, mesh.polygons.offsets}};
  detail::write_polydata(path, std::span<const double>(mesh.points), mesh.arrays, cells, time,
                         "points");
}

}  // namespace sphmbs::io
