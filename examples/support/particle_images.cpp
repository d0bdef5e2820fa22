// SPDX-License-Identifier: MIT
#include "support/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/mosaic.hpp"
#include "support/raster.hpp"

namespace sphmbs::examples {

using namespace canvas;

namespace {

constexpr Colour missing_grey{.red = 0.6, .green = 0.6, .blue = 0.6};
constexpr std::size_t colour_steps = 1024;

struct View {
  Range x{};
  Range y{};
  int width = 0;   // pixels
  int height = 0;  // pixels
};

Surface particle_image(const ParticleField& field, const View& view, const Range& values,
                       const Colour& background) {
  const double pixel = (view.x.upper - view.x.lower) / view.width;
  // Discs only where they are seen as such: small squares leave no gaps in a regular arrangement.
  const bool discs = field.diameter >= 6.0 * pixel;
  const int factor = discs ? 3 : 1;
  const double scale = factor / pixel;
  const double radius = 0.5 * field.diameter * scale;

  std::array<std::uint32_t, colour_steps> colours{};
  for (std::size_t i = 0; i < colour_steps; ++i) {
    colours[i] = packed(viridis(static_cast<double>(i) / (colour_steps - 1)));
  }

  Raster raster(view.width * factor, view.height * factor, background);
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    if (!drawable(field.x[i]) || !drawable(field.y[i])) continue;
    const double x = (field.x[i] - view.x.lower) * scale;
    const double y = view.height * factor - (field.y[i] - view.y.lower) * scale;
    std::uint32_t colour = packed(missing_grey);
    if (drawable(field.value[i])) {
      const double fraction =
          std::clamp((field.value[i] - values.lower) / (values.upper - values.lower), 0.0, 1.0);
      colour = colours[static_cast<std::size_t>(std::lround(fraction * (colour_steps - 1)))];
    }
    raster.paint(x, y, radius, discs, colour);
  }
  return raster.surface(factor);
}

void require_tiles(std::span<const MosaicTile> tiles, int columns, const ImageOptions& options) {
  if (tiles.empty()) throw std::invalid_argument("draw_particle_mosaic: no tiles");
  if (columns < 1) throw std::invalid_argument("draw_particle_mosaic: columns must be at least 1");
  require_range(options.value_range, false, "draw_particles: values");
  require_range(options.x_range, false, "draw_particles: x");
  require_range(options.y_range, false, "draw_particles: y");
  for (const MosaicTile& tile : tiles) {
    const ParticleField& field = tile.field;
    if (field.x.size() != field.y.size() || field.x.size() != field.value.size()) {
      throw std::invalid_argument("draw_particles: " + std::to_string(field.x.size()) + " x, " +
                                  std::to_string(field.y.size()) + " y, " +
                                  std::to_string(field.value.size()) + " values");
    }
    if (!std::isfinite(field.diameter) || field.diameter <= 0.0) {
      throw std::invalid_argument("draw_particles: the diameter must be positive");
    }
  }
}

MosaicRanges mosaic_ranges(std::span<const MosaicTile> tiles, const ImageOptions& options) {
  Extent x;
  Extent y;
  Extent value;
  for (const MosaicTile& tile : tiles) {
    const double radius = 0.5 * tile.field.diameter;
    for (std::size_t i = 0; i < tile.field.x.size(); ++i) {
      const double xi = tile.field.x[i];
      const double yi = tile.field.y[i];
      if (!drawable(xi) || !drawable(yi)) continue;
      x.include(xi - radius);
      x.include(xi + radius);
      y.include(yi - radius);
      y.include(yi + radius);
      const bool shown =
          (!options.x_range || (xi >= options.x_range->lower && xi <= options.x_range->upper)) &&
          (!options.y_range || (yi >= options.y_range->lower && yi <= options.y_range->upper));
      if (shown && drawable(tile.field.value[i])) value.include(tile.field.value[i]);
    }
  }
  if ((!options.x_range || !options.y_range) && x.empty()) {
    throw std::invalid_argument("draw_particles: no particles and no box to show");
  }
  MosaicRanges ranges{.x = options.x_range.value_or(Range{x.lower, x.upper}),
                      .y = options.y_range.value_or(Range{y.lower, y.upper}),
                      .value = options.value_range.value_or(visible_range(value, false, 0.0))};
  ranges.below = value.lower < ranges.value.lower;
  ranges.above = value.upper > ranges.value.upper;
  return ranges;
}

}  // namespace

void draw_particles(const std::filesystem::path& file, const ParticleField& field,
                    const ImageOptions& options) {
  const MosaicTile tile{.field = field};
  draw_particle_mosaic(file, std::span(&tile, 1), 1, options);
}

void draw_particle_mosaic(const std::filesystem::path& file, std::span<const MosaicTile> tiles,
                          int columns, const ImageOptions& options) {
  require_extension(file, ".png");
  require_tiles(tiles, columns, options);
  const MosaicRanges ranges = mosaic_ranges(tiles, options);
  std::vector<std::string> titles;
  for (const MosaicTile& tile : tiles) titles.push_back(tile.title);
  draw_mosaic(file, titles, columns, options, ranges, "draw_particles",
              [&](cairo_t* cr, std::size_t i, const Box& box) {
                const View view{ranges.x, ranges.y, static_cast<int>(box.width),
                                static_cast<int>(box.height)};
                const Surface image =
                    particle_image(tiles[i].field, view, ranges.value, options.background);
                cairo_set_source_surface(cr, image.get(), box.left, box.top);
                cairo_paint(cr);
              });
}

}  // namespace sphmbs::examples
