// SPDX-License-Identifier: MIT
// What command line, report and summary say of a structure.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/guarded_main.hpp"
#include "support/history.hpp"
#include "support/integrators.hpp"
#include "support/parameters.hpp"
#include "support/report.hpp"

namespace sphmbs::examples {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

Program chain() {
  return {.name = "chain",
          .title = "a chain",
          .backends = {"openmp", "serial"},
          .defaults = {.until = 1.0, .step = 1e-3, .output = fs::temp_directory_path() / "chain"},
          .gas = false,
          .structure = true};
}

/// A program without gas, and what came out of running it.
struct Run {
  std::optional<Settings> settings{};
  std::string out{};
  std::string err{};
  int code = -1;

  explicit Run(const Words& words) {
    Parameters line(chain());
    std::vector<const char*> argv{"chain"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    std::ostringstream out_stream, err_stream;
    code = guarded_main(
        static_cast<int>(argv.size()), argv.data(), line,
        [&](const Settings& given) { settings = given; }, out_stream, err_stream);
    out = out_stream.str();
    err = err_stream.str();
  }
};

Summary example() {
  return {.case_name = "chain",
          .structure = StructureCounts{.coordinates = 40,
                                       .conditions = 21,
                                       .redundant = 1,
                                       .iterations = 3600,
                                       .factorisations = 1234,
                                       .violation = 2.5e-15},
          .steps = 1000,
          .time_end = 1.0,
          .wall_seconds = 2.0,
          .peak_memory_bytes = 9'437'184,
          .conservation = {.mass = 0.0, .momentum = 0.0, .energy = -3e-6}};
}

}  // namespace

TEST_CASE("a program without gas has a step, an accuracy and a spectral radius") {
  const Run plain({});
  REQUIRE(plain.settings);
  CHECK(plain.settings->step == 1e-3);
  CHECK_FALSE(plain.settings->accuracy);
  CHECK(plain.settings->spectral_radius == 0.8);

  const Run given({"--step", "2e-4", "--spectral-radius", "1"});
  REQUIRE(given.settings);
  CHECK(given.settings->step == 2e-4);
  CHECK(given.settings->spectral_radius == 1.0);

  const Run varying({"--accuracy", "1e-6"});
  REQUIRE(varying.settings);
  CHECK(varying.settings->accuracy == 1e-6);
  CHECK_FALSE(varying.settings->step);

  const Run help({"--help"});
  for (const char* part : {"--accuracy NUMBER [m]", "--spectral-radius NUMBER", "(default 0.8)",
                           "--step NUMBER [s]", "(default 0.001)", "chain --accuracy 1e-6"})
    CHECK_THAT(help.out, Catch::Matchers::Contains(part));
  for (const char* part : {"--spacing", "--cfl"})
    CHECK_THAT(help.out, !Catch::Matchers::Contains(part));
}

TEST_CASE("the numbers of Newton's method reach the integrator", "[fault]") {
  const Run plain({});
  REQUIRE(plain.settings);
  CHECK(integrator_of(*plain.settings).newton.tolerance == mbs::Newton{}.tolerance);
  CHECK(integrator_of(*plain.settings).newton.max_iterations == mbs::Newton{}.max_iterations);

  const Run given({"--set", "run.newton_tolerance=1e-8", "--set", "run.newton_iterations=7",
                   "--spectral-radius", "0.5", "--accuracy", "1e-6"});
  REQUIRE(given.settings);
  const mbs::GeneralizedAlpha integrator = integrator_of(*given.settings);
  CHECK(integrator.newton.tolerance == 1e-8);
  CHECK(integrator.newton.max_iterations == 7);
  CHECK(integrator.spectral_radius == 0.5);
  CHECK(integrator.accuracy == 1e-6);
  CHECK_FALSE(step_solver_of(*given.settings).accuracy);

  for (const char* bad :
       {"run.newton_tolerance=0", "run.newton_tolerance=1e-3", "run.newton_tolerance=nan",
        "run.newton_iterations=0", "run.newton_iterations=1.5", "run.newton_iterations=1001"}) {
    CAPTURE(bad);
    const Run refused({"--set", bad});
    CHECK(refused.code == 2);
  }
}

TEST_CASE("a program without gas refuses the options of gas, and bad ones of its own") {
  const auto refused = [](const Words& words) {
    const Run run(words);
    CHECK(run.code == 2);
    CHECK_FALSE(run.settings);
    return run.err.substr(0, run.err.find('\n') + 1);
  };
  CHECK(refused({"--spacing", "1"}) ==
        "command line: error E010 --spacing: is not an option; --help lists all\n");
  CHECK(refused({"--cfl", "0.3"}) ==
        "command line: error E010 --cfl: is not an option; --help lists all\n");
  CHECK(refused({"--step", "1e-3", "--accuracy", "1e-6"}) ==
        "command line: error E014 --step 1e-3: excludes --accuracy; give one of them\n");
  CHECK(refused({"--accuracy", "0"}) ==
        "command line: error E022 --accuracy 0: must be a positive number of metres (steps as long "
        "as this error of a position allows, excludes --step)\n");
  CHECK(refused({"--spectral-radius", "1.1"}) ==
        "command line: error E022 --spectral-radius 1.1: must be from 0 to 1 (of "
        "generalized-alpha, 1 damps no vibration, 0 the fastest ones at once)\n");
}

TEST_CASE("a program without gas needs a step or an accuracy among its defaults") {
  Program program = chain();
  program.defaults.step.reset();
  CHECK_THROWS_AS(Parameters(program), std::invalid_argument);
  program.defaults.accuracy = 1e-6;
  CHECK_NOTHROW(Parameters(program));
  program.defaults.spectral_radius = 1.5;
  CHECK_THROWS_AS(Parameters(program), std::invalid_argument);
}

TEST_CASE("a program without gas that is out of memory says what helps", "[examples][fault]") {
  Parameters line(chain());
  const char* const argv[] = {"chain"};
  std::ostringstream out, err;
  CHECK(guarded_main(
            1, argv, line, [](const Settings&) { throw std::bad_alloc(); }, out, err) == 6);
  CHECK(err.str() == "error E090 out of memory; fewer elements need less of it\n");
}

TEST_CASE("the log of a structure has iterations a step instead of pairs") {
  std::ostringstream out, err;
  Report report(out, err, {.clock = [now = 0.0]() mutable { return now += 1.0; }});
  for (int step = 0; step <= 10; ++step)
    report.progress({.step = step,
                     .time = step / 10.0,
                     .time_step = 0.1,
                     .until = 1.0,
                     .limited_by = "fixed",
                     .iterations = 3 * step});
  CHECK_THAT(out.str(), Catch::Matchers::StartsWith(
                            "    step       t [s]      dt [s]  limited by            it/step"
                            "     ETA\n"));
  CHECK_THAT(out.str(), Catch::Matchers::Contains("       5         0.5         0.1  fixed"
                                                  "                       3"));
}

TEST_CASE("the closing block of a structure has Newton's method, energy and joints") {
  std::ostringstream out, err;
  Report report(out, err, {});
  report.finish(example(), {});
  CHECK(out.str() ==
        "\n"
        "done      1 000 steps, t = 1 s in 2.00 s\n"
        "newton    3.6 iterations a step, 1 234 factorisations           peak memory 9.0 MiB\n"
        "conserved energy -3e-06                                         "
        "(over the largest kinetic energy)\n"
        "joints    hold to 2.5e-15                                       "
        "(over the structure's size)\n"
        "incidents 0 halvings, 0 steps of bodies rejected\n");
}

TEST_CASE("the summary of a structure says nothing of gas, unless there is some") {
  const fs::path path =
      fs::temp_directory_path() / ("sphmbs_structure_" + std::to_string(::getpid()) + ".json");
  const auto written = [&](const Summary& summary) {
    write_summary(path, summary);
    std::ifstream file(path);
    const auto json = nlohmann::ordered_json::parse(file);
    fs::remove(path);
    return json;
  };
  const auto json = written(example());
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  CHECK(keys == Words{"case", "version", "backend", "threads", "structure", "steps", "time_end",
                      "wall_seconds", "phases", "peak_memory_bytes", "conservation", "results"});
  CHECK(json["structure"].dump() ==
        R"({"coordinates":40,"conditions":21,"redundant":1,"iterations":3600,)"
        R"("factorisations":1234,"halvings":0,"rejected":0,"violation":2.5e-15})");
  CHECK(json["conservation"].dump() == R"({"energy":-3e-06})");

  Summary both = example();
  both.particles.gas = 100;
  const auto coupled = written(both);
  CHECK(coupled.contains("structure"));
  CHECK(coupled["particles"]["gas"] == 100);
  CHECK(coupled["conservation"].contains("mass"));
}

TEST_CASE("a reference is compared at its own times") {
  struct Row {
    double t, height;
  };
  const std::vector<Row> rows{{0, 1}, {0.1, 3}, {0.2, 5}, {0.3, 7}};
  const ReferenceCurve reference = reference_curve(rows, &Row::height);
  CHECK(reference.at(0.2) == 5);
  CHECK(std::isnan(reference.at(0.15)));

  History history;
  history.add("height", "m");
  for (const double t : {0.0, 0.05, 0.1, 0.15, 0.2}) history.row(t, {1 + 20 * t + (t > 0.12)});
  const Curve difference = reference.difference(history, "height", "height");
  CHECK(difference.x == std::vector<double>{0, 0.1, 0.2});
  CHECK(largest_until(difference, 0.1) == Approx(0).margin(1e-12));
  CHECK(largest_until(difference, 0.2) == Approx(1));
  const Curve shown = reference.curve("reference", 0.1);
  CHECK(shown.reference);
  CHECK(shown.y == std::vector<double>{1, 3});
}

TEST_CASE("the spread of a quantity is about its parabola", "[examples]") {
  History history;
  history.add("force", "N");
  double sum = 0;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.01 * i, value = 3 + 2 * t - 5 * t * t + (i % 2 == 0 ? 0.1 : -0.1);
    history.row(t, {value});
    if (i >= 20) sum += value;
  }
  const Spread spread = spread_of(history, "force", 0.2 - 1e-9, 1);
  CHECK(spread.mean == Approx(sum / 81));
  CHECK(spread.deviation == Approx(0.1).epsilon(0.03));
  CHECK(std::isnan(spread_of(history, "force", 0.2, 0.22).deviation));
}

}  // namespace sphmbs::examples
