// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/io/replace_file.hpp>
#include <sphmbs/io/xml.hpp>

namespace sphmbs::io {

/// One named quantity of all points, as written to a .vtp file.
struct PointArray {
  /// Name shown by the viewer; put the SI unit in it where there is one, e.g. "pressure [Pa]".
  std::string name{};
  /// Number of components at one point: 1 for a scalar, 3 for a vector the viewer can draw.
  int components = 1;
  /// Values, point after point, components x points of them. The element type is kept in the
  /// file: Float32, Float64, Int32 or UInt8.
  std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>,
               std::vector<std::uint8_t>>
      values{};

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    std::uint64_t type = values.index();
    archive("name", name);
    archive("components", components);
    archive("type", type);
    if constexpr (A::restores) {
      if (type == 0) values = std::vector<float>();
      if (type == 1) values = std::vector<double>();
      if (type == 2) values = std::vector<std::int32_t>();
      if (type == 3) values = std::vector<std::uint8_t>();
    }
    std::visit([&](auto& numbers) { archive("values", numbers); }, values);
  }
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

/// Cells of one kind: the name of their section, the points they join one after the other, and the
/// end of each cell among these.
struct VtpCells {
  std::string_view section;  // "Verts", "Lines", "Strips" or "Polys"
  std::span<const std::int64_t> connectivity;
  std::span<const std::int64_t> offsets;
};

/// Writes a .vtp file with the cells given, at least one kind, in the order of the format. Throws
/// as write_vtp, whose name it uses in messages; `what` are its points: "particles".
template <class Coordinate>
void write_polydata(const std::filesystem::path& path, std::span<const Coordinate> points_xyz,
                    std::span<const PointArray> arrays, std::span<const VtpCells> cells,
                    double time, const std::string& what) {
  static_assert(std::endian::native == std::endian::little, "raw data are written as they lie");
  if (points_xyz.size() % 3 != 0) {
    throw std::invalid_argument("write_vtp: positions_xyz has " +
                                std::to_string(points_xyz.size()) +
                                " values, expected a multiple of 3");
  }
  const std::size_t points = points_xyz.size() / 3;

  VtpBlocks blocks(arrays.size() + 2 * cells.size() + 2);
  const std::string time_element = blocks.add("TimeValue", 1, std::span<const double>(&time, 1));
  std::string array_elements;
  for (const PointArray& array : arrays) {
    std::visit(
        [&](const auto& values) {
          const std::size_t expected =
              points * static_cast<std::size_t>(std::max(array.components, 0));
          if (array.components < 1 || values.size() != expected) {
            throw std::invalid_argument("write_vtp: array \"" + array.name + "\" has " +
                                        std::to_string(values.size()) + " values, expected " +
                                        std::to_string(expected) + " (" +
                                        std::to_string(array.components) + " components of " +
                                        std::to_string(points) + " " + what + ")");
          }
          array_elements += blocks.add(array.name, array.components, std::span(values));
        },
        array.values);
  }
  const std::string point_element = blocks.add("Points", 3, points_xyz);

  std::string piece = "<Piece NumberOfPoints=\"" + std::to_string(points) + "\"";
  for (const std::string_view section : {"Verts", "Lines", "Strips", "Polys"}) {
    std::size_t count = 0;
    for (const VtpCells& kind : cells)
      if (kind.section == section) count = kind.offsets.size();
    piece += " NumberOf" + std::string(section) + "=\"" + std::to_string(count) + "\"";
  }
  std::string cell_elements;
  for (const VtpCells& kind : cells) {
    cell_elements += "<" + std::string(kind.section) + ">\n";
    cell_elements += blocks.add("connectivity", 1, kind.connectivity);
    cell_elements += blocks.add("offsets", 1, kind.offsets);
    cell_elements += "</" + std::string(kind.section) + ">\n";
  }
  const std::string head =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n" +
      time_element + "</FieldData>\n" + piece + ">\n<PointData>\n" + array_elements +
      "</PointData>\n<Points>\n" + point_element + "</Points>\n" + cell_elements +
      "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  const std::string tail = "\n</AppendedData>\n</VTKFile>\n";

  std::vector<std::span<const std::byte>> chunks{std::as_bytes(std::span(head))};
  chunks.insert(chunks.end(), blocks.chunks().begin(), blocks.chunks().end());
  chunks.push_back(std::as_bytes(std::span(tail)));
  replace_file(path, chunks);
}

}  // namespace detail

}  // namespace sphmbs::io
