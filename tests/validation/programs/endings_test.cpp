// SPDX-License-Identifier: MIT
// What is left of runs that fail, are repeated, or run on other back ends.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("a run that blows up says where, and keeps what it had", "[programs][fault]") {
  const test::Scratch scratch;
  // The gas leaves the cylinder's lee so fast that it sees itself around the periodic side.
  const auto ended =
      test::start(scratch, SPHMBS_GAS_CYLINDER,
                  {"--spacing", "1", "--until", "0.2", "--set", "gas.acceleration=[1e4, 0]",
                   "--set", "run.samples=40", "--threads", "1", "--quiet", "--output", "run"});
  CAPTURE(ended.err);
  CHECK(ended.code == 3);
  std::size_t errors = 0;
  for (const std::string& line : test::lines_of(ended.err)) {
    CHECK((line.starts_with("error E308 ") || line.starts_with("  ") ||
           line.starts_with("warning: ")));
    errors += line.starts_with("error ");
  }
  CHECK(errors == 1);
  for (const char* part : {" at step ", "particle #", " at (", " m, v = (", "rho = ", "kg/m^3",
                           "likely: ", "try: ", "culprits.vtp"})
    CHECK_THAT(ended.err, Catch::Contains(part));

  const fs::path run = scratch.work() / "run";
  const auto history = test::table_of(run / "history.csv");
  REQUIRE(history.rows.size() >= 5);
  for (std::size_t i = 0; i < history.rows.size(); ++i) {
    CHECK((i == 0 || history.rows[i][0] > history.rows[i - 1][0]));
    for (const double number : history.rows[i]) CHECK(std::isfinite(number));
  }
  const auto fields = test::fields_of(run);
  REQUIRE(fields.size() == 1);  // the next ones are due at 0.05 s
  CHECK(fields.begin()->first == 0);
  CHECK(test::points_of(run / fields.begin()->second) > 5000);
  CHECK(test::is_picture(run / "speed_0000.png"));
  CHECK(test::points_of(run / "crash/culprits.vtp") > 0);
  CHECK(!fs::exists(run / "summary.json"));
}

TEST_CASE("a fixed step that is too long is divided, or refused with its limit",
          "[programs][fault]") {
  const test::Scratch scratch;
  const auto run = [&](const char* step, const char* until, const char* folder) {
    return test::start(scratch, SPHMBS_GAS_CYLINDER,
                       {"--spacing", "0.5", "--step", step, "--until", until, "--threads", "1",
                        "--quiet", "--output", folder});
  };
  // About three times the stable step.
  const auto divided = run("0.05", "0.2", "divided");
  CAPTURE(divided.err);
  CHECK(divided.code == 0);
  CHECK_THAT(divided.err, Catch::Contains("more than twice what the stability limits allow"));
  const auto history = test::table_of(scratch.work() / "divided/history.csv");
  REQUIRE(history.rows.size() == 5);
  for (std::size_t i = 0; i < history.rows.size(); ++i)
    CHECK(history.rows[i][0] == Approx(0.05 * static_cast<double>(i)).margin(1e-12));

  const auto refused = run("5", "10", "refused");
  CAPTURE(refused.err);
  CHECK(refused.code == 3);
  for (const char* part :
       {"error E310 ", "times as long as the longest that is stable", "limited by sound", "--step"})
    CHECK_THAT(refused.err, Catch::Contains(part));
}

TEST_CASE("results do not depend on back end and threads", "[programs][fault]") {
  struct Case {
    const char* program;
    Words words;
  };
  const Case cases[] = {{SPHMBS_GAS_CYLINDER, {"--spacing", "1", "--until", "0.1"}},
                        {SPHMBS_SHOCK_TUBE_3D, {"--spacing", "0.025", "--until", "0.005"}}};
  const Words backends[] = {{"--backend", "serial"},
                            {"--backend", "openmp", "--threads", "1"},
                            {"--backend", "openmp", "--threads", "2"}};
  for (const Case& item : cases) {
    CAPTURE(item.program);
    const test::Scratch scratch;
    for (int k = 0; k < 3; ++k) {
      Words words = item.words;
      words.insert(words.end(), backends[k].begin(), backends[k].end());
      words.insert(words.end(), {"--quiet", "--output", std::to_string(k)});
      REQUIRE(test::start(scratch, item.program, words).code == 0);
    }
    int compared = 0;
    for (const auto& entry : fs::directory_iterator(scratch.work() / "0")) {
      const fs::path name = entry.path().filename();
      if (name == "summary.json" || name == "used.toml" || name == "view.py")
        continue;  // hold times, threads, folder
      CAPTURE(name);
      const std::string serial = test::text_of(entry.path());
      CHECK(test::text_of(scratch.work() / "1" / name) == serial);
      CHECK(test::text_of(scratch.work() / "2" / name) == serial);
      ++compared;
    }
    CHECK(compared > 5);
    for (int k = 0; k < 3; ++k) {
      const auto summary = test::summary_of(scratch.work() / std::to_string(k));
      CHECK(summary["backend"] == (k == 0 ? "serial" : "openmp"));
      CHECK(summary["threads"] == (k == 2 ? 2 : 1));
    }
  }
}

TEST_CASE("a probe with an interval longer than the run is told of", "[programs]") {
  const test::Scratch scratch;
  std::ofstream(scratch.work() / "case.toml")
      << "[[probes]]\nname = \"seldom\"\nat = [-0.5]\ninterval = 0.5\n"
         "[[probes]]\nname = \"often\"\nat = [-0.5]\ninterval = 0.1\n";
  const auto ended =
      test::start(scratch, SPHMBS_LAGRANGE_GUN,
                  {"case.toml", "--spacing", "0.02", "--until", "0.2", "--output", "run"});
  CAPTURE(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Catch::Contains("W031") && Catch::Contains("seldom"));
  CHECK(ended.err.find("often") == std::string::npos);
}

TEST_CASE("overwriting replaces a run and leaves other files alone", "[programs]") {
  const test::Scratch scratch;
  const Words words{"--spacing", "0.025", "--until", "0.01", "--threads", "1", "--quiet"};
  REQUIRE(test::start(scratch, SPHMBS_SHOCK_TUBE, words).code == 0);
  const fs::path run = scratch.work() / "results" / "shock_tube";  // where it goes by default
  std::ofstream(run / "notes") << "mine";
  const std::string history = test::text_of(run / "history.csv");
  std::ofstream(run / "history.csv") << "old";

  CHECK(test::start(scratch, SPHMBS_SHOCK_TUBE, words).code == 2);
  CHECK(test::text_of(run / "history.csv") == "old");
  Words again = words;
  again.push_back("--overwrite");
  CHECK(test::start(scratch, SPHMBS_SHOCK_TUBE, again).code == 0);
  CHECK(test::text_of(run / "history.csv") == history);
  CHECK(test::text_of(run / "notes") == "mine");
}
