// SPDX-License-Identifier: MIT
#pragma once

/// Optional: needs HDF5's C library, 1.10.2 or newer, and POSIX (target sphmbs::hdf5).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/io/hdf5_handle.hpp>
#include <sphmbs/io/vtp_blocks.hpp>
#include <sphmbs/version.hpp>

namespace sphmbs::io {

/// Points and their quantities at one time: the gas, or a Mesh of bodies. A view.
struct Hdf5Part {
  std::string name;                    ///< of its group in the file: "gas"
  std::span<const double> points_xyz;  ///< x, y, z of each [m]; see points_xyz
  /// Quantities of the points. From the name "pressure [Pa]" comes the data set "pressure" with
  /// "Pa" as attribute `unit`.
  std::span<const PointArray> arrays;
};

/// A file with all frames of a run, for analysis (docs/hdf5.md).
///
/// A frame is appended where nothing lies yet and counts once all of it is in the file: if the
/// program ends at any moment, by a signal or a crash, the frames before can be read. The computer
/// may keep the end of the file in memory, so this does not hold for the loss of power. Every data
/// set has checksums (Fletcher's), which HDF5 compares when it reads. Other programs may read the
/// file while it is written.
///
/// HDF5 must be used by one thread at a time.
class Hdf5Series {
 public:
  /// Creates the file, replacing an earlier one.
  /// @throws OutputError E520 with path and reason.
  Hdf5Series(std::filesystem::path path, const std::string& case_name) : path_(std::move(path)) {
    const detail::Hdf5Quiet quiet;
    const detail::Hdf5Check check{path_, "E520"};
    detail::hdf5_reserve(check, 0, room({}));
    const detail::Hdf5Handle access = check(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // The oldest format that may be read while it is written.
    check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
    file_ = check(H5Fcreate(path_.string().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
    detail::hdf5_describe(check, file_, "program", "sphmbs");
    detail::hdf5_describe(check, file_, "version", std::string(version));
    detail::hdf5_describe(check, file_, "case", case_name);
    detail::hdf5_create_rows(check, file_, "time", H5T_NATIVE_DOUBLE, 1, 1, "s");
    check(H5Fflush(file_, H5F_SCOPE_LOCAL));
  }

  /// Appends a frame at physical time `time` [s]. The first one decides on parts, their arrays and
  /// the type of these; the number of points may change.
  /// @throws InvalidInput E522 if the time is not finite, a name or a length does not fit, or the
  ///         frame has other parts or arrays than the first: nothing is written then;
  ///         OutputError E521 with path and reason: the frames before are kept.
  void add(double time, std::span<const Hdf5Part> parts) {
    require(std::isfinite(time), "the time is not finite");
    std::vector<std::string> layout;
    for (const Hdf5Part& part : parts) describe(part, layout);
    require(frames_ == 0 || layout == layout_,
            "its parts and arrays are not those of the first frame");
    const detail::Hdf5Quiet quiet;
    const detail::Hdf5Check check{path_, "E521"};
    hsize_t end = 0;
    check(H5Fget_filesize(file_, &end));
    detail::hdf5_reserve(check, end, room(parts));
    if (frames_ == 0) start(check, parts);
    for (std::size_t k = 0; k < parts.size(); ++k) append(check, parts[k], k);
    check(H5Fflush(file_, H5F_SCOPE_LOCAL));
    detail::hdf5_append_rows(check, file_, "time", frames_, 1, 1, &time);
    check(H5Fflush(file_, H5F_SCOPE_LOCAL));
    layout_ = std::move(layout);
    ++frames_;
  }

  /// Frames that were appended.
  std::size_t size() const { return frames_; }

  /// Ends the file, which the destructor does too, but cannot report a failure.
  /// @throws OutputError E521 with path and reason.
  void close() {
    const detail::Hdf5Quiet quiet;
    detail::Hdf5Check{path_, "E521"}(file_.close());
  }

 private:
  void require(bool condition, const std::string& otherwise) const {
    if (!condition)
      throw InvalidInput(
          "frame " + std::to_string(frames_) + " of " + path_.string() + ": " + otherwise, "E522");
  }

  // Bytes that a frame takes in the file, and more than HDF5 needs to find it again.
  std::size_t room(std::span<const Hdf5Part> parts) const {
    constexpr std::size_t of_set = 65536;
    std::size_t bytes = 4 * of_set;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::size_t chunk = frames_ > 0 ? chunk_[k] : least_chunk;
      const std::size_t rows = parts[k].points_xyz.size() / 3 + chunk;  // a part of one is written
      bytes += 2 * of_set + 3 * sizeof(double) * rows;
      for (const PointArray& array : parts[k].arrays)
        bytes += of_set + static_cast<std::size_t>(array.components) * sizeof(double) * rows;
    }
    return bytes;
  }

  // "pressure [Pa]" is the pressure, in Pa.
  static std::pair<std::string, std::string> name_and_unit(const std::string& name) {
    const std::size_t bracket = name.rfind(" [");
    if (bracket == std::string::npos || !name.ends_with(']')) return {name, ""};
    return {name.substr(0, bracket), name.substr(bracket + 2, name.size() - bracket - 3)};
  }

  // Adds what all frames must have in common.
  void describe(const Hdf5Part& part, std::vector<std::string>& layout) const {
    const std::size_t points = part.points_xyz.size() / 3;
    const std::string of_part = " of part \"" + part.name + "\"";
    const auto take_name = [&](const std::string& entry, const std::string& name) {
      require(!name.empty() && name != "." && name.find('/') == std::string::npos,
              "\"" + name + "\" cannot name a data set or a group: it must not be empty or hold /");
      require(std::find(layout.begin(), layout.end(), entry) == layout.end(),
              "there are two \"" + name + "\"");
      layout.push_back(entry);
    };
    take_name(part.name, part.name);
    require(part.name != "time", "a part cannot be called \"time\"");
    require(part.points_xyz.size() % 3 == 0, std::to_string(part.points_xyz.size()) +
                                                 " coordinates" + of_part +
                                                 ": must be a multiple of 3");
    layout.push_back(part.name + "/position");
    layout.push_back(part.name + "/rows");
    for (const PointArray& array : part.arrays) {
      take_name(part.name + "/" + name_and_unit(array.name).first, name_and_unit(array.name).first);
      const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array.values);
      const std::size_t expected = points * static_cast<std::size_t>(std::max(array.components, 0));
      require(array.components >= 1 && values == expected,
              std::to_string(values) + " values of \"" + array.name + "\"" + of_part +
                  ": must be " + std::to_string(expected) + ", " +
                  std::to_string(array.components) + " for each point");
      layout.push_back(std::to_string(array.components) + " of type " +
                       std::to_string(array.values.index()) + " " + array.name);
    }
  }

  // Creates all data sets, since none can be added once others may read along.
  void start(const detail::Hdf5Check& check, std::span<const Hdf5Part> parts) {
    for (const Hdf5Part& part : parts) {
      const detail::Hdf5Handle group = check(
          H5Gcreate2(file_, part.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
      // Frames begin with a chunk of their own: those in the file are never written again.
      const hsize_t points = std::max<hsize_t>(part.points_xyz.size() / 3, least_chunk);
      const hsize_t chunks = (points + most_chunk - 1) / most_chunk;
      const hsize_t chunk = (points + chunks - 1) / chunks;
      chunk_.push_back(chunk);
      next_.push_back(0);
      detail::hdf5_create_rows(check, group, "rows", H5T_NATIVE_UINT64, 2, 1, "");
      detail::hdf5_create_rows(check, group, "position", H5T_NATIVE_DOUBLE, 3, chunk, "m");
      for (const PointArray& array : part.arrays) {
        const auto [name, unit] = name_and_unit(array.name);
        const hid_t type = std::visit(
            []<class T>(const std::vector<T>&) { return detail::hdf5_type<T>(); }, array.values);
        const auto columns = static_cast<hsize_t>(array.components);
        detail::hdf5_create_rows(check, group, name, type, columns, chunk, unit);
      }
    }
    check(H5Fstart_swmr_write(file_));
  }

  void append(const detail::Hdf5Check& check, const Hdf5Part& part, std::size_t number) {
    const detail::Hdf5Handle group =
        check(H5Gopen2(file_, part.name.c_str(), H5P_DEFAULT), H5Gclose);
    const hsize_t begin = next_[number], count = part.points_xyz.size() / 3;
    detail::hdf5_append_rows(check, group, "position", begin, count, 3, part.points_xyz.data());
    for (const PointArray& array : part.arrays)
      std::visit(
          [&](const auto& values) {
            detail::hdf5_append_rows(check, group, name_and_unit(array.name).first, begin, count,
                                     static_cast<hsize_t>(array.components), values.data());
          },
          array.values);
    const std::uint64_t rows[] = {begin, begin + count};
    detail::hdf5_append_rows(check, group, "rows", frames_, 1, 2, rows);
    next_[number] = (begin + count + chunk_[number] - 1) / chunk_[number] * chunk_[number];
  }

  static constexpr std::size_t least_chunk = 16, most_chunk = 16384;  // rows

  std::filesystem::path path_;
  detail::Hdf5Handle file_;
  std::vector<std::string> layout_;
  std::vector<hsize_t> chunk_;  // rows, of each part
  std::vector<hsize_t> next_;   // row at which its next frame begins
  std::size_t frames_ = 0;
};

}  // namespace sphmbs::io
