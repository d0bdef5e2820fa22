// SPDX-License-Identifier: MIT
#include "sphmbs/io/vtp.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"

namespace {

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_vtp_" + std::to_string(std::random_device{}()));
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

std::string attribute(const std::string& element, const std::string& name) {
  const std::string key = " " + name + "=\"";
  const std::size_t start = element.find(key);
  REQUIRE(start != std::string::npos);
  const std::size_t value = start + key.size();
  return element.substr(value, element.find('"', value) - value);
}

// The start tag that holds `text`.
std::string tag(const std::string& file, const std::string& text) {
  const std::size_t at = file.find(text);
  REQUIRE(at != std::string::npos);
  const std::size_t start = file.rfind('<', at);
  return file.substr(start, file.find('>', at) - start);
}

struct Block {
  std::string type;
  int components = 0;
  std::string bytes;
  std::size_t end = 0;  // position in the file
};

Block block(const std::string& file, const std::string& name) {
  const std::string element = tag(file, "Name=\"" + name + "\"");
  REQUIRE(attribute(element, "format") == "appended");
  const std::string marker = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t start =
      file.find(marker) + marker.size() + std::stoul(attribute(element, "offset"));
  REQUIRE(start + sizeof(std::uint64_t) <= file.size());
  std::uint64_t length = 0;
  std::memcpy(&length, file.data() + start, sizeof length);
  REQUIRE(start + sizeof length + length <= file.size());
  return {.type = attribute(element, "type"),
          .components = std::stoi(attribute(element, "NumberOfComponents")),
          .bytes = file.substr(start + sizeof length, length),
          .end = start + sizeof length + length};
}

template <class T>
bool bit_equal(const Block& read, const std::vector<T>& written) {
  return read.bytes.size() == written.size() * sizeof(T) &&
         std::memcmp(read.bytes.data(), written.data(), read.bytes.size()) == 0;
}

template <class Exception, class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "no exception of this type";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a vtp file holds points, arrays and time bit for bit", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "state.vtp";
  const std::vector<std::array<double, 2>> positions{{0.1, -0.0}, {1e-310, 2.0}, {3.0, 1e300}};
  const std::vector<double> points = sphmbs::io::points_xyz<2>(positions);
  const std::vector<double> pressure{101325.0, std::nan(""),
                                     std::numeric_limits<double>::infinity()};
  const std::vector<float> velocity{1.0F, 2.0F, 0.0F, -3.5F, 4.0F, 0.0F, 5.0F, 6.0F, 0.0F};
  const std::vector<std::int32_t> body{-1, 0, std::numeric_limits<std::int32_t>::max()};
  const std::vector<std::uint8_t> kind{0, 127, 255};
  const std::vector<sphmbs::io::PointArray> arrays{
      {.name = "p [Pa]", .values = pressure},
      {.name = "velocity", .components = 3, .values = velocity},
      {.name = "body", .values = body},
      {.name = "kind", .values = kind}};
  sphmbs::io::write_vtp(path, points, arrays, 0.1);

  const std::string file = content(path);
  CHECK(file.starts_with("<?xml version=\"1.0\"?>"));
  const std::string root = tag(file, "<VTKFile");
  CHECK(attribute(root, "type") == "PolyData");
  CHECK(attribute(root, "byte_order") == "LittleEndian");
  CHECK(attribute(root, "header_type") == "UInt64");
  const std::string piece = tag(file, "<Piece");
  CHECK(attribute(piece, "NumberOfPoints") == "3");
  CHECK(attribute(piece, "NumberOfVerts") == "3");

  const Block time = block(file, "TimeValue");
  CHECK(time.type == "Float64");
  CHECK(bit_equal(time, std::vector<double>{0.1}));
  CHECK(attribute(tag(file, "TimeValue"), "NumberOfTuples") == "1");
  CHECK(file.find("TimeValue") < file.find("</FieldData>"));

  const Block read_points = block(file, "Points");
  CHECK(read_points.type == "Float64");
  CHECK(read_points.components == 3);
  CHECK(bit_equal(read_points,
                  std::vector<double>{0.1, -0.0, 0.0, 1e-310, 2.0, 0.0, 3.0, 1e300, 0.0}));

  CHECK(block(file, "p [Pa]").type == "Float64");
  CHECK(bit_equal(block(file, "p [Pa]"), pressure));
  CHECK(block(file, "velocity").type == "Float32");
  CHECK(block(file, "velocity").components == 3);
  CHECK(bit_equal(block(file, "velocity"), velocity));
  CHECK(block(file, "body").type == "Int32");
  CHECK(bit_equal(block(file, "body"), body));
  CHECK(block(file, "kind").type == "UInt8");
  CHECK(bit_equal(block(file, "kind"), kind));

  CHECK(block(file, "connectivity").type == "Int64");
  CHECK(bit_equal(block(file, "connectivity"), std::vector<std::int64_t>{0, 1, 2}));
  CHECK(bit_equal(block(file, "offsets"), std::vector<std::int64_t>{1, 2, 3}));
  CHECK(file.substr(block(file, "offsets").end) == "\n</AppendedData>\n</VTKFile>\n");
  CHECK_FALSE(std::filesystem::exists(directory.path / "state.vtp.tmp"));
}

TEST_CASE("a vtp file without particles is complete", "[io]") {
  const Directory directory;
  sphmbs::io::write_vtp(directory.path / "empty.vtp", {}, {}, 2.0);
  const std::string file = content(directory.path / "empty.vtp");
  CHECK(attribute(tag(file, "<Piece"), "NumberOfPoints") == "0");
  CHECK(block(file, "Points").bytes.empty());
  CHECK(file.ends_with("</VTKFile>\n"));
}

TEST_CASE("a vtp file of a mesh holds its lines and polygons", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "mesh.vtp";
  sphmbs::io::Mesh mesh;
  for (int k = 0; k < 7; ++k) mesh.points.insert(mesh.points.end(), {0.5 * k, 1.0 * k * k, -1.0});
  mesh.lines.add_row(0, 3);
  mesh.lines.add({6, 0});
  mesh.polygons.add({3, 4, 5, 6});
  mesh.arrays = {{"number", 1, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6}}};
  sphmbs::io::write_vtp(path, mesh, 0.25);

  const std::string file = content(path);
  const std::string piece = tag(file, "<Piece");
  CHECK(attribute(piece, "NumberOfPoints") == "7");
  CHECK(attribute(piece, "NumberOfVerts") == "0");
  CHECK(attribute(piece, "NumberOfLines") == "2");
  CHECK(attribute(piece, "NumberOfStrips") == "0");
  CHECK(attribute(piece, "NumberOfPolys") == "1");
  CHECK(bit_equal(block(file, "TimeValue"), std::vector<double>{0.25}));
  CHECK(bit_equal(block(file, "Points"), mesh.points));
  CHECK(bit_equal(block(file, "number"), std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6}));
  const std::string lines = file.substr(file.find("<Lines>"));
  const std::string polygons = file.substr(file.find("<Polys>"));
  const auto in_section = [&](const std::string& section, const std::string& name) {
    return block(
               tag(section, "Name=\"" + name + "\"") + ">" + file.substr(file.find("</PolyData>")),
               name)
        .bytes;
  };
  const auto bytes = [](const std::vector<std::int64_t>& values) {
    return std::string(reinterpret_cast<const char*>(values.data()),
                       values.size() * sizeof(std::int64_t));
  };
  CHECK(in_section(lines, "connectivity") == bytes({0, 1, 2, 6, 0}));
  CHECK(in_section(lines, "offsets") == bytes({3, 5}));
  CHECK(in_section(polygons, "connectivity") == bytes({3, 4, 5, 6}));
  CHECK(in_section(polygons, "offsets") == bytes({4}));
  CHECK(file.ends_with("\n</AppendedData>\n</VTKFile>\n"));
}

TEST_CASE("write_vtp refuses cells between points that are not there", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "wrong.vtp";
  sphmbs::io::Mesh good{.points = std::vector<double>(6, 0.0)};
  good.lines.add_row(0, 2);
  for (const std::int64_t point : {-1, 2}) {
    sphmbs::io::Mesh mesh = good;
    mesh.polygons.add({0, 1, point});
    CHECK_THAT(message_of<std::invalid_argument>([&] { sphmbs::io::write_vtp(path, mesh, 0.0); }),
               Catch::Matchers::Contains("polygons do not fit to the 2 points"));
  }
  for (const std::int64_t end : {1, 3}) {
    sphmbs::io::Mesh mesh = good;
    mesh.lines.offsets = {end};
    CHECK_THROWS_AS(sphmbs::io::write_vtp(path, mesh, 0.0), std::invalid_argument);
  }
  CHECK_FALSE(std::filesystem::exists(path));
  CHECK_NOTHROW(sphmbs::io::write_vtp(path, good, 0.0));
}

TEST_CASE("names in a vtp file are escaped", "[io]") {
  const Directory directory;
  const std::vector<sphmbs::io::PointArray> arrays{
      {.name = "a<b> & \"c'", .values = std::vector<double>{1.0}}};
  sphmbs::io::write_vtp(directory.path / "names.vtp", std::vector<double>{0.0, 0.0, 0.0}, arrays,
                        0.0);
  CHECK(contains(content(directory.path / "names.vtp"), "Name=\"a&lt;b&gt; &amp; &quot;c&apos;\""));
}

TEST_CASE("points are padded to three components", "[io]") {
  CHECK(sphmbs::io::points_xyz<1>(std::vector<std::array<double, 1>>{{4.0}, {5.0}}) ==
        std::vector<double>{4.0, 0.0, 0.0, 5.0, 0.0, 0.0});
  CHECK(sphmbs::io::points_xyz<3>(std::vector<std::array<double, 3>>{{1.0, 2.0, 3.0}}) ==
        std::vector<double>{1.0, 2.0, 3.0});
  const std::vector<double> x{1.0, 2.0};
  const std::vector<double> y{3.0, 4.0};
  CHECK(sphmbs::io::points_xyz(x, y) == std::vector<double>{1.0, 3.0, 0.0, 2.0, 4.0, 0.0});
  CHECK_THROWS_AS(sphmbs::io::points_xyz(x, std::vector<double>{3.0}), std::invalid_argument);
}

TEST_CASE("write_vtp refuses arrays of the wrong length", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "wrong.vtp";
  const std::vector<double> points(6, 0.0);
  const std::vector<sphmbs::io::PointArray> arrays{
      {.name = "velocity", .components = 3, .values = std::vector<float>(5)}};
  const std::string message =
      message_of<std::invalid_argument>([&] { sphmbs::io::write_vtp(path, points, arrays, 0.0); });
  CHECK(contains(message, "\"velocity\" has 5 values, expected 6"));

  const std::vector<sphmbs::io::PointArray> no_components{{.name = "p", .components = 0}};
  CHECK_THROWS_AS(sphmbs::io::write_vtp(path, points, no_components, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(sphmbs::io::write_vtp(path, std::vector<double>(4), {}, 0.0),
                  std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("write_vtp reports path and reason and keeps the earlier file", "[io]") {
  const Directory directory;
  const std::filesystem::path missing = directory.path / "missing" / "state.vtp";
  const std::string message =
      message_of<sphmbs::OutputError>([&] { sphmbs::io::write_vtp(missing, {}, {}, 0.0); });
  CHECK(contains(message, missing.string()));
  CHECK(contains(message, "No such file or directory"));

  const std::filesystem::path occupied = directory.path / "occupied.vtp";
  std::filesystem::create_directories(occupied / "inside");
  CHECK_THROWS_AS(sphmbs::io::write_vtp(occupied, {}, {}, 0.0), sphmbs::OutputError);
  CHECK_FALSE(std::filesystem::exists(directory.path / "occupied.vtp.tmp"));

  if (!std::filesystem::exists("/dev/full")) return;
  const std::filesystem::path state = directory.path / "state.vtp";
  sphmbs::io::write_vtp(state, {}, {}, 1.0);
  const std::string before = content(state);
  std::filesystem::create_symlink("/dev/full", directory.path / "state.vtp.tmp");
  const std::string full = message_of<sphmbs::OutputError>(
      [&] { sphmbs::io::write_vtp(state, std::vector<double>(30000, 1.0), {}, 2.0); });
  CHECK(contains(full, state.string()));
  CHECK(contains(full, "No space left on device"));
  CHECK(content(state) == before);
  CHECK_FALSE(std::filesystem::is_symlink(directory.path / "state.vtp.tmp"));
}
