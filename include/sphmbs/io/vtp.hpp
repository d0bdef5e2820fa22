// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/io/replace_file.hpp>
#include <sphmbs/io/xml.hpp>

namespace sphmbs::io {

/// One named quantity of all particles, as written to a .vtp file.
struct PointArray {
  /// Name shown by the viewer; put the SI unit in it where there is one, e.g. "pressure [Pa]".
  std::string name{};
  /// Number of components of one particle: 1 for a scalar, 3 for a vector the viewer can draw.
  int components = 1;
  /// Values, particle after particle, components x particles of them. The element type is kept in
  /// the file: Float32, Float64, Int32 or UInt8.
  std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>,
               std::vector<std::uint8_t>>
      values{};
};

namespace detail {

/// Data of one .vtp file in the "appended raw" form: each block is its length in bytes as UInt64,
/// then its bytes. Keeps views only; the values must outlive it.
class VtpBlocks {
 public:
  explicit VtpBlocks(std::size_t capacity) { lengths_.reserve(capacity); }

  /// Appends one block and returns its XML element.
  template <class T>
  std::string add(std::string_view name, int components, std::span<const T> values) {
    const std::size_t tuples = values.size() / static_cast<std::size_t>(components);
    std::string element = "<DataArray type=\"" + std::string(vtk_type<T>()) + "\" Name=\"" +
                          xml_escaped(name) + "\" NumberOfComponents=\"" +
                          std::to_string(components) + "\" NumberOfTuples=\"" +
                          std::to_string(tuples) + "\" format=\"appended\" offset=\"" +
                          std::to_string(offset_) + "\"/>\n";
    // The chunks point into lengths_, which must therefore never move.
    if (lengths_.size() == lengths_.capacity()) throw std::logic_error("VtpBlocks is full");
    lengths_.push_back(values.size_bytes());
    chunks_.push_back(std::as_bytes(std::span(&lengths_.back(), 1)));
    chunks_.push_back(std::as_bytes(values));
    offset_ += sizeof(std::uint64_t) + values.size_bytes();
    return element;
  }

  /// Lengths and values in the order of the file.
  std::span<const std::span<const std::byte>> chunks() const { return chunks_; }

 private:
  template <class T>
  static constexpr std::string_view vtk_type() {
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
  }

  std::vector<std::uint64_t> lengths_;
  std::vector<std::span<const std::byte>> chunks_;
  std::uint64_t offset_ = 0;
};

}  // namespace detail

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
  static_assert(std::endian::native == std::endian::little, "raw data are written as they lie");
  if (positions_xyz.size() % 3 != 0) {
    throw std::invalid_argument("write_vtp: positions_xyz has " +
                                std::to_string(positions_xyz.size()) +
                                " values, expected a multiple of 3");
  }
  const std::size_t particles = positions_xyz.size() / 3;

  detail::VtpBlocks blocks(arrays.size() + 4);
  const std::string time_element = blocks.add("TimeValue", 1, std::span<const double>(&time, 1));
  std::string array_elements;
  for (const PointArray& array : arrays) {
    std::visit(
        [&](const auto& values) {
          const std::size_t expected =
              particles * static_cast<std::size_t>(std::max(array.components, 0));
          if (array.components < 1 || values.size() != expected) {
            throw std::invalid_argument("write_vtp: array \"" + array.name + "\" has " +
                                        std::to_string(values.size()) + " values, expected " +
                                        std::to_string(expected) + " (" +
                                        std::to_string(array.components) + " components of " +
                                        std::to_string(particles) + " particles)");
          }
          array_elements += blocks.add(array.name, array.components, std::span(values));
        },
        array.values);
  }

  // Particle i is the vertex of cell i: one array 0 ... n serves as vertices and, from its second
  // entry on, as ends of the cells.
  std::vector<std::int64_t> count(particles + 1);
  std::iota(count.begin(), count.end(), std::int64_t{0});
  const std::span<const std::int64_t> counted(count);

  std::string head =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
  head += time_element + "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(particles) +
          "\" NumberOfVerts=\"" + std::to_string(particles) +
          "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n" +
          array_elements + "</PointData>\n<Points>\n" + blocks.add("Points", 3, positions_xyz) +
          "</Points>\n<Verts>\n";
  head += blocks.add("connectivity", 1, counted.first(particles));
  head += blocks.add("offsets", 1, counted.last(particles));
  head += "</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  const std::string tail = "\n</AppendedData>\n</VTKFile>\n";

  std::vector<std::span<const std::byte>> chunks{std::as_bytes(std::span(head))};
  chunks.insert(chunks.end(), blocks.chunks().begin(), blocks.chunks().end());
  chunks.push_back(std::as_bytes(std::span(tail)));
  detail::replace_file(path, chunks);
}

}  // namespace sphmbs::io
