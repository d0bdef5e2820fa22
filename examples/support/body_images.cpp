// SPDX-License-Identifier: MIT
#include "support/body_images.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>

#include "support/mosaic.hpp"

namespace sphmbs::examples {

using namespace canvas;

namespace {

using Vector = std::array<double, 3>;

constexpr Colour plain_grey{.red = 0.72, .green = 0.72, .blue = 0.72};
constexpr double margin = 0.04;  // around everything, of the larger extent

double dot(const Vector& a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

const double* point_of(const io::Mesh& mesh, std::int64_t k) { return mesh.points.data() + 3 * k; }

bool drawable_point(const double* p) { return drawable(p[0]) && drawable(p[1]) && drawable(p[2]); }

/// The points of cell `k`.
std::span<const std::int64_t> cell(const io::Cells& cells, std::size_t k) {
  const auto from = static_cast<std::size_t>(k == 0 ? 0 : cells.offsets[k - 1]);
  return std::span(cells.connectivity)
      .subspan(from, static_cast<std::size_t>(cells.offsets[k]) - from);
}

MosaicRanges ranges_of(std::span<const BodyTile> tiles, const View& view,
                       const ImageOptions& options) {
  Extent x, y, value;
  for (const BodyTile& tile : tiles)
    for (const BodyLayer& layer : tile.layers) {
      for (std::size_t k = 0; k < layer.mesh->size(); ++k) {
        const double* p = layer.mesh->points.data() + 3 * k;
        if (!drawable_point(p)) continue;
        const auto [px, py] = view(p);
        x.include(px);
        y.include(py);
      }
      for (const double v : layer.value)
        if (drawable(v)) value.include(v);
    }
  if ((!options.x_range || !options.y_range) && x.empty())
    throw std::invalid_argument("draw_bodies: no bodies and no box to show");
  const double room = margin * std::max(x.upper - x.lower, y.upper - y.lower);
  MosaicRanges ranges{.x = options.x_range.value_or(Range{x.lower - room, x.upper + room}),
                      .y = options.y_range.value_or(Range{y.lower - room, y.upper + room}),
                      .value = options.value_range.value_or(visible_range(value, false, 0.0))};
  ranges.below = value.lower < ranges.value.lower;
  ranges.above = value.upper > ranges.value.upper;
  return ranges;
}

void require_tiles(std::span<const BodyTile> tiles, int columns, const ImageOptions& options) {
  if (tiles.empty()) throw std::invalid_argument("draw_bodies: no tiles");
  if (columns < 1) throw std::invalid_argument("draw_bodies: columns must be at least 1");
  require_range(options.value_range, false, "draw_bodies: values");
  require_range(options.x_range, false, "draw_bodies: x");
  require_range(options.y_range, false, "draw_bodies: y");
  for (const BodyTile& tile : tiles)
    for (const BodyLayer& layer : tile.layers)
      if (!layer.value.empty() && layer.value.size() != layer.mesh->size())
        throw std::invalid_argument("draw_bodies: " + std::to_string(layer.value.size()) +
                                    " values for " + std::to_string(layer.mesh->size()) +
                                    " points");
}

/// Draws the layers of one tile.
class BodyPainter {
 public:
  BodyPainter(cairo_t* cr, const Box& box, const View& view, const ImageOptions& options,
              const MosaicRanges& ranges)
      : cr_(cr),
        box_(box),
        view_(view),
        options_(options),
        ranges_(ranges),
        unit_(std::max(options.width / 1000.0, 0.8)) {}

  void paint(const BodyLayer& layer) const {
    paint_polygons(layer);
    paint_lines(layer);
  }

  /// Arrows along x, y and z in the lower left corner.
  void paint_directions() const {
    const double length = 30.0 * unit_;
    const double x = box_.left + 1.3 * length, y = box_.top + box_.height - 1.3 * length;
    set_colour(cr_, black);
    cairo_set_line_width(cr_, 1.2 * unit_);
    for (std::size_t k = 0; k < 3; ++k) {
      Vector axis{};
      axis[k] = 1.0;
      const auto [right, up] = view_(axis.data());
      draw_line(cr_, x, y, x + length * right, y - length * up);
      cairo_stroke(cr_);
      draw_text(cr_, std::string(1, "xyz"[k]), x + 1.35 * length * right, y - 1.35 * length * up,
                13.0 * unit_, {.across = 0.5, .down = 0.5});
    }
  }

 private:
  void to(const double* point, bool first) const {
    const auto [x, y] = view_(point);
    const double px =
        box_.left + (x - ranges_.x.lower) / (ranges_.x.upper - ranges_.x.lower) * box_.width;
    const double py =
        box_.top + (ranges_.y.upper - y) / (ranges_.y.upper - ranges_.y.lower) * box_.height;
    if (first)
      cairo_move_to(cr_, px, py);
    else
      cairo_line_to(cr_, px, py);
  }

  Colour colour_of(double value) const {
    if (!drawable(value)) return plain_grey;
    return viridis((value - ranges_.value.lower) / (ranges_.value.upper - ranges_.value.lower));
  }

  double mean(const BodyLayer& layer, std::span<const std::int64_t> points) const {
    double sum = 0.0;
    for (const std::int64_t k : points) sum += layer.value[static_cast<std::size_t>(k)];
    return sum / static_cast<double>(points.size());
  }

  // Brightness of a surface in light that comes from above the viewer's left shoulder.
  double brightness(const io::Mesh& mesh, std::span<const std::int64_t> corners) const {
    if (options_.axes) return 1.0;
    const auto between = [&](std::size_t i, std::size_t j) {
      const double *a = point_of(mesh, corners[i]), *b = point_of(mesh, corners[j]);
      return Vector{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    };
    const std::size_t half = corners.size() / 2;
    const Vector n = cross(between(0, half), between(1, corners.size() - 1));
    const double length = std::sqrt(dot(n, n.data()));
    if (!(length > 0.0)) return 1.0;
    const Vector towards = cross(view_.right, view_.up);
    const double light = (0.7 * dot(towards, n.data()) + 0.6 * dot(view_.up, n.data()) -
                          0.4 * dot(view_.right, n.data())) /
                         length;
    return 0.62 + 0.38 * std::min(1.0, std::abs(light));
  }

  void paint_polygons(const BodyLayer& layer) const {
    const io::Mesh& mesh = *layer.mesh;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < mesh.polygons.size(); ++k) {
      const auto corners = cell(mesh.polygons, k);
      double near = 0.0;
      bool good = true;
      for (const std::int64_t corner : corners) {
        near += view_.nearness(point_of(mesh, corner)) / static_cast<double>(corners.size());
        good = good && drawable_point(point_of(mesh, corner));
      }
      if (good) order.emplace_back(near, k);
    }
    std::sort(order.begin(), order.end());
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    for (const auto& [near, k] : order) {
      const auto corners = cell(mesh.polygons, k);
      Colour colour = layer.value.empty() ? plain_grey : colour_of(mean(layer, corners));
      const double shade = brightness(mesh, corners);
      for (double* part : {&colour.red, &colour.green, &colour.blue}) *part *= shade;
      for (std::size_t i = 0; i < corners.size(); ++i) to(point_of(mesh, corners[i]), i == 0);
      cairo_close_path(cr_);
      set_colour(cr_, colour);
      cairo_fill_preserve(cr_);
      // Edges a little darker show the mesh; in a plane view they are all there is to see of a
      // surface on edge.
      if (!options_.axes)
        for (double* part : {&colour.red, &colour.green, &colour.blue}) *part *= 0.85;
      set_colour(cr_, colour);
      cairo_set_line_width(cr_, (options_.axes ? 1.6 : 0.5) * unit_);
      cairo_stroke(cr_);
    }
  }

  // A straight line whose colour runs from that of one end to that of the other.
  void paint_line(const BodyLayer& layer, std::span<const std::int64_t> ends) const {
    const double *a = point_of(*layer.mesh, ends[0]), *b = point_of(*layer.mesh, ends[1]);
    const auto value = [&](std::size_t end) {
      return layer.value.empty() ? nan : layer.value[static_cast<std::size_t>(ends[end])];
    };
    const double from = value(0), to_value = value(1);
    const int pieces = drawable(from) && from != to_value ? 16 : 1;
    const auto between = [&](double s) {
      return Vector{(1 - s) * a[0] + s * b[0], (1 - s) * a[1] + s * b[1],
                    (1 - s) * a[2] + s * b[2]};
    };
    for (int k = 0; k < pieces; ++k) {
      const double s = static_cast<double>(k) / pieces, t = static_cast<double>(k + 1) / pieces;
      set_colour(cr_, colour_of(from + (s + t) / 2 * (to_value - from)));
      to(between(s).data(), true);
      to(between(t).data(), false);
      cairo_stroke(cr_);
    }
  }

  void paint_lines(const BodyLayer& layer) const {
    const io::Mesh& mesh = *layer.mesh;
    cairo_set_line_width(cr_, (layer.value.empty() ? 1.0 : 2.2) * unit_);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
    for (std::size_t k = 0; k < mesh.lines.size(); ++k) {
      const auto points = cell(mesh.lines, k);
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const auto piece = points.subspan(i, 2);
        const double *a = point_of(mesh, piece[0]), *b = point_of(mesh, piece[1]);
        if (!drawable_point(a) || !drawable_point(b)) continue;
        paint_line(layer, piece);
      }
    }
  }

  cairo_t* cr_;
  Box box_;
  const View& view_;
  const ImageOptions& options_;
  const MosaicRanges& ranges_;
  double unit_;
};

}  // namespace

std::array<double, 2> View::operator()(const double* point) const {
  return {dot(right, point), dot(up, point)};
}

double View::nearness(const double* point) const { return dot(cross(right, up), point); }

View oblique_view(double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180.0, e = elevation * std::numbers::pi / 180.0;
  return {.right = {-std::sin(a), std::cos(a), 0.0},
          .up = {-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)}};
}

std::vector<double> lengths_of(const io::Mesh& mesh, const std::string& array) {
  for (const io::PointArray& candidate : mesh.arrays) {
    const auto* values = std::get_if<std::vector<float>>(&candidate.values);
    if (candidate.name != array || candidate.components != 3 || values == nullptr) continue;
    std::vector<double> lengths;
    for (std::size_t k = 0; k + 2 < values->size(); k += 3)
      lengths.push_back(std::hypot((*values)[k], (*values)[k + 1], (*values)[k + 2]));
    return lengths;
  }
  throw std::invalid_argument("lengths_of: the mesh has no vectors " + array);
}

void draw_bodies(const std::filesystem::path& file, std::span<const BodyTile> tiles, int columns,
                 const View& view, const ImageOptions& options) {
  require_extension(file, ".png");
  require_tiles(tiles, columns, options);
  const MosaicRanges ranges = ranges_of(tiles, view, options);
  std::vector<std::string> titles;
  for (const BodyTile& tile : tiles) titles.push_back(tile.title);
  draw_mosaic(file, titles, columns, options, ranges, "draw_bodies",
              [&](cairo_t* cr, std::size_t i, const Box& box) {
                cairo_rectangle(cr, box.left, box.top, box.width, box.height);
                set_colour(cr, options.background);
                cairo_fill_preserve(cr);
                cairo_clip(cr);
                const BodyPainter painter(cr, box, view, options, ranges);
                for (const BodyLayer& layer : tiles[i].layers) painter.paint(layer);
                if (!options.axes && i == 0) painter.paint_directions();
              });
}

}  // namespace sphmbs::examples
