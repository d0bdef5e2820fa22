// SPDX-License-Identifier: MIT
// The shock tube programs as their users run them.
#include <iostream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

struct Case {
  const char* program;
  const char* name;
  const char* spacing;
  double along;  // particles along the tube
  double error;  // largest L1 error of the density [kg/m^3]
};

void check(const Case& tube) {
  CAPTURE(tube.name);
  const test::Scratch scratch;
  const auto ended =
      test::start(scratch, tube.program,
                  {"--spacing", tube.spacing, "--threads", "1", "--quiet", "--output", "run"});
  REQUIRE(ended.code == 0);
  CHECK(ended.err.empty());
  const auto run = scratch.work() / "run";
  const auto summary = test::summary_of(run);
  CHECK(summary["case"] == tube.name);
  CHECK(summary["time_end"].get<double>() == Approx(0.2).epsilon(1e-12));
  const auto& results = summary["results"];
  CHECK(results["particles_along"]["value"].get<double>() == tube.along);
  const double error = results["L1_density"]["value"].get<double>();
  std::cout << tube.name << ", spacing " << tube.spacing << ": L1(rho) " << error << '\n';
  CHECK(error > 0);
  CHECK(error < tube.error);
  CHECK(results["L1_velocity"]["value"].get<double>() < 10 * tube.error);
  CHECK(results["L1_pressure"]["value"].get<double>() < 10 * tube.error);
  CHECK(test::is_picture(run / "profiles.svg"));
  CHECK(test::is_picture(run / "profiles.png"));
  CHECK(test::fields_of(run).size() == 5);
  CHECK(test::table_of(run / "history.csv").head == std::vector<std::string>{"t[s]", "energy[J]"});
}

}  // namespace

// The bound of 200 particles in a line, see verification of the scheme; the others differ from a
// line by less than its error.
TEST_CASE("shock_tube comes as near to the exact solution as its scheme", "[shock_tube]") {
  check({SPHMBS_SHOCK_TUBE, "shock_tube", "0.0028089887640449437", 200, 1.3e-2});
}

TEST_CASE("shock_tube_2d comes as near to the exact solution as a line", "[shock_tube]") {
  check({SPHMBS_SHOCK_TUBE_2D, "shock_tube_2d", "0.0028089887640449437", 245, 1.3e-2});
}
