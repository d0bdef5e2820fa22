// SPDX-License-Identifier: MIT
#include "support/body_images.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <cairo.h>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace sphmbs::examples;
using sphmbs::io::Mesh;

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_bodies_" + std::to_string(std::random_device{}()));
  Directory() { std::filesystem::create_directories(path); }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

/// Number of pixels of a colour, to two of 255.
std::size_t count(const std::filesystem::path& file, const Colour& colour) {
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> image(
      cairo_image_surface_create_from_png(file.string().c_str()), cairo_surface_destroy);
  REQUIRE(cairo_surface_status(image.get()) == CAIRO_STATUS_SUCCESS);
  const unsigned char* const data = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  std::size_t found = 0;
  for (int y = 0; y < cairo_image_surface_get_height(image.get()); ++y)
    for (int x = 0; x < cairo_image_surface_get_width(image.get()); ++x) {
      const unsigned char* const p = data + std::ptrdiff_t{y} * stride + 4 * x;
      const auto near = [](unsigned char byte, double part) {
        return std::abs(byte - 255.0 * part) <= 2.0;
      };
      found += near(p[2], colour.red) && near(p[1], colour.green) && near(p[0], colour.blue);
    }
  return found;
}

/// Square of the given size around the origin, at a height z, as one polygon.
Mesh square(double size, double z) {
  const double a = size / 2;
  Mesh mesh{.points = {-a, -a, z, a, -a, z, a, a, z, -a, a, z}};
  mesh.polygons.add({0, 1, 2, 3});
  return mesh;
}

std::vector<double> all(const Mesh& mesh, double value) {
  return std::vector<double>(mesh.size(), value);
}

const ImageOptions plain{.value_range = Range{0.0, 1.0}, .width = 800};

}  // namespace

TEST_CASE("views turn points in space into points of a picture", "[pictures]") {
  const std::array<double, 3> p{1.0, 2.0, 3.0};
  CHECK(view_xy(p.data()) == std::array<double, 2>{1.0, 2.0});
  CHECK(view_xy.nearness(p.data()) == 3.0);
  CHECK(view_xz(p.data()) == std::array<double, 2>{1.0, 3.0});
  CHECK(view_xz.nearness(p.data()) == -2.0);
  // From above with x to the right it is the plane of x and y.
  const auto above = oblique_view(-90, 90)(p.data());
  CHECK(above[0] == Approx(1.0));
  CHECK(above[1] == Approx(2.0));
  CHECK(oblique_view(-90, 90).nearness(p.data()) == Approx(3.0));
  // From the side that the azimuth says, the nearest point is the one on that side.
  CHECK(oblique_view(0, 0).nearness(p.data()) == Approx(1.0));
  CHECK(oblique_view(90, 0).nearness(p.data()) == Approx(2.0));
}

TEST_CASE("of two surfaces the nearer one shows", "[pictures]") {
  const Directory directory;
  Mesh two = square(1.0, 1.0);
  const Mesh far = square(1.0, -1.0);
  two.points.insert(two.points.end(), far.points.begin(), far.points.end());
  two.polygons.add({4, 5, 6, 7});
  std::vector<double> value(8, 1.0);
  std::fill(value.begin() + 4, value.end(), 0.0);
  const BodyTile tile{.layers = {{&two, value}}};
  draw_bodies(directory.path / "two.png", std::span(&tile, 1), 1, view_xy, plain);
  const std::size_t yellow = count(directory.path / "two.png", viridis(1.0));
  CHECK(yellow > 50'000);
  CHECK(count(directory.path / "two.png", viridis(0.0)) < yellow / 50);  // the colour bar's end
}

TEST_CASE("a line has the colours of its values, and none is grey", "[pictures]") {
  const Directory directory;
  Mesh line{.points = {0, 0, 0, 1, 0.3, 0}};
  line.lines.add({0, 1});
  const auto draw = [&](const std::string& name, const std::vector<double>& value) {
    const BodyTile tile{.layers = {{&line, value}}};
    draw_bodies(directory.path / name, std::span(&tile, 1), 1, view_xy, plain);
    return directory.path / name;
  };
  const auto yellow = draw("yellow.png", {1.0, 1.0}), rising = draw("rising.png", {0.0, 1.0});
  const auto grey = draw("grey.png", {});
  const std::size_t bar = count(grey, viridis(1.0));
  CHECK(count(yellow, viridis(1.0)) > bar + 300);
  CHECK(count(rising, viridis(1.0)) < bar + 200);
  CHECK(count(rising, viridis(15.5 / 16)) > count(grey, viridis(15.5 / 16)) + 20);
}

TEST_CASE("surfaces are shaded where there are no axes", "[pictures]") {
  const Directory directory;
  const Mesh flat = square(1.0, 0.0);
  const BodyTile tile{.layers = {{&flat, all(flat, 1.0)}}};
  ImageOptions options = plain;
  draw_bodies(directory.path / "plane.png", std::span(&tile, 1), 1, view_xy, options);
  options.axes = false;
  draw_bodies(directory.path / "space.png", std::span(&tile, 1), 1, oblique_view(-60, 25), options);
  CHECK(count(directory.path / "plane.png", viridis(1.0)) > 50'000);
  CHECK(count(directory.path / "space.png", viridis(1.0)) < 5'000);
}

TEST_CASE("lengths of the vectors of a mesh", "[pictures]") {
  Mesh mesh{.points = std::vector<double>(6, 0.0)};
  mesh.arrays = {{"number", 1, std::vector<std::int32_t>{0, 1}},
                 {"velocity [m/s]", 3, std::vector<float>{3, 0, 4, 0, -2, 0}}};
  CHECK(lengths_of(mesh, "velocity [m/s]") == std::vector<double>{5, 2});
  CHECK_THROWS_AS(lengths_of(mesh, "number"), std::invalid_argument);
  CHECK_THROWS_AS(lengths_of(mesh, "force"), std::invalid_argument);
}

TEST_CASE("draw_bodies refuses what it cannot draw", "[pictures]") {
  const Directory directory;
  const Mesh mesh = square(1.0, 0.0), nothing;
  const auto draw = [&](const std::string& name, const BodyTile& tile, int columns = 1) {
    draw_bodies(directory.path / name, std::span(&tile, 1), columns, view_xy, {});
  };
  const BodyTile good{.layers = {{&mesh, all(mesh, 1.0)}}};
  CHECK_NOTHROW(draw("good.png", good));
  CHECK_THROWS_AS(draw("good.svg", good), std::invalid_argument);
  CHECK_THROWS_AS(draw("a.png", good, 0), std::invalid_argument);
  CHECK_THROWS_AS(draw("a.png", {.layers = {{&mesh, {1.0}}}}), std::invalid_argument);
  CHECK_THROWS_AS(draw("a.png", {.layers = {{&nothing, {}}}}), std::invalid_argument);
  CHECK_THROWS_AS(draw_bodies(directory.path / "a.png", {}, 1, view_xy, {}), std::invalid_argument);
  CHECK_THROWS_AS(draw("missing/a.png", good), sphmbs::OutputError);
}
