// SPDX-License-Identifier: MIT
// Readers of geometry: good files, and what they say about bad ones.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/geometry/inspection.hpp>
#include <sphmbs/io/obj.hpp>
#include <sphmbs/io/path_text.hpp>
#include <sphmbs/io/stl.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/meshes.hpp"

namespace {

using namespace sphmbs;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string stl_refusal(const std::string& content) {
  return test::refusal([&] { io::parse_stl(content, "a.stl"); });
}
std::string obj_refusal(const std::string& content) {
  return test::refusal([&] { io::parse_obj(content, "a.obj"); });
}
std::string path_refusal(const std::string& content) {
  return test::refusal([&] { io::parse_path(content, "a.txt"); });
}

/// The same corners in the same order.
bool same(const test::Triangles& a, const test::Triangles& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!(norm2(a[i][k] - b[i][k]) <= tolerance * tolerance)) return false;
  return true;
}

double area(const std::string& path) {
  return std::abs(geometry::volume(io::parse_path(path, "a.txt", {.flatness = 1e-7})));
}

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_geometry_" + std::to_string(std::random_device{}()));
  Directory() { std::filesystem::create_directories(path); }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

}  // namespace

TEST_CASE("STL is read as it was written, text and binary", "[io]") {
  const auto t = test::torus(12, 7, 1, 0.3);
  CHECK(same(io::parse_stl(test::text_stl(t), "a.stl"), t, 0));
  CHECK(same(io::parse_stl(test::binary_stl(t), "a.stl"), t, 1e-7));
  CHECK(inspect(io::parse_stl(test::binary_stl(t), "a.stl")).watertight());
  const auto metres = geometry::mapped(t, [](const Vec<3>& x) { return io::millimetre * x; });
  CHECK(same(io::parse_stl(test::text_stl(t), "a.stl", io::millimetre), metres, 1e-18));
  CHECK(same(io::parse_stl(test::binary_stl(t), "a.stl", io::millimetre), metres, 1e-10));
}

TEST_CASE("which kind of STL it is does not hang on how it begins", "[io]") {
  const auto t = test::box({0, 0, 0}, {1, 2, 3});
  // Many programs begin binary files with "solid".
  CHECK(same(io::parse_stl(test::binary_stl(t, "solid by some program"), "a.stl"), t, 0));
  // ... and some add bytes to them.
  std::string more = test::binary_stl(t, std::string("solid\0", 6)) + "xyz";
  CHECK(same(io::parse_stl(more, "a.stl"), t, 0));
  CHECK(io::parse_stl("\xef\xbb\xbf  SOLID a\r\n" + facet + "EndSolid\r\n", "a.stl").size() == 1);
  CHECK(io::parse_stl("solid a\n" + facet + "endsolid a\nsolid b\n" + facet + facet + "endsolid b",
                      "a.stl")
            .size() == 3);
  std::string nan = facet;
  nan.replace(nan.find("0 0 1"), 5, "nan nan nan");  // of a triangle without extent
  CHECK(io::parse_stl("solid\n" + nan + "endsolid", "a.stl").size() == 1);
  CHECK(io::parse_stl("solid\nendsolid", "a.stl").size() == 0);
}

TEST_CASE("bad STL is refused with the place and what is wrong", "[io]") {
  const auto text = [](std::string from, const std::string& to) {
    std::string all = "solid\n" + facet + facet + "endsolid\n";
    all.replace(all.find(from), from.size(), to);
    return stl_refusal(all);
  };
  CHECK_THAT(text("vertex 1 0 0", "vertx 1 0 0"),
             StartsWith("a.stl:5: \"vertx\" found: must be \"vertex\""));
  CHECK_THAT(text("vertex 1 0 0", "vertex 1 0"),
             StartsWith("a.stl:6: \"vertex\" found: must be a number"));
  CHECK_THAT(text("vertex 1 0 0", "vertex 1 0 0 0"), StartsWith("a.stl:5: \"0\""));
  CHECK_THAT(text("vertex 1 0 0", "vertex 1 0 1e99"), Contains("finite coordinate"));
  CHECK_THAT(text("vertex 1 0 0", "vertex 1 0 nan"), Contains("finite coordinate"));
  CHECK_THAT(text("vertex 1 0 0", "vertex 1 0 1e999"), Contains("must be a number"));
  CHECK_THAT(text("vertex 1 0 0", "vertex 1,0,0"), Contains("\"1,0,0\""));
  CHECK_THAT(text("vertex 1 0 0\n", ""), StartsWith("a.stl:6: \"endloop\""));
  CHECK_THAT(text("facet normal", "face normal"), Contains("\"facet\" or \"endsolid\""));
  CHECK_THAT(stl_refusal("solid\n" + facet), StartsWith("a.stl:9: nothing found"));
  CHECK_THAT(stl_refusal("solid\n" + facet + "endsolid\nfacet"), Contains("end of the file"));
  CHECK_THAT(stl_refusal("hello"), StartsWith("a.stl:byte 5: end of file"));
  CHECK_THAT(stl_refusal(""), StartsWith("a.stl:byte 0"));

  const std::string good = test::binary_stl(test::box({0, 0, 0}, {1, 1, 1}));
  for (const std::size_t length : {83u, 84u, 100u, 133u, 683u}) {
    CAPTURE(length);
    CHECK_FALSE(stl_refusal(good.substr(0, length)).empty());
  }
  CHECK_THAT(stl_refusal(good.substr(0, 683)),
             StartsWith("a.stl:byte 80: 12 triangles stated: must be at most the 11"));
  std::string huge = good;
  huge.replace(80, 4, "\xff\xff\xff\xff");
  CHECK_THAT(stl_refusal(huge), Contains("4294967295 triangles"));
  std::string nan = good;
  nan.replace(84 + 50 + 12, 4, std::string("\0\0\xc0\x7f", 4));
  CHECK_THAT(stl_refusal(nan), StartsWith("a.stl:byte 146: coordinate nan of triangle 1"));
  CHECK_THAT(test::refusal([&] { io::parse_stl(good, "a.stl", 0); }),
             Contains("unit of length = 0"));
  CHECK_THAT(test::refusal([&] { io::parse_stl(good, "a.stl", 1e40); }), Contains("coordinate"));
}

TEST_CASE("OBJ faces become fans, and count points both ways", "[io]") {
  const auto t = io::parse_obj(
      "# a square and a triangle\nmtllib x.mtl\no thing\n"
      "v 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
      "usemtl a\ns off\nf 1/1/1 2//1 3/1 \\\n 4\nf -4 -3 -2 # backwards\nl 1 2\n",
      "a.obj");
  REQUIRE(t.size() == 3);
  CHECK(t.points.size() == 4);
  CHECK(t.corners[0] == geometry::Facets<3>::Corners{0, 1, 2});
  CHECK(t.corners[1] == geometry::Facets<3>::Corners{0, 2, 3});
  CHECK(t.corners[2] == geometry::Facets<3>::Corners{0, 1, 2});
  // Faces may come before their points.
  CHECK(io::parse_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\r\nv 0 1 +2", "a.obj", 0.5).points[2][2] == 1);
  CHECK(io::parse_obj("", "a.obj").size() == 0);
}

TEST_CASE("bad OBJ is refused with the line and what is wrong", "[io]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(obj_refusal(points + "f 1 2 3").empty());
  CHECK_THAT(obj_refusal(points + "f 1 2 4"),
             StartsWith("a.obj:4: \"4\" found: must be a point from 1 to 3"));
  CHECK_THAT(obj_refusal(points + "f 1 2 -4"), Contains("from -1 to -3"));
  CHECK_THAT(obj_refusal(points + "f 0 1 2"), Contains("\"0\""));
  CHECK_THAT(obj_refusal(points + "f 1 2 x"), Contains("\"x\""));
  CHECK_THAT(obj_refusal(points + "f 1 2 9999999999999999999999"), StartsWith("a.obj:4"));
  CHECK_THAT(obj_refusal(points + "f 1 2 -9223372036854775808"), StartsWith("a.obj:4"));
  CHECK_THAT(obj_refusal(points + "f 1 2"), Contains("a third corner"));
  CHECK_THAT(obj_refusal(points + "f"), Contains("a third corner"));
  CHECK_THAT(obj_refusal("v 1 2\n"), StartsWith("a.obj:1: nothing found: must be a number"));
  CHECK_THAT(obj_refusal("v 1 2 inf\n"), Contains("finite"));
  CHECK_THAT(obj_refusal("v 1 2 3,5\n"), Contains("\"3,5\""));
  CHECK_THAT(obj_refusal("v 1 2 " + std::string(99, '\x01') + "\n"), Contains("???...\""));
}

TEST_CASE("rows of coordinates are outlines", "[io]") {
  const auto square =
      io::parse_path("NACA 0012\n# a comment\n0 0\n1,0\n1;\t1 # corner\n0 1\n", "a");
  CHECK(square.size() == 4);
  CHECK(geometry::volume(square) == 1);
  CHECK(inspect(square).watertight());
  const auto two = io::parse_path(
      "\n\n0 0\n1 0\n# no empty line\n1 1\n\n\n5 5\r\n6 5\r\n6 6\r\n5 5\r\n", "a", {.unit = 2});
  CHECK(two.size() == 6);
  CHECK(geometry::volume(two) == Approx(4));
  CHECK(io::parse_path("", "a").size() == 0);
}

TEST_CASE("bad rows are refused with the line and what is wrong", "[io]") {
  CHECK_THAT(path_refusal("0 0\n1 0\n"),
             StartsWith("a.txt:3: nothing found: must be a third corner"));
  CHECK_THAT(path_refusal("0 0\n1 0\n\n0 0\n"), StartsWith("a.txt:3"));
  CHECK_THAT(path_refusal("0 0\n1\n"), StartsWith("a.txt:2: nothing found: must be a number"));
  CHECK_THAT(path_refusal("0 0\n1 2 3\n"), StartsWith("a.txt:2: \"3\" found: must be the end"));
  CHECK_THAT(path_refusal("0 0\nx y\n"), StartsWith("a.txt:2: \"x\""));
  CHECK_THAT(path_refusal("0 0\n1 nan\n"), Contains("finite"));
  CHECK_THAT(path_refusal("0 0\n1 1e31\n"), Contains("finite"));
  CHECK_THAT(test::refusal([] { io::parse_path("", "a", {.unit = -1}); }), Contains("unit"));
  CHECK_THAT(test::refusal([] { io::parse_path("", "a", {.flatness = 0}); }), Contains("flatness"));
}

TEST_CASE("path data of SVG: lines", "[io]") {
  CHECK(area("M0 0L2 0L2 1L0 1Z") == Approx(2));
  CHECK(area("m1,1 2,0 0,1 -2,0z") == Approx(2));  // the pairs after the first are lines
  CHECK(area("M 0 0 H 2 V 1 h -2 z") == Approx(2));
  CHECK(area("M0 0h2v1h-2") == Approx(2));    // closed although not said
  CHECK(area("M.5.5h2v1h-2z") == Approx(2));  // numbers may touch
  CHECK(area("# a comment\nM0-0 H2\n V1e0 # another\n H 0z m9 9") == Approx(2));
  // After z the path goes on from where it began.
  const auto two = io::parse_path("M1 1h1v1h-1z l5 5 1 0 0 1z", "a");
  CHECK(two.size() == 8);
  CHECK(two.points[4] == Vec<2>{1, 1});
  CHECK(two.points[5] == Vec<2>{6, 6});
}

TEST_CASE("path data of SVG: curves", "[io]") {
  using math::pi;
  CHECK(area("M1 0A1 1 0 0 1 -1 0A1 1 0 0 1 1 0Z") == Approx(pi).epsilon(1e-5));
  CHECK(area("M1 0a1 1 0 01-2 0a1 1 0 01 2 0z") == Approx(pi).epsilon(1e-5));  // flags may touch
  CHECK(area("M1 0A1 1 0 0 1 0 1L0 0Z") == Approx(pi / 4).epsilon(1e-5));
  CHECK(area("M1 0A1 1 0 1 0 0 1L0 0Z") == Approx(3 * pi / 4).epsilon(1e-5));
  CHECK(area("M1 0A1 1 0 1 1 0 1Z") == Approx(3 * pi / 4 + 0.5).epsilon(1e-5));
  // An ellipse on its side, and radii that are too short.
  CHECK(area("M0 2A2 1 90 0 1 0 -2A2 1 90 0 1 0 2Z") == Approx(2 * pi).epsilon(1e-5));
  CHECK(area("M1 0A.1 .1 0 0 1 -1 0A.1 .1 0 0 1 1 0Z") == Approx(pi).epsilon(1e-5));
  // The area under a parabola, and under the same one as a curve of third degree.
  CHECK(area("M0 0Q1 2 2 0Z") == Approx(4.0 / 3).epsilon(1e-5));
  CHECK(area("M0 0q1 2 2 0z") == Approx(4.0 / 3).epsilon(1e-5));
  CHECK(area("M0 0C0.66666666666667 1.3333333333333 1.3333333333333 1.3333333333333 2 0Z") ==
        Approx(4.0 / 3).epsilon(1e-5));
  // The smooth continuations mirror the control points.
  CHECK(area("M0 0Q1 2 2 0T4 0H0Z") == Approx(0).margin(1e-5));
  CHECK(area("M0 0C0 1 1 1 1 0S2 -1 2 0Z") == Approx(0).margin(1e-5));
  // Without radius an arc is a line.
  CHECK(area("M0 0A0 1 0 0 1 1 0V1Z") == Approx(0.5));
  CHECK(path_refusal("M0 0C0 0 0 0 0 0Z").empty());
}

TEST_CASE("curves become as many pieces as flatness asks for", "[io]") {
  const auto error = [](double flatness) {
    const geometry::Outline disk(
        io::parse_path("M1 0A1 1 0 0 1 -1 0A1 1 0 0 1 1 0Z", "a", {.flatness = flatness}));
    double worst = 0;
    for (int k = 0; k < 1000; ++k)
      worst = std::max(worst, std::abs(disk.distance({std::cos(0.01 * k), std::sin(0.01 * k)})));
    return worst;
  };
  for (const double flatness : {1e-2, 1e-3, 1e-4, 1e-5}) {  // the path's corners are 2 m apart
    CHECK(error(flatness) < 2.001 * flatness);
    CHECK(error(flatness) > 0.5 * flatness);
  }
}

TEST_CASE("bad path data are refused with the line and what is wrong", "[io]") {
  CHECK_THAT(path_refusal("M0 0L1 1Z"), StartsWith("a.txt:1") && Contains("a third corner"));
  CHECK_THAT(path_refusal("M0 0\nL1 1 1"), StartsWith("a.txt:2: nothing found: must be a number"));
  CHECK_THAT(path_refusal("M0 0\nL1 1\nx 2"),
             StartsWith("a.txt:3: \"x\" found: must be a command"));
  CHECK_THAT(path_refusal("M0 0 A1 1 0 2 0 1 1"), Contains("must be 0 or 1"));
  CHECK_THAT(path_refusal("M0 0 L1e30 0"), Contains("finite coordinate"));
  CHECK_THAT(path_refusal("M0 0 L1e999 0"), Contains("a number"));
  CHECK_THAT(path_refusal("M0 0 Lnan 0"), Contains("a number"));
  CHECK_THAT(path_refusal("M0 0 1 0 1 1 z 2 2"), Contains("a command"));
  // Too many pieces for what is there.
  std::string knot = "M0 0";
  for (int k = 0; k < 3000; ++k) knot += "c9 9 -9 9 0 0";
  CHECK_THAT(test::refusal([&] { io::parse_path(knot, "a.txt", {.flatness = 1e-8}); }),
             Contains("fewer curves"));
}

TEST_CASE("files are read, and those that are none refused", "[io]") {
  const Directory directory;
  const auto path = directory.path / "a.stl";
  std::ofstream(path, std::ios::binary) << test::binary_stl(test::box({0, 0, 0}, {1, 1, 1}));
  CHECK(io::read_stl(path).size() == 12);
  std::ofstream(directory.path / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  CHECK(io::read_obj(directory.path / "a.obj").size() == 1);
  std::ofstream(directory.path / "a.txt") << "0 0\n1 0\n0 1\n";
  CHECK(io::read_path(directory.path / "a.txt", {.unit = 3}).points[1][0] == 3);
  const auto refusal = [](const std::filesystem::path& file) {
    return test::refusal([&] { io::read_stl(file); });
  };
  CHECK_THAT(refusal(directory.path / "b.stl"),
             StartsWith("cannot read ") && Contains("no such file"));
  CHECK_THAT(refusal(directory.path), Contains("must be a file"));
  CHECK_THAT(refusal("/dev/zero"), Contains("must be a file"));
  std::ofstream(directory.path / "empty.stl");
  CHECK_THAT(refusal(directory.path / "empty.stl"), Contains("it is empty"));
  try {
    io::read_obj(directory.path / "b.obj");
    FAIL("read");
  } catch (const InvalidInput& error) {
    CHECK(error.id == "E150");
  }
}
