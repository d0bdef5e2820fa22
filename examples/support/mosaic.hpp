// SPDX-License-Identifier: MIT
#pragma once

// Several pictures of one box side by side, with axes and a colour bar. Internal to the pictures.

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "support/canvas.hpp"

namespace sphmbs::examples::canvas {

/// What all tiles of a mosaic show.
struct MosaicRanges {
  Range x{};
  Range y{};
  Range value{};
  bool below = false;  // there are values below the range
  bool above = false;
};

/// Draws a tile into a box of whole pixels.
using PaintTile = std::function<void(cairo_t* cr, std::size_t index, const Box& box)>;

/// Draws tiles with a common box and a colour bar row by row as a PNG file; `what` begins messages.
///
/// Throws std::invalid_argument if the picture would be too small for its labels or too high,
/// OutputError with path and reason if the file cannot be written.
void draw_mosaic(const std::filesystem::path& file, std::span<const std::string> titles,
                 int columns, const ImageOptions& options, const MosaicRanges& ranges,
                 const std::string& what, const PaintTile& paint);

}  // namespace sphmbs::examples::canvas
