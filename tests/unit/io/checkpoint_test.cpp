// SPDX-License-Identifier: MIT
// The container of checkpoints: what was written is read, and any damage is refused.
#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

#include <Eigen/Core>

#include <sphmbs/io/checkpoints.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

namespace fs = std::filesystem;
using namespace sphmbs;

struct Part {
  double x = 0;
  Vec<2> v{};
  template <Archive A>
  void visit_state(A& archive) {
    archive("x", x);
    archive("v", v);
  }
};

/// One of each kind of thing that a state is made of.
struct Everything {
  double number = 0;
  bool flag = false;
  std::uint64_t count = 0;
  std::string text;
  std::vector<double> list;
  std::array<double, 3> fixed{};
  Eigen::VectorXd vector;
  Eigen::MatrixXd matrix;
  std::map<int, std::set<std::uint32_t>> map;
  std::deque<Part> parts;
  std::pair<int, double> pair;

  template <Archive A>
  void visit_state(A& archive) {
    archive("number", number);
    archive("flag", flag);
    archive("count", count);
    archive("text", text);
    archive("list", list);
    archive("fixed", fixed);
    archive("vector", vector);
    archive("matrix", matrix);
    archive("map", map);
    archive("parts", parts);
    archive("pair", pair);
  }
};

struct Fails {
  template <Archive A>
  void visit_state(A&) {
    throw OutputError("no");
  }
};

Everything example() {
  Everything e{.number = 0.1,
               .flag = true,
               .count = 1u << 31,
               .text = "two\nlines",
               .list = {1, 2, 3},
               .fixed = {4, 5, 6},
               .vector = Eigen::VectorXd::LinSpaced(4, 0, 1),
               .matrix = Eigen::MatrixXd::Identity(2, 3),
               .map = {{-1, {7, 8}}, {2, {}}},
               .parts = {},
               .pair = {3, 0.3}};
  e.parts.push_back({1.5, {2, 3}});
  e.parts.push_back({2.5, {4, 5}});
  return e;
}

/// A directory that is gone with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("sphmbs_checkpoints_" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

fs::path write(io::Checkpoints& checkpoints, std::uint64_t step, Everything state = example()) {
  return checkpoints.write(step, {{"dimension", "2"}},
                           [&](io::StateWriter& archive) { archive("state", state); });
}

std::vector<char> contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void put(const fs::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
}

std::string refusal(const fs::path& path) {
  return test::complaint<RefusedCheckpoint>([&] { io::CheckpointFile{path}; });
}

}  // namespace

TEST_CASE("CRC-64 has the value of its definition", "[io]") {
  const std::string digits = "123456789";
  io::Crc64 crc;
  crc.add(std::as_bytes(std::span(digits)));
  CHECK(crc.value() == 0x995dc9bbdf1939faull);
  io::Crc64 pieces;  // across the eight bytes that are taken at a time
  pieces.add(std::as_bytes(std::span(digits).first(2)));
  pieces.add(std::as_bytes(std::span(digits).subspan(2)));
  CHECK(pieces.value() == crc.value());
}

TEST_CASE("a state is restored from a checkpoint", "[io]") {
  const Folder folder;
  io::Checkpoints checkpoints(folder.path);
  io::CheckpointFile file(write(checkpoints, 7));
  CHECK(io::Checkpoints::identity_of(file) == io::Identity{{"dimension", "2"}});
  Everything restored;
  io::StateReader reader(file);
  reader("state", restored);
  const Everything expected = example();
  CHECK(restored.number == expected.number);
  CHECK(restored.flag);
  CHECK(restored.count == expected.count);
  CHECK(restored.text == expected.text);
  CHECK(restored.list == expected.list);
  CHECK(restored.fixed == expected.fixed);
  CHECK(restored.vector == expected.vector);
  CHECK(restored.matrix == expected.matrix);
  CHECK(restored.map == expected.map);
  REQUIRE(restored.parts.size() == 2);
  CHECK(restored.parts[1].v[1] == 5);
  CHECK(restored.pair == expected.pair);
}

TEST_CASE("checkpoints: two stay, and a damaged one gives way to the one before", "[io][fault]") {
  const Folder folder;
  io::Checkpoints checkpoints(folder.path);
  for (const std::uint64_t step : {9u, 10u, 1000u}) write(checkpoints, step);
  REQUIRE(checkpoints.list().size() == 2);
  const fs::path newest = checkpoints.list()[0];
  CHECK(newest.filename() == "step_00000000000000001000.ckpt");
  auto bytes = contents(newest);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  put(newest, bytes);
  std::vector<std::string> skipped;
  const auto found = checkpoints.newest(skipped);
  REQUIRE(found);
  CHECK(found->path().filename() == "step_00000000000000000010.ckpt");
  REQUIRE(skipped.size() == 1);
  CHECK_THAT(skipped[0], Catch::Contains("checksum of section"));
}

TEST_CASE("no damage to a checkpoint goes unnoticed", "[io][fault]") {
  const Folder folder;
  io::Checkpoints checkpoints(folder.path);
  const fs::path path = write(checkpoints, 1);
  Everything other = example();
  other.number = 0.2;
  const auto good = contents(path), next = contents(write(checkpoints, 2, other));
  const fs::path bad = folder.path / "bad.ckpt";
  std::mt19937 random(1);
  const auto any = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto refused = [&](const std::vector<char>& bytes, const std::string& why) {
    put(bad, bytes);
    const std::string message = refusal(bad);
    REQUIRE(message.starts_with("checkpoint " + bad.string() + ": "));
    REQUIRE_THAT(message, Catch::Matches(".*(" + why + ").*"));
  };
  const std::string any_reason =
      "checksum of|truncated|not a checkpoint|written in format|trailing bytes";
  for (int trial = 0; trial < 2000; ++trial) {  // one bit
    auto bytes = good;
    bytes[any(bytes.size())] ^= static_cast<char>(1 << any(8));
    refused(bytes, any_reason);
  }
  const auto numbers = io::CheckpointFile(path).section("state/list", "f64");
  for (std::uint64_t k = 0; k < numbers.bytes; ++k) {  // within the data of a section
    auto bytes = good;
    bytes[static_cast<std::size_t>(numbers.begin) + k] ^= 1;
    refused(bytes, "checksum of section state/list");
  }
  for (int trial = 0; trial < 500; ++trial)
    refused({good.begin(), good.begin() + static_cast<long>(any(good.size()))},
            "truncated|not a checkpoint");
  for (int trial = 0; trial < 500; ++trial) {  // a page of zeros
    auto bytes = good;
    const std::size_t begin = any(bytes.size() - 64);
    std::fill_n(bytes.begin() + static_cast<long>(begin), 64, '\0');
    if (bytes != good) refused(bytes, any_reason);
  }
  for (int trial = 0; trial < 200; ++trial) {  // appended
    auto bytes = good;
    bytes.insert(bytes.end(), 1 + any(100), static_cast<char>(any(256)));
    refused(bytes, "trailing bytes");
  }
  REQUIRE(good.size() == next.size());
  for (int trial = 0; trial < 200; ++trial) {  // the end of another one
    const auto cut = static_cast<long>(16 + any(good.size() - 32));
    std::vector<char> bytes(good.begin(), good.begin() + cut);
    bytes.insert(bytes.end(), next.begin() + cut, next.end());
    if (bytes != good && bytes != next) refused(bytes, "checksum of");
  }
}

TEST_CASE("checkpoints of another run or format are refused with both values", "[io][fault]") {
  const Folder folder;
  io::Checkpoints checkpoints(folder.path);
  const fs::path path = write(checkpoints, 1);
  io::CheckpointFile file(path);
  const io::Identity saved = io::Checkpoints::identity_of(file);
  CHECK_NOTHROW(io::require_same_identity(file, saved, {{"dimension", "2"}}));
  CHECK_THAT(test::complaint<RefusedCheckpoint>([&] {
               io::require_same_identity(file, saved, {{"dimension", "3"}, {"run.until", "1"}});
             }),
             Catch::EndsWith("belongs to another run: dimension was 2 and is 3; run.until was not "
                             "given and is 1"));
  CHECK_NOTHROW(
      io::require_same_identity(file, saved, {{"dimension", "2"}, {"run.until", "1"}},
                                [](const std::string& name) { return name == "run.until"; }));
  double number = 0;
  io::StateReader reader(file);
  CHECK_THAT(test::complaint<RefusedCheckpoint>([&] { reader("other", number); }),
             Catch::EndsWith("has no section other"));
  float single = 0;
  CHECK_THAT(test::complaint<RefusedCheckpoint>([&] { reader("state/number", single); }),
             Catch::EndsWith("section state/number has the type f64, not f32"));
  std::array<double, 4> four{};
  CHECK_THAT(test::complaint<RefusedCheckpoint>([&] { reader("state/fixed", four); }),
             Catch::EndsWith("section state/fixed has 3 numbers, not 4"));

  auto bytes = contents(path);
  bytes[8] = 2;  // the format
  put(path, bytes);
  CHECK_THAT(refusal(path), Catch::EndsWith("written in format 2, this program reads format 1"));
}

TEST_CASE("a checkpoint that cannot be written leaves the ones before and no other file",
          "[io][fault]") {
  const Folder folder;
  io::Checkpoints checkpoints(folder.path / "checkpoint");
  write(checkpoints, 1);
  const auto files = [&] {
    return std::distance(fs::directory_iterator(checkpoints.folder()), fs::directory_iterator());
  };
  Fails fails;
  CHECK_THROWS_AS(checkpoints.write(2, {}, [&](io::StateWriter& w) { w("state", fails); }),
                  OutputError);
  CHECK(files() == 1);
  io::Checkpoints nowhere("/dev/null/checkpoint");
  CHECK_THAT(test::complaint<OutputError>([&] { write(nowhere, 1); }),
             Catch::Contains("/dev/null/checkpoint"));
}
