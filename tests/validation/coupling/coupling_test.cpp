// SPDX-License-Identifier: MIT
// Coupled problems with exact solutions, as users run them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

/// The results of a run, by name, with their references.
class Results {
 public:
  Results(const char* program, std::vector<std::string> words) {
    words.insert(words.end(), {"--quiet", "--output", "run"});
    const test::Scratch scratch;
    const auto ended = test::start(scratch, program, words);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const auto folder = scratch.work() / "run";
    const bool coupled = std::find(words.begin(), words.end(), "--rigid") == words.end();
    for (const char* name : {"fields_0004.vtp", "history.png"})
      CHECK(std::filesystem::exists(folder / name));
    for (const char* name : {"scene.pvd", "bodies_0004.vtp"})
      CHECK(std::filesystem::exists(folder / name) == coupled);
    summary = nlohmann::ordered_json::parse(test::text_of(folder / "summary.json"));
  }

  double of(const std::string& name) const {
    return summary["results"][name]["value"].get<double>();
  }
  /// Relative difference from the reference.
  double error(const std::string& name) const {
    return of(name) / summary["results"][name]["reference"].get<double>() - 1;
  }
  double conserved(const std::string& name) const {
    return std::abs(summary["conservation"][name].get<double>());
  }

 private:
  nlohmann::ordered_json summary;
};

}  // namespace

TEST_CASE("Lagrange's gun follows the exact motion", "[lagrange_gun]") {
  for (const std::string coupling : {"staggered", "strong"})
    for (const std::string scheme : {"paper", "best"}) {
      CAPTURE(coupling, scheme);
      const auto run = [&](const std::string& spacing) {
        return Results(SPHMBS_LAGRANGE_GUN,
                       {"--spacing", spacing, "--coupling", coupling, "--scheme", scheme});
      };
      const Results coarse = run("0.015"), fine = run("0.0075");
      CHECK(std::abs(fine.error("speed")) < (scheme == "best" ? 1e-3 : 5e-3));
      CHECK(std::abs(fine.error("way")) < (scheme == "best" ? 1e-3 : 5e-3));
      CHECK(std::abs(fine.error("speed")) < 0.8 * std::abs(coarse.error("speed")));
      CHECK(fine.conserved("mass") == 0);
      CHECK(fine.conserved("momentum") < 1e-13);
      const double lost = std::abs(fine.of("work_lost_between_gas_and_bodies"));
      CHECK(lost < (coupling == "strong" ? 1e-11 : 1e-5));
    }
}

TEST_CASE("Lagrange's gun in the plane is the same", "[lagrange_gun]") {
  const Results run(SPHMBS_LAGRANGE_GUN_2D, {"--spacing", "0.015", "--threads", "2"});
  CHECK(std::abs(run.error("speed")) < 2e-3);
  CHECK(std::abs(run.error("way")) < 2e-3);
  CHECK(run.conserved("momentum") < 1e-13);
}

TEST_CASE("a gas spring swings with its exact period", "[gas_spring][slow]") {
  for (const std::string coupling : {"staggered", "strong"}) {
    CAPTURE(coupling);
    const Results run(SPHMBS_GAS_SPRING, {"--coupling", coupling});
    CHECK(std::abs(run.error("period")) < 2e-3);
    CHECK(run.of("largest_change_of_energy") < 1e-6);
    CHECK(run.conserved("energy") < 1e-8);
  }
}

TEST_CASE("gas resists a cylinder's acceleration as linear acoustics says",
          "[accelerated_cylinder]") {
  const Results run(SPHMBS_ACCELERATED_CYLINDER,
                    {"--spacing", "0.1", "--until", "4", "--threads", "2"});
  CHECK(std::abs(run.error("force_at_1.05")) < 0.02);
  CHECK(std::abs(run.error("force_at_3.15")) < 0.04);
  CHECK(run.of("largest_difference_from_0.5") < 0.08);
}

TEST_CASE("an impulse leaves a cylinder and the gas it displaces with one speed",
          "[accelerated_cylinder][slow]") {
  // The lighter the cylinder, the more of its motion is the gas's.
  for (const auto& [ratio, spacing] :
       {std::pair<std::string, std::string>("10", "0.1"), {"1", "0.1"}, {"0.1", "0.05"}}) {
    CAPTURE(ratio);
    const Results run(SPHMBS_ACCELERATED_CYLINDER,
                      {"--drive", "impulse", "--mass-ratio", ratio, "--spacing", spacing, "--until",
                       "8", "--threads", "2"});
    CHECK(std::abs(run.error("speed_in_the_long_run")) < 0.05);
    CHECK(run.of("largest_difference_from_0.5") < 0.03);
  }
}

TEST_CASE("a panel bends under a shock as an independent solution says", "[shock_panel]") {
  const Results run(SPHMBS_SHOCK_PANEL,
                    {"--spacing", "0.0025", "--until", "1.6e-3", "--threads", "2"});
  CHECK(std::abs(run.error("first_maximum")) < 0.15);
  CHECK(std::abs(run.error("time_of_first_maximum")) < 0.02);
  CHECK(std::abs(run.error("mean_force_0.3_to_1.3ms")) < 0.06);
  CHECK(run.conserved("mass") < 1e-13);
  CHECK(run.conserved("momentum") < 1e-13);
}

TEST_CASE("a panel under a shock converges to the independent solution", "[shock_panel][slow]") {
  // To its limit on fine grids.
  std::map<std::string, Results> runs;
  for (const std::string spacing : {"0.005", "0.002"})
    runs.emplace(spacing, Results(SPHMBS_SHOCK_PANEL,
                                  {"--spacing", spacing, "--until", "1.6e-3", "--threads", "2"}));
  const Results &coarse = runs.at("0.005"), &fine = runs.at("0.002");
  CHECK(std::abs(fine.error("first_maximum")) < 0.08);
  CHECK(std::abs(fine.error("first_maximum")) < 0.7 * std::abs(coarse.error("first_maximum")));
  CHECK(std::abs(fine.error("time_of_first_maximum")) < 0.01);
  CHECK(std::abs(fine.error("mean_force_0.3_to_1.3ms")) < 0.03);
  const Results rigid(SPHMBS_SHOCK_PANEL,
                      {"--rigid", "--spacing", "0.002", "--until", "1.4e-3", "--threads", "2"});
  CHECK(std::abs(rigid.error("mean_force_0.3_to_1.3ms")) < 0.03);
  CHECK(std::abs(rigid.error("impulse_to_1ms")) < 0.03);
}

TEST_CASE("coupled programs leave the same on 1, 2 and 4 threads", "[coupling]") {
  using Words = std::vector<std::string>;
  const auto [program, words] = GENERATE(
      std::pair<const char*, Words>(SPHMBS_LAGRANGE_GUN, {"--spacing", "0.03", "--until", "0.1"}),
      std::pair<const char*, Words>(SPHMBS_LAGRANGE_GUN_2D,
                                    {"--spacing", "0.03", "--until", "0.1"}),
      std::pair<const char*, Words>(SPHMBS_GAS_SPRING, {"--spacing", "0.05", "--until", "0.3"}),
      std::pair<const char*, Words>(SPHMBS_ACCELERATED_CYLINDER,
                                    {"--spacing", "0.2", "--until", "0.3"}),
      std::pair<const char*, Words>(SPHMBS_SHOCK_PANEL, {"--spacing", "0.005", "--until", "2e-4"}),
      std::pair<const char*, Words>(
          SPHMBS_SHOCK_PANEL, {"--spacing", "0.005", "--until", "2e-4", "--coupling", "strong"}),
      std::pair<const char*, Words>(SPHMBS_PENDULUM_ON_CABLE,
                                    {"--spacing", "0.1", "--until", "0.02"}),
      std::pair<const char*, Words>(
          SPHMBS_PENDULUM_ON_CABLE,
          {"--spacing", "0.1", "--until", "0.02", "--scheme", "best", "--coupling", "strong"}),
      std::pair<const char*, Words>(SPHMBS_FALLING_PLATES,
                                    {"--until", "0.002", "--scheme", "best"}));
  CAPTURE(program, words);
  const test::Scratch scratch;
  for (const std::string threads : {"1", "2", "4"}) {
    Words all = words;
    all.insert(all.end(), {"--threads", threads, "--quiet", "--output", threads});
    const auto ended = test::start(scratch, program, all);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
  }
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.work() / "1")) {
    const auto name = entry.path().filename();
    if (name == "summary.json" || name == "used.toml" || name == "view.py")
      continue;  // hold times, threads, folder
    CAPTURE(name);
    const std::string one = test::text_of(entry.path());
    CHECK(one == test::text_of(scratch.work() / "2" / name));
    CHECK(one == test::text_of(scratch.work() / "4" / name));
    ++compared;
  }
  CHECK(compared > 10);
}

TEST_CASE("coupled programs refuse what does not fit", "[coupling]") {
  const auto refused = [](const char* program, const std::vector<std::string>& words) {
    const test::Scratch scratch;
    const auto ended = test::start(scratch, program, words);
    CHECK(ended.code == 2);
    return ended.err;
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(refused(SPHMBS_LAGRANGE_GUN, {"--spacing", "0.07"}), Contains("whole fraction of 3"));
  CHECK_THAT(refused(SPHMBS_LAGRANGE_GUN, {"--until", "3"}), Contains("2.5 s"));
  CHECK_THAT(refused(SPHMBS_GAS_SPRING, {"--mass", "0"}), Contains("--mass"));
  CHECK_THAT(refused(SPHMBS_GAS_SPRING, {"--coupling", "loose"}), Contains("staggered"));
  CHECK_THAT(refused(SPHMBS_GAS_SPRING, {"--spectral-radius", "1"}), Contains("below 1"));
  CHECK_THAT(refused(SPHMBS_SHOCK_PANEL, {"--spacing", "0.003"}), Contains("whole fraction of 50"));
  CHECK_THAT(refused(SPHMBS_SHOCK_PANEL, {"--setup", "lab"}), Contains("experiment"));
  CHECK_THAT(refused(SPHMBS_ACCELERATED_CYLINDER, {"--drive", "impuls"}), Contains("impulse"));
}
