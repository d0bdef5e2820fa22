// SPDX-License-Identifier: MIT
#include "sphmbs/io/pvd.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"

namespace {

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_pvd_" + std::to_string(std::random_device{}()));
  Directory() { std::filesystem::create_directories(path); }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

using Entries = std::vector<std::pair<double, std::string>>;

// Times and files of a list; fails if the list is not complete.
Entries entries(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  REQUIRE(stream.is_open());
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  REQUIRE(text.starts_with("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\""));
  REQUIRE(text.ends_with("</Collection>\n</VTKFile>\n"));
  Entries found;
  for (std::size_t at = text.find("<DataSet "); at != std::string::npos;
       at = text.find("<DataSet ", at + 1)) {
    const std::string element = text.substr(at, text.find('\n', at) - at);
    REQUIRE(element.ends_with("/>"));
    const auto attribute = [&element](const std::string& name) {
      const std::size_t start = element.find(name + "=\"") + name.size() + 2;
      return element.substr(start, element.find('"', start) - start);
    };
    found.emplace_back(std::stod(attribute("timestep")), attribute("file"));
  }
  return found;
}

}  // namespace

TEST_CASE("a pvd list is valid after each addition", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.pvd";
  sphmbs::io::PvdCollection collection(path);
  CHECK(entries(path).empty());

  Entries expected;
  for (int i = 0; i < 20; ++i) {
    expected.emplace_back(i / 3.0 * 1e-5, "states/state_" + std::to_string(i) + ".vtp");
    collection.add(expected.back().first, expected.back().second);
    CHECK(entries(path) == expected);
    CHECK_FALSE(std::filesystem::exists(directory.path / "run.pvd.tmp"));
  }
}

TEST_CASE("a new pvd list replaces an earlier one", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.pvd";
  sphmbs::io::PvdCollection(path).add(1.0, "old.vtp");
  sphmbs::io::PvdCollection(path).add(2.0, "a&b.vtp");
  CHECK(entries(path) == Entries{{2.0, "a&amp;b.vtp"}});
}

TEST_CASE("a pvd list refuses times that are not finite", "[io]") {
  const Directory directory;
  sphmbs::io::PvdCollection collection(directory.path / "run.pvd");
  CHECK_THROWS_AS(collection.add(std::nan(""), "a.vtp"), std::invalid_argument);
  CHECK(entries(directory.path / "run.pvd").empty());
}

TEST_CASE("a pvd list that cannot be written is reported at once", "[io]") {
  const Directory directory;
  CHECK_THROWS_AS(sphmbs::io::PvdCollection(directory.path / "missing" / "run.pvd"),
                  sphmbs::OutputError);
}

TEST_CASE("files of one time in a pvd list are told apart by their parts", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.pvd";
  sphmbs::io::PvdCollection collection(path);
  collection.add(0.5, "fields_0001.vtp");
  collection.add(0.5, "bodies_0001.vtp", 1);
  CHECK(entries(path) == Entries{{0.5, "fields_0001.vtp"}, {0.5, "bodies_0001.vtp"}});
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  CHECK(text.find("part=\"0\" file=\"fields_0001.vtp\"") != std::string::npos);
  CHECK(text.find("part=\"1\" file=\"bodies_0001.vtp\"") != std::string::npos);
}

TEST_CASE("a list that a checkpoint will restore leaves the earlier one alone until then", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.pvd";
  sphmbs::io::PvdCollection(path).add(1, "a.vtp");
  sphmbs::io::PvdCollection again(path, sphmbs::io::PvdCollection::Restored{});
  CHECK(entries(path) == Entries{{1, "a.vtp"}});
}

TEST_CASE("a file that could not be listed is not listed later", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "run.pvd";
  sphmbs::io::PvdCollection collection(path);
  std::filesystem::create_directory(directory.path / "run.pvd.tmp");  // where the list is written
  CHECK_THROWS_AS(collection.add(1, "a.vtp"), sphmbs::OutputError);
  std::filesystem::remove(directory.path / "run.pvd.tmp");
  collection.add(2, "b.vtp");
  CHECK(entries(path) == Entries{{2, "b.vtp"}});
}
