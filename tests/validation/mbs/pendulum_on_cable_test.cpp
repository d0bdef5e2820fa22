// SPDX-License-Identifier: MIT
// pendulum_on_cable as its users run it, against an independent solution of the same equations.
#include <algorithm>
#include <initializer_list>
#include <iostream>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "reference/pendulum_on_cable.hpp"
#include "support/catch.hpp"
#include "support/program.hpp"
#include "validation/mbs/runs.hpp"

namespace {

using Reference = sphmbs::examples::PendulumReference;
using Words = std::vector<std::string>;

const Words columns{"A_x[m]", "A_y[m]", "C_x[m]", "C_y[m]"};

test::StructureRun run(Words words) {
  words.push_back("--no-air");
  return test::run_structure(SPHMBS_PENDULUM_ON_CABLE, std::move(words));
}

/// Of A and C, along x and y.
double difference(const test::Table& traces, std::span<const Reference> rows, double until) {
  return std::max({test::largest_difference(traces, columns[0], rows, &Reference::A_x, until),
                   test::largest_difference(traces, columns[1], rows, &Reference::A_y, until),
                   test::largest_difference(traces, columns[2], rows, &Reference::C_x, until),
                   test::largest_difference(traces, columns[3], rows, &Reference::C_y, until)});
}
double difference(const test::Table& a, const test::Table& b, double until) {
  double largest = 0;
  for (const std::string& column : columns)
    largest = std::max(largest, test::largest_difference(a, b, column, until));
  return largest;
}

/// 1 mm up to 0.4 s, 3 mm up to 0.6 s, 8 mm up to 1 s: what another step and quadrature may do. The
/// measures of strain differ by 0.2 mm at 0.5 s and 2.6 mm at 1 s.
void check_bands(const std::string& name, const test::Table& traces,
                 std::span<const Reference> rows) {
  std::cout << "pendulum_on_cable, " << name << ": A and C differ from the reference by";
  for (const auto& [until, allowed] :
       {std::pair(0.4, 1e-3), std::pair(0.6, 3e-3), std::pair(1.0, 8e-3)}) {
    const double found = difference(traces, rows, until);
    std::cout << ' ' << found << " m up to " << until << " s";
    CHECK(found < allowed);
  }
  std::cout << '\n';
}

}  // namespace

TEST_CASE("pendulum_on_cable follows the reference with either strain", "[pendulum_on_cable]") {
  namespace reference = sphmbs::examples;
  const auto green = run({}), engineering = run({"--measure", "engineering"});
  check_bands("Green's strain", green.traces, reference::pendulum_green);
  check_bands("engineering strain", engineering.traces, reference::pendulum_engineering);
  // Far closer, in fact, so that the measure of strain shows.
  CHECK(difference(green.traces, reference::pendulum_green, 0.6) < 1e-4);
  CHECK(difference(engineering.traces, reference::pendulum_engineering, 0.6) < 1e-4);
  CHECK(difference(green.traces, reference::pendulum_engineering, 0.6) > 2e-4);

  CHECK(green.traces.head == Words{"t[s]", "A_x[m]", "A_y[m]", "C_x[m]", "C_y[m]"});
  test::check_times(green.traces, 1);
  CHECK(green.summary["structure"]["coordinates"] == 109);
  CHECK(green.summary["structure"]["conditions"] == 10);
  // A stays on the cable, and the cable hangs on its ends: s, and forces that carry the weight.
  for (const double s : green.history.column("s[m]")) CHECK((s > 0 && s <= 4.02 + 1e-9));
}

TEST_CASE("pendulum_on_cable converges with the number of elements", "[pendulum_on_cable]") {
  const auto coarse = run({"--elements", "12"}), medium = run({}),
             fine = run({"--elements", "48", "--step", "1.25e-4"});
  const double until[] = {0.4, 0.6, 1.0};
  for (const double t : until)
    std::cout << "pendulum_on_cable up to " << t << " s: 12 against 48 elements "
              << difference(coarse.traces, fine.traces, t) << " m, 24 against 48 "
              << difference(medium.traces, fine.traces, t) << " m\n";
  for (const double t : until) {
    CAPTURE(t);
    CHECK(difference(medium.traces, fine.traces, t) <
          0.7 * difference(coarse.traces, fine.traces, t));
  }
  check_bands("48 elements", fine.traces, sphmbs::examples::pendulum_green_48);
}

TEST_CASE("pendulum_on_cable meets the times of its trajectories with any step",
          "[pendulum_on_cable]") {
  const auto odd = run({"--step", "3e-4", "--until", "0.012"});
  test::check_times(odd.traces, 0.012);
  CHECK_THAT(odd.ended.err, Catch::StartsWith("warning: step: shortened from 3e-04 to ") &&
                                Catch::Contains("0.000294118 s"));
  const auto even = run({"--step", "5e-4", "--until", "0.012"});
  CHECK(even.ended.err.empty());
}

TEST_CASE("pendulum_on_cable loses more energy with a smaller spectral radius",
          "[pendulum_on_cable]") {
  double before = 1e-6;
  for (const char* radius : {"1", "0.8", "0.2"}) {
    CAPTURE(radius);
    const auto end = run({"--spectral-radius", radius, "--until", "0.6", "--step", "5e-4"});
    const double change = end.summary["conservation"]["energy"].get<double>();
    CHECK(change < before);
    CHECK(change > -1e-2);
    before = change;
  }
}

TEST_CASE("pendulum_on_cable leaves what it lists", "[pendulum_on_cable]") {
  const test::Scratch scratch;
  const auto ended = test::start(scratch, SPHMBS_PENDULUM_ON_CABLE,
                                 {"--until", "0.05", "--no-air", "--output", "run"});
  REQUIRE(ended.code == 0);
  CHECK(ended.err.empty());
  for (const char* part : {"--no-air", "24 cables, 2 bars, 4 joints", "109 coordinates",
                           "spectral radius 0.8", "iterations a step", "largest kinetic energy"})
    CHECK_THAT(ended.out, Catch::Contains(part));
  const auto run = scratch.work() / "run";
  const auto files = test::files_of(run / "bodies.pvd");
  REQUIRE(files.size() == 51);
  CHECK(files.begin()->first == 0);
  CHECK(files.rbegin()->first == Approx(0.05));
  // Nine points on each element, and the two ends of each bar.
  for (const auto& [time, file] : files) CHECK(test::points_of(run / file) == 24 * 9 + 2 * 2);
  for (const char* name : {"trajectories.svg", "trajectories.png", "motion.png", "frames.png"})
    CHECK(test::is_picture(run / name));
  for (const char* name : {"history.csv", "trajectories.csv", "bodies.pvd", "summary.json"})
    CHECK_THAT(ended.out, Catch::Contains(name));
}

TEST_CASE("pendulum_on_cable swings in air", "[pendulum_on_cable]") {
  const auto in_air = [](Words words) {
    const test::Scratch scratch;
    words.insert(words.end(), {"--quiet", "--threads", "2", "--output", "run"});
    const auto ended = test::start(scratch, SPHMBS_PENDULUM_ON_CABLE, words);
    CAPTURE(ended.err);
    REQUIRE(ended.code == 0);
    const auto folder = scratch.work() / "run";
    return std::pair(test::summary_of(folder), test::table_of(folder / "trajectories.csv"));
  };
  SECTION("with the paper's particles") {
    const auto [summary, traces] = in_air({"--until", "5e-4"});
    CHECK(summary["particles"]["gas"] == 40162);
    CHECK(summary["particles"]["virtual"] == 1638);
  }
  for (const std::string scheme : {"paper", "best"}) {
    DYNAMIC_SECTION("keeping its accounts, scheme " << scheme) {
      const auto [summary, traces] =
          in_air({"--spacing", "0.1", "--until", "0.2", "--scheme", scheme});
      CHECK(std::abs(summary["conservation"]["mass"].get<double>()) < 1e-14);
      CHECK(std::abs(summary["conservation"]["momentum"].get<double>()) < 1e-12);
      CHECK(std::abs(summary["conservation"]["energy"].get<double>()) < 1e-5);
      CHECK(summary["structure"]["violation"].get<double>() < 1e-9);
      // Air holds back a fall of 0.15 m by less than a tenth.
      const double shift = test::largest_difference(
          traces, columns[3], sphmbs::examples::pendulum_green, &Reference::C_y, 0.2);
      CHECK(shift > 1e-4);
      CHECK(shift < 0.015);
    }
  }
}
