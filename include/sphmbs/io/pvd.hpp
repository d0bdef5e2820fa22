// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/io/replace_file.hpp>
#include <sphmbs/io/xml.hpp>

namespace sphmbs::io {

/// List of the files of a run with their times (.pvd), which ParaView opens as one animation.
///
/// The list on disk is complete and valid after construction and after every add(), so that a run
/// can be watched, and can be read up to its last output if it ends early.
class PvdCollection {
 public:
  /// Writes an empty list to `path`, replacing an earlier one: an output directory that cannot be
  /// written is noticed before the run. Throws OutputError with path and reason.
  explicit PvdCollection(std::filesystem::path path) : PvdCollection(std::move(path), Restored{}) {
    write();
  }

  /// Of a list that a checkpoint restores.
  struct Restored {};
  /// An earlier list on disk is left alone until the checkpoint restores this one.
  PvdCollection(std::filesystem::path path, Restored) : path_(std::move(path)) {}

  /// Appends a file at physical time `time` [s] and rewrites the list. `relative_file` is relative
  /// to the directory of the list, with forward slashes. Several files of one time, such as gas
  /// and bodies, are told apart by `part`. Throws std::invalid_argument if the time
  /// is not finite, OutputError with path and reason if writing fails: the file is then not
  /// listed.
  void add(double time, const std::string& relative_file, int part = 0) {
    if (!std::isfinite(time)) {
      throw std::invalid_argument("PvdCollection: the time of \"" + relative_file +
                                  "\" is not finite");
    }
    const std::size_t before = entries_.size();
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, time).ptr;
    entries_ += "<DataSet timestep=\"" + std::string(digits, end) + "\" group=\"\" part=\"" +
                std::to_string(part) + "\" file=\"" + detail::xml_escaped(relative_file) + "\"/>\n";
    try {
      write();
    } catch (...) {
      entries_.resize(before);
      throw;
    }
  }

  /// Restored, the list on disk is what it was then.
  template <Archive A>
  void visit_state(A& archive) {
    archive("entries", entries_);
    if constexpr (A::restores) write();
  }

 private:
  void write() const {
    const std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n" +
        entries_ + "</Collection>\n</VTKFile>\n";
    const std::span<const std::byte> chunk = std::as_bytes(std::span(text));
    detail::replace_file(path_, std::span(&chunk, 1));
  }

  std::filesystem::path path_;
  std::string entries_;
};

}  // namespace sphmbs::io
