// SPDX-License-Identifier: MIT
#include "support/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sphmbs::examples::canvas {
namespace {

// First and one past the last of `count` pixels whose centres lie within `radius` of `centre` (in
// pixels), at least the pixel that holds the centre. A hair more than that, so that round-off opens
// no gap between neighbours that just touch.
std::pair<int, int> covered_pixels(double centre, double radius, int count) {
  constexpr double hair = 0.01;
  double first = std::ceil(centre - radius - 0.5 - hair);
  double end = std::ceil(centre + radius - 0.5 + hair);
  if (end <= first) {
    first = std::floor(centre);
    end = first + 1.0;
  }
  const double limit = count;
  return {static_cast<int>(std::clamp(first, 0.0, limit)),
          static_cast<int>(std::clamp(end, 0.0, limit))};
}

}  // namespace

std::uint32_t packed(const Colour& colour) {
  const auto byte = [](double part) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
  };
  return byte(colour.red) << 16U | byte(colour.green) << 8U | byte(colour.blue);
}

Raster::Raster(int width, int height, const Colour& background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
              packed(background)),
      distances_(pixels_.size(), std::numeric_limits<float>::infinity()) {}

void Raster::paint(double x, double y, double radius, bool disc, std::uint32_t colour) {
  const auto [i0, i1] = covered_pixels(x, radius, width_);
  const auto [j0, j1] = covered_pixels(y, radius, height_);
  const double reach = disc ? radius * radius : std::numeric_limits<double>::infinity();
  for (int j = j0; j < j1; ++j) {
    const double dy = j + 0.5 - y;
    const std::size_t row = static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
    for (int i = i0; i < i1; ++i) {
      const double dx = i + 0.5 - x;
      const double squared = dx * dx + dy * dy;
      const std::size_t at = row + static_cast<std::size_t>(i);
      if (squared > reach || squared >= static_cast<double>(distances_[at])) continue;
      distances_[at] = static_cast<float>(squared);
      pixels_[at] = colour;
    }
  }
}

Surface Raster::surface(int factor) const {
  Surface image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_ / factor, height_ / factor));
  if (cairo_surface_status(image.get()) != CAIRO_STATUS_SUCCESS) return image;
  cairo_surface_flush(image.get());
  unsigned char* const data = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  for (int j = 0; j < height_ / factor; ++j) {
    auto* const row = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t{j} * stride);
    for (int i = 0; i < width_ / factor; ++i) row[i] = mean(i, j, factor);
  }
  cairo_surface_mark_dirty(image.get());
  return image;
}

std::uint32_t Raster::mean(int i, int j, int factor) const {
  std::uint32_t red = 0;
  std::uint32_t green = 0;
  std::uint32_t blue = 0;
  for (int b = j * factor; b < (j + 1) * factor; ++b) {
    for (int a = i * factor; a < (i + 1) * factor; ++a) {
      const std::uint32_t pixel =
          pixels_[static_cast<std::size_t>(b) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(a)];
      red += pixel >> 16U & 0xFFU;
      green += pixel >> 8U & 0xFFU;
      blue += pixel & 0xFFU;
    }
  }
  const auto count = static_cast<std::uint32_t>(factor * factor);
  const auto rounded = [count](std::uint32_t sum) { return (sum + count / 2) / count; };
  return rounded(red) << 16U | rounded(green) << 8U | rounded(blue);
}

}  // namespace sphmbs::examples::canvas
