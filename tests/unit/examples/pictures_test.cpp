// SPDX-License-Identifier: MIT
#include "support/pictures.hpp"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace sphmbs::examples;

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_pictures_" + std::to_string(std::random_device{}()));
  Directory() { std::filesystem::create_directories(path); }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

std::string content(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  REQUIRE(stream.is_open());
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Image {
 public:
  explicit Image(const std::filesystem::path& path)
      : surface_(cairo_image_surface_create_from_png(path.string().c_str()),
                 cairo_surface_destroy) {
    REQUIRE(cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS);
  }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  std::array<int, 3> pixel(int x, int y) const {
    const unsigned char* const row =
        cairo_image_surface_get_data(surface_.get()) +
        std::ptrdiff_t{y} * cairo_image_surface_get_stride(surface_.get());
    const std::uint32_t value = reinterpret_cast<const std::uint32_t*>(row)[x];
    return {static_cast<int>(value >> 16U & 0xFFU), static_cast<int>(value >> 8U & 0xFFU),
            static_cast<int>(value & 0xFFU)};
  }
  std::size_t count(const std::array<int, 3>& colour) const {
    std::size_t found = 0;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) found += pixel(x, y) == colour ? 1 : 0;
    }
    return found;
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
};

std::array<int, 3> bytes(const Colour& colour) {
  const auto byte = [](double part) { return static_cast<int>(std::lround(255.0 * part)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

struct Particles {
  std::vector<double> x{};
  std::vector<double> y{};
  std::vector<double> value{};
  ParticleField field(double diameter) const {
    return {.x = x, .y = y, .value = value, .diameter = diameter};
  }
};

// Square lattice of n x n particles in the unit square; the value is the ordinate.
Particles lattice(int n) {
  Particles particles;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      particles.x.push_back((i + 0.5) / n);
      particles.y.push_back((j + 0.5) / n);
      particles.value.push_back(particles.y.back());
    }
  }
  return particles;
}

const std::string png_signature = "\x89PNG\r\n\x1a\n";
constexpr std::array<int, 3> white{255, 255, 255};

Panel example_panel() {
  Panel panel{.title = "density", .x_label = "x [m]", .y_label = "ρ [kg/m³]"};
  panel.curves = {{.label = "SPH", .x = {0.0, 0.5, 0.6, 1.0}, .y = {1.0, std::nan(""), 0.4, 0.1}},
                  {.label = "exact", .x = {0.0, 1.0}, .y = {1.0, 0.1}, .reference = true}};
  return panel;
}

}  // namespace

TEST_CASE("viridis runs from dark violet to yellow", "[pictures]") {
  CHECK(viridis(0.0).blue > viridis(0.0).red);
  CHECK(viridis(1.0).red > 0.9);
  CHECK(viridis(1.0).green > 0.85);
  CHECK(viridis(1.0).blue < 0.3);
  CHECK(bytes(viridis(-1.0)) == bytes(viridis(0.0)));
  CHECK(bytes(viridis(2.0)) == bytes(viridis(1.0)));
  double luminance = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = viridis(i / 100.0);
    const double next = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    CHECK(next > luminance);
    luminance = next;
  }
}

TEST_CASE("palette colours repeat", "[pictures]") {
  CHECK(bytes(palette_colour(0)) != bytes(palette_colour(1)));
  CHECK(bytes(palette_colour(6)) == bytes(palette_colour(0)));
  CHECK(bytes(palette_colour(-1)) == bytes(palette_colour(5)));
}

TEST_CASE("panels are written as PNG and SVG", "[pictures]") {
  const Directory directory;
  const std::vector<Panel> panels(3, example_panel());
  draw_panels(directory.path / "panels.png", "Three panels", panels, 2);
  draw_panels(directory.path / "panels.svg", "Three panels", panels, 2);

  const std::string png = content(directory.path / "panels.png");
  CHECK(png.starts_with(png_signature));
  CHECK(png.size() > 10000);
  const std::string svg = content(directory.path / "panels.svg");
  CHECK(svg.starts_with("<?xml"));
  CHECK(svg.find("</svg>") != std::string::npos);

  const FigureSize size;
  const Image image(directory.path / "panels.png");
  CHECK(image.width() == std::lround(2.0 * size.panel_width * size.png_scale));
  CHECK(image.height() > std::lround(2.0 * size.panel_height * size.png_scale));
  // The fourth place stays empty.
  CHECK(image.pixel(image.width() * 3 / 4, image.height() * 3 / 4) == white);
  CHECK(image.count(bytes(palette_colour(0))) > 100);
}

TEST_CASE("a NaN interrupts a curve", "[pictures]") {
  const Directory directory;
  const auto blue_pixels = [&](double middle) {
    Panel panel;
    panel.curves = {{.x = {0.0, 0.5, 1.0}, .y = {0.5, middle, 0.5}}};
    panel.y_range = Range{.lower = 0.0, .upper = 1.0};
    draw_panels(directory.path / "gap.png", "", std::span(&panel, 1), 1);
    return Image(directory.path / "gap.png").count(bytes(palette_colour(0)));
  };
  CHECK(blue_pixels(0.5) > 500);
  CHECK(blue_pixels(std::nan("")) == 0);
}

TEST_CASE("panels of constants, nothing and non-positive logarithms are drawn", "[pictures]") {
  const Directory directory;
  std::vector<Panel> panels(5);
  panels[1].curves = {{.label = "constant", .x = {0.0, 1.0}, .y = {5.0, 5.0}}};
  panels[2].curves = {{.label = "mixed", .x = {-1.0, 0.01, 100.0}, .y = {1.0, 0.0, 1e-300}}};
  panels[2].log_x = true;
  panels[2].log_y = true;
  panels[3].curves = {{.label = "far", .x = {0.0, 1.0, 2.0}, .y = {-1e300, 1e300, 0.0}}};
  panels[3].y_range = Range{.lower = 0.0, .upper = 1.0};
  panels[4].curves = {{.label = "diverged", .x = {0.0, 1.0, 2.0}, .y = {-1.7e308, 1.7e308, 1.0}}};
  draw_panels(directory.path / "edge.png", "", panels, 2);
  CHECK(Image(directory.path / "edge.png").width() > 0);
}

TEST_CASE("draw_panels refuses what it cannot draw", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "a.png";
  Panel panel = example_panel();
  const std::span<const Panel> panels(&panel, 1);
  CHECK_THROWS_AS(draw_panels(directory.path / "a.jpg", "", panels, 1), std::invalid_argument);
  CHECK_THROWS_AS(draw_panels(file, "", {}, 1), std::invalid_argument);
  CHECK_THROWS_AS(draw_panels(file, "", panels, 0), std::invalid_argument);
  panel.x_range = Range{.lower = 1.0, .upper = 1.0};
  CHECK_THROWS_AS(draw_panels(file, "", panels, 1), std::invalid_argument);
  panel.x_range = Range{.lower = 0.0, .upper = 1.0};
  panel.log_x = true;
  CHECK_THROWS_AS(draw_panels(file, "", panels, 1), std::invalid_argument);
  panel.x_range.reset();
  panel.curves[0].y.pop_back();
  CHECK_THROWS_AS(draw_panels(file, "", panels, 1), std::invalid_argument);
}

TEST_CASE("particles show their value at their place", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "particles.png";
  const Particles particles = lattice(4);
  draw_particles(file, particles.field(0.25),
                 {.title = "four rows", .bar_label = "y [m]", .value_range = Range{0.125, 0.875}});
  CHECK(content(file).starts_with(png_signature));
  CHECK(content(file).size() > 2000);

  const Image image(file);
  CHECK(image.width() == 1200);
  // Down a column of particles: the highest values first.
  std::vector<int> first_seen;
  for (int row = 3; row >= 0; --row) {
    const std::array<int, 3> expected = bytes(viridis(row / 3.0));
    for (int y = 0; y < image.height(); ++y) {
      if (image.pixel(300, y) != expected) continue;
      first_seen.push_back(y);
      break;
    }
  }
  REQUIRE(first_seen.size() == 4);
  CHECK(first_seen[0] < first_seen[1]);
  CHECK(first_seen[1] < first_seen[2]);
  CHECK(first_seen[2] < first_seen[3]);
}

TEST_CASE("a regular arrangement of small particles has no gaps, and a body stays white",
          "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "body.png";
  const int n = 300;
  Particles particles = lattice(n);
  Particles outside;
  for (std::size_t i = 0; i < particles.x.size(); ++i) {
    if (std::hypot(particles.x[i] - 0.5, particles.y[i] - 0.5) < 0.2) continue;
    outside.x.push_back(particles.x[i]);
    outside.y.push_back(particles.y[i]);
    outside.value.push_back(2.0);
  }
  const ImageOptions options{.value_range = Range{0.0, 1.0},
                             .x_range = Range{0.0, 1.0},
                             .y_range = Range{0.0, 1.0},
                             .width = 800};
  draw_particles(file, outside.field(1.0 / n), options);
  const Image image(file);
  const std::array<int, 3> top = bytes(viridis(1.0));

  // Along the row through the centre: gas, body, gas.
  int changes = 0;
  int first = -1;
  int last = -1;
  const int middle = image.height() / 2 - 20;
  for (int x = 0; x < image.width() * 3 / 4; ++x) {
    if (image.pixel(x, middle) != top) continue;
    if (first < 0) first = x;
    if (last >= 0 && x > last + 1) ++changes;
    last = x;
  }
  CHECK(changes == 1);
  CHECK(image.pixel((first + last) / 2, middle) == white);
}

TEST_CASE("particles are cut at the edge of the box", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "cut.png";
  const Particles particles{.x = {-3.0, 0.0, 9.0, 1e300, std::nan("")},
                            .y = {0.5, 0.5, 0.5, 0.5, 0.5},
                            .value = {0.5, 0.5, 0.5, 0.5, 0.5}};
  const ImageOptions options{.value_range = Range{0.0, 1.0},
                             .x_range = Range{0.0, 1.0},
                             .y_range = Range{0.0, 1.0},
                             .width = 800};
  draw_particles(file, particles.field(0.5), options);
  const Image image(file);
  // Half a disc remains, twice as high as wide. The colour bar on the right is left out.
  const std::array<int, 3> colour = bytes(viridis(0.5));
  int left = image.width();
  int right = 0;
  int bottom = 0;
  int top = image.height();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width() * 3 / 4; ++x) {
      if (image.pixel(x, y) != colour) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  REQUIRE(right > left);
  const double ratio = static_cast<double>(bottom - top) / (right - left);
  CHECK(ratio == Approx(2.0).epsilon(0.05));
}

TEST_CASE("particles without a value are grey", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "grey.png";
  Particles particles = lattice(10);
  particles.value.assign(particles.value.size(), std::nan(""));
  draw_particles(file, particles.field(0.1), {});
  CHECK(Image(file).count({153, 153, 153}) > 100000);
}

TEST_CASE("a mosaic shows all fields with one range", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "mosaic.png";
  std::vector<Particles> fields(4, lattice(20));
  std::vector<MosaicTile> tiles;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    fields[i].value.assign(fields[i].x.size(), static_cast<double>(i));
    tiles.push_back({.field = fields[i].field(0.06), .title = "t = " + std::to_string(i) + " s"});
  }
  draw_particle_mosaic(file, tiles, 2, {.title = "mosaic", .bar_label = "p [Pa]"});
  const Image image(file);
  for (int i = 0; i < 4; ++i) CHECK(image.count(bytes(viridis(i / 3.0))) > 10000);
}

TEST_CASE("draw_particles refuses what it cannot draw", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "a.png";
  const Particles particles = lattice(2);
  const ParticleField field = particles.field(0.5);
  ParticleField shorter = field;
  shorter.value = shorter.value.first(1);
  CHECK_THROWS_AS(draw_particles(directory.path / "a.svg", field, {}), std::invalid_argument);
  CHECK_THROWS_AS(draw_particles(file, shorter, {}), std::invalid_argument);
  CHECK_THROWS_AS(draw_particles(file, particles.field(0.0), {}), std::invalid_argument);
  CHECK_THROWS_AS(draw_particles(file, Particles{}.field(1.0), {}), std::invalid_argument);
  CHECK_THROWS_AS(draw_particles(file, field, {.width = 20}), std::invalid_argument);
  CHECK_THROWS_AS(draw_particles(file, field, {.x_range = Range{0.0, 1e-6}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(draw_particle_mosaic(file, {}, 1, {}), std::invalid_argument);
}

TEST_CASE("pictures that cannot be written are reported with their path", "[pictures]") {
  const Directory directory;
  const std::filesystem::path file = directory.path / "missing" / "a.png";
  const Particles particles = lattice(2);
  const Panel panel = example_panel();
  std::string message;
  try {
    draw_particles(file, particles.field(0.5), {});
  } catch (const sphmbs::OutputError& error) {
    message = error.what();
  }
  CHECK(message.find(file.string()) != std::string::npos);
  CHECK_THROWS_AS(draw_panels(directory.path / "missing" / "a.svg", "", std::span(&panel, 1), 1),
                  sphmbs::OutputError);

  if (!std::filesystem::exists("/dev/full")) return;
  std::filesystem::create_symlink("/dev/full", directory.path / "full.png");
  CHECK_THROWS_AS(draw_panels(directory.path / "full.png", "", std::span(&panel, 1), 1),
                  sphmbs::OutputError);
}
