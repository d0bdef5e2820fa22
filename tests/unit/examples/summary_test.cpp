// SPDX-License-Identifier: MIT
#include "support/summary.hpp"

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"

namespace sphmbs::examples {
namespace {

namespace fs = std::filesystem;

struct Scratch {
  fs::path path = fs::temp_directory_path() / ("sphmbs_summary_" + std::to_string(::getpid()));

  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

nlohmann::ordered_json read(const fs::path& path) {
  std::ifstream file(path);
  return nlohmann::ordered_json::parse(file);
}

Summary example() {
  return {.case_name = "gas_cylinder",
          .backend = "openmp",
          .threads = 2,
          .particles = {.gas = 18681, .virtual_particles = 640},
          .steps = 1000,
          .time_end = 1.0,
          .wall_seconds = 12.5,
          .phases = {{"neighbours", 2.0}, {"rates", 10.0}},
          .pair_interactions = 1'000'000'000,
          .peak_memory_bytes = 9'437'184,
          .conservation = {.mass = 0.0, .momentum = 3e-13, .energy = 2e-6},
          .incidents = {.retries = 2},
          .results = {{"drag", 1.25, 1.2, "N/m"}, {"lift", 0.1}}};
}

}  // namespace

TEST_CASE("the summary has exactly the agreed keys and values") {
  const Scratch scratch;
  const fs::path path = scratch.path / "summary.json";
  write_summary(path, example());
  const auto json = read(path);

  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  CHECK(keys == std::vector<std::string>{
                    "case", "version", "backend", "threads", "particles", "steps", "time_end",
                    "wall_seconds", "phases", "pair_interactions", "pair_interactions_per_second",
                    "peak_memory_bytes", "conservation", "incidents", "results"});
  CHECK(json["case"] == "gas_cylinder");
  CHECK(json["version"] == std::string(version));
  CHECK(json["particles"].dump() == R"({"gas":18681,"virtual":640})");
  CHECK(json["phases"].dump() == R"({"neighbours":2.0,"rates":10.0})");
  CHECK(json["pair_interactions"] == 1'000'000'000);
  CHECK(json["pair_interactions_per_second"] == 8e7);
  CHECK(json["conservation"].dump() == R"({"mass":0.0,"momentum":3e-13,"energy":2e-06})");
  CHECK(json["incidents"].dump() ==
        R"({"particles_lost":0,"steps_retried":2,"reconstructions_refused":0})");
  CHECK(json["results"].dump() == R"({"drag":{"value":1.25,"reference":1.2,"unit":"N/m"},)"
                                  R"("lift":{"value":0.1,"reference":null,"unit":"-"}})");
  CHECK_FALSE(fs::exists(scratch.path / "summary.json.tmp"));
}

TEST_CASE("numbers that are not finite are null and no lists are empty objects") {
  const Scratch scratch;
  const fs::path path = scratch.path / "summary.json";
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  write_summary(path, {.case_name = "bad \xff name",
                       .conservation = {.mass = nan, .momentum = infinity},
                       .results = {{"lost", nan, nan, "m"}}});
  const auto json = read(path);
  CHECK(json["conservation"]["mass"].is_null());
  CHECK(json["conservation"]["momentum"].is_null());
  CHECK(json["results"]["lost"]["value"].is_null());
  CHECK(json["results"]["lost"]["reference"].is_null());
  CHECK(json["phases"].is_object());
  CHECK(json["pair_interactions_per_second"] == 0.0);
}

TEST_CASE("a summary that cannot be written throws and keeps the earlier file") {
  const Scratch scratch;
  const fs::path missing = scratch.path / "missing" / "summary.json";
  CHECK_THROWS_AS(write_summary(missing, example()), OutputError);
  CHECK_THROWS_WITH(write_summary(missing, example()),
                    "cannot write " + missing.string() + ": No such file or directory");

  const fs::path path = scratch.path / "summary.json";
  write_summary(path, example());
  fs::create_directory(scratch.path / "summary.json.tmp");
  Summary later = example();
  later.steps = 2000;
  CHECK_THROWS_AS(write_summary(path, later), OutputError);
  CHECK(read(path)["steps"] == 1000);
}

TEST_CASE("a summary replaces the earlier one") {
  const Scratch scratch;
  const fs::path path = scratch.path / "summary.json";
  write_summary(path, example());
  Summary later = example();
  later.steps = 2000;
  write_summary(path, later);
  CHECK(read(path)["steps"] == 2000);
}

TEST_CASE("the peak memory grows with what is used") {
  const std::uint64_t before = peak_memory();
  CHECK(before > 1024 * 1024);
  const std::vector<char> block(before + 64 * 1024 * 1024, 'x');
  CHECK(block.back() == 'x');
  CHECK(peak_memory() > before + 32 * 1024 * 1024);
}

}  // namespace sphmbs::examples
