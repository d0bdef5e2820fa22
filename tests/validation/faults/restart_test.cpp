// SPDX-License-Identifier: MIT
// Every example program that is stopped and goes on leaves byte for byte the files of one that is
// not: fields, bodies, tables, lists and pictures.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/program.hpp"
#include "support/results.hpp"

namespace {

using Words = std::vector<std::string>;

struct Case {
  const char* path;
  Words options;  // for a run of seconds
  std::vector<int> stops = {1, 7, 20};
};

class Run {
 public:
  explicit Run(const Case& what) : case_(what) {}

  void straight(const Words& more = {}) { start("straight", more, 0); }

  /// Stops after so many steps, goes on, and so forth to the end.
  void in_parts(const std::string& folder, const std::vector<int>& stops,
                const std::vector<Words>& more = {}) {
    for (std::size_t k = 0; k <= stops.size(); ++k) {
      Words words = more.empty() ? Words{} : more[k % more.size()];
      if (k > 0) words.push_back("--resume");
      if (k < stops.size()) words.insert(words.end(), {"--steps", std::to_string(stops[k])});
      start(folder, words, 0);
    }
  }

  std::string differences(const std::string& folder) const {
    return test::differences(scratch_.work() / "straight", scratch_.work() / folder);
  }

  std::filesystem::path folder(const std::string& name) const { return scratch_.work() / name; }

  /// @return what it printed
  std::string start(const std::string& folder, const Words& more, int code) {
    Words words = case_.options;
    words.insert(words.end(), {"--output", folder});
    words.insert(words.end(), more.begin(), more.end());
    const test::Ended ended = test::start(scratch_, case_.path, words);
    INFO(ended.out + ended.err);
    REQUIRE(ended.code == code);
    return ended.out + ended.err;
  }

 private:
  Case case_;
  test::Scratch scratch_;
};

void check(const Case& what) {
  CAPTURE(what.path);
  Run run(what);
  run.straight();
  run.in_parts("parts", what.stops);
  CHECK(run.differences("parts") == "");
}

/// The same on other numbers of threads, and with another number in each part.
void check_threads(const Case& what) {
  CAPTURE(what.path);
  Run run(what);
  run.straight({"--threads", "1"});
  for (const char* threads : {"2", "3", "4", "7"}) {
    run.start(threads, {"--threads", threads}, 0);
    CHECK(run.differences(threads) == "");
  }
  run.in_parts("parts", what.stops,
               {{"--threads", "1"}, {"--threads", "4"}, {"--threads", "2"}, {"--threads", "7"}});
  CHECK(run.differences("parts") == "");
}

const Case cylinder{SPHMBS_GAS_CYLINDER, {"--spacing", "2", "--until", "0.2"}};
const Case cavity{SPHMBS_SEALED_CAVITY, {"--spacing", "0.05", "--until", "0.02"}};
const Case pendulum{SPHMBS_PENDULUM_ON_CABLE, {"--spacing", "0.1", "--until", "0.05"}};
const Case plates{SPHMBS_FALLING_PLATES, {"--spacing", "0.2", "--until", "0.05"}};

}  // namespace

TEST_CASE("stopped and resumed, gas leaves the same files", "[restart][fault]") {
  check({SPHMBS_SHOCK_TUBE, {"--spacing", "0.005"}, {1, 7, 20, 21, 40}});
  check({SPHMBS_SHOCK_TUBE_2D, {"--spacing", "0.02", "--until", "0.1"}});
  check({SPHMBS_SHOCK_TUBE_3D, {"--spacing", "0.02", "--until", "0.02"}, {1, 4}});
  check({SPHMBS_CYLINDER_WAKE, {"--spacing", "0.25", "--until", "0.2"}});
}

TEST_CASE("stopped and resumed, bodies leave the same files", "[restart][fault]") {
  check({SPHMBS_FLEXIBLE_PENDULUM, {"--until", "0.05"}});
  check({SPHMBS_SLIDER_CRANK, {"--until", "0.8"}, {1, 7, 700}});  // past a whole turn
  check({SPHMBS_SPINNING_TOP, {"--until", "0.05"}});
  check({SPHMBS_PENDULUM_ON_CABLE, {"--no-air", "--until", "0.1"}});
  check({SPHMBS_FALLING_PLATES, {"--no-air", "--until", "0.05"}});
}

TEST_CASE("stopped and resumed, bodies in gas leave the same files", "[restart][fault]") {
  check({SPHMBS_LAGRANGE_GUN, {"--spacing", "0.02"}, {1, 7, 20, 100}});
  check({SPHMBS_LAGRANGE_GUN_2D, {"--until", "0.05"}});
  check({SPHMBS_GAS_SPRING, {"--spacing", "0.05", "--until", "0.5"}});
  check({SPHMBS_ACCELERATED_CYLINDER, {"--until", "0.05"}});
  check({SPHMBS_SHOCK_PANEL, {"--spacing", "0.005", "--until", "2e-4"}});
}

TEST_CASE("any number of threads, changed from part to part, leaves the same files",
          "[restart][fault]") {
  check_threads(cylinder);
  check_threads(cavity);
  check_threads(pendulum);
  check_threads(plates);
}

TEST_CASE("a run may go on to a later end, but not as another one", "[restart][fault]") {
  Run run({SPHMBS_SHOCK_TUBE, {}});
  run.start("a", {"--spacing", "0.01", "--until", "0.1", "--steps", "10"}, 0);
  run.start("a", {"--spacing", "0.01", "--until", "0.2", "--resume"}, 0);
  run.start("a", {"--spacing", "0.02", "--until", "0.2", "--resume"}, 4);
}

TEST_CASE("the loads of bodies go on in the same table", "[restart][fault]") {
  Run run({SPHMBS_SLIDER_CRANK, {"--until", "0.1"}});
  run.straight();
  run.in_parts("parts", {1, 7, 20});
  for (const char* folder : {"straight", "parts"}) {
    CAPTURE(folder);
    const test::Table table = test::table_of(run.folder(folder) / "history.csv");
    REQUIRE(table.rows.size() > 10);
    const auto column = [&](const std::string& name) { return table.column(name + "[N]"); };
    for (const char* axis : {"x", "y"}) {
      const auto on = [&](const std::string& what) { return column(what + "_" + axis); };
      const auto all = on("constraint_force_rod"), total = on("total_force_rod");
      const auto A = on("joint_force_revolute_A_on_rod"), B = on("joint_force_revolute_B_on_rod");
      for (std::size_t k = 0; k < all.size(); ++k) {
        CHECK(all[k] == Approx(A[k] + B[k]).margin(1e-9));
        CHECK(all[k] == Approx(total[k]).margin(1e-5));  // no weight
      }
    }
  }
  CHECK(run.differences("parts") == "");
}

TEST_CASE("a run does not go on with another shape in the same file", "[restart][fault]") {
  Run run({SPHMBS_SHAPE_IN_FLOW, {"--spacing", "0.1", "--until", "0.1"}});
  const auto shape = run.folder("shape.txt");
  const Words from_file{"--shape", shape.string(), "--steps", "3"};
  std::ofstream(shape) << "0 0\n110 -25\n110 25\n0 0\n";
  run.start("a", from_file, 0);
  std::ofstream(shape) << "0 0\n110 -26\n110 26\n0 0\n";
  const Words again{"--shape", shape.string(), "--steps", "6", "--resume"};
  CHECK_THAT(run.start("a", again, 4), Catch::Contains("error E406") &&
                                           Catch::Contains("content of shape.file was ") &&
                                           Catch::Contains(" and is "));
  std::ofstream(shape) << "0 0\n110 -25\n110 25\n0 0\n";
  run.start("a", again, 0);
}
