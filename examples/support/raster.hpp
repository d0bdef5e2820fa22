// SPDX-License-Identifier: MIT
#pragma once

// Particles as pixels. Internal to the pictures.

#include <cstdint>
#include <vector>

#include "support/canvas.hpp"

namespace sphmbs::examples::canvas {

/// A colour as a pixel of CAIRO_FORMAT_RGB24.
std::uint32_t packed(const Colour& colour);

/// Pixels painted with discs and squares, the nearest of which shows.
class Raster {
 public:
  Raster(int width, int height, const Colour& background);

  /// Centre and radius in pixels, y downwards. A pixel belongs to the nearest particle that covers
  /// it, so that the picture does not depend on the order of the particles.
  void paint(double x, double y, double radius, bool disc, std::uint32_t colour);

  /// Means of blocks of `factor` x `factor` pixels, which makes the edges of discs smooth.
  Surface surface(int factor) const;

 private:
  std::uint32_t mean(int i, int j, int factor) const;

  int width_;
  int height_;
  std::vector<std::uint32_t> pixels_;
  std::vector<float> distances_;
};

}  // namespace sphmbs::examples::canvas
