// SPDX-License-Identifier: MIT
// falling_plates as its users run it, against an independent solution of the same equations.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "reference/falling_plates.hpp"
#include "support/catch.hpp"
#include "support/program.hpp"
#include "validation/mbs/runs.hpp"

namespace {

using Reference = sphmbs::examples::PlatesReference;
using Words = std::vector<std::string>;

test::StructureRun run(Words words) {
  words.push_back("--no-air");
  return test::run_structure(SPHMBS_FALLING_PLATES, std::move(words));
}

double place_difference(const test::Table& traces, double until) {
  const auto& rows = sphmbs::examples::plates_reference;
  return std::max(test::largest_difference(traces, "P_x[m]", rows, &Reference::P_x, until),
                  test::largest_difference(traces, "P_z[m]", rows, &Reference::P_z, until));
}
double velocity_difference(const test::Table& traces, double until) {
  const auto& rows = sphmbs::examples::plates_reference;
  return std::max(test::largest_difference(traces, "P_vx[m/s]", rows, &Reference::P_vx, until),
                  test::largest_difference(traces, "P_vz[m/s]", rows, &Reference::P_vz, until));
}

}  // namespace

TEST_CASE("falling_plates follow the reference and stay symmetric", "[falling_plates]") {
  const auto plates = run({"--until", "0.9"});
  CHECK(plates.traces.head == Words{"t[s]", "P_x[m]", "P_z[m]", "P_vx[m/s]", "P_vz[m/s]"});
  test::check_times(plates.traces, 0.9);
  CHECK(plates.summary["structure"]["coordinates"] == 2178);
  CHECK(plates.summary["structure"]["conditions"] == 18);
  std::cout << "falling_plates: P differs from the reference by";
  // From 0.65 s on the motion is a whip.
  for (const auto& [until, allowed] :
       {std::pair(0.4, 1e-3), std::pair(0.6, 1e-3), std::pair(0.7, 1e-2), std::pair(0.8, 5e-2)}) {
    const double found = place_difference(plates.traces, until);
    std::cout << ' ' << found << " m up to " << until << " s";
    CHECK(found < allowed);
  }
  const double slow = velocity_difference(plates.traces, 0.4),
               fast = velocity_difference(plates.traces, 0.6);
  CHECK(slow < 2e-2);
  CHECK(fast < 0.1);
  double aside = 0;
  for (const double y : plates.history.column("P_y[m]")) aside = std::max(aside, std::abs(y - 2.5));
  std::cout << ", its velocity by " << slow << " m/s up to 0.4 s and " << fast
            << " up to 0.6 s; it leaves the plane of symmetry by " << aside << " m up to 0.9 s\n";
  CHECK(aside < 1e-6);

  // Until a bending wave from the hinges arrives, the free edge falls freely.
  const auto time = plates.traces.column("t[s]"), z = plates.traces.column("P_z[m]");
  for (std::size_t k = 0; time[k] <= 0.5; ++k)
    CHECK(z[k] == Approx(5 - 9.81 / 2 * time[k] * time[k]).margin(2e-4));
}

TEST_CASE("falling_plates on two threads and one leave the same", "[falling_plates]") {
  const auto [air, files] = GENERATE(std::pair<Words, int>({"--no-air", "--until", "0.02"}, 41 + 7),
                                     std::pair<Words, int>({"--until", "0.005"}, 2 * 21 + 7));
  CAPTURE(air);
  const test::Scratch scratch;
  for (const Words& words : {Words{"--backend", "serial"}, Words{"--threads", "2"}}) {
    Words all = words;
    all.insert(all.end(), air.begin(), air.end());
    all.insert(all.end(), {"--quiet", "--output", words[1]});
    REQUIRE(test::start(scratch, SPHMBS_FALLING_PLATES, all).code == 0);
  }
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.work() / "serial")) {
    const auto name = entry.path().filename();
    if (name == "summary.json" || name == "used.toml" || name == "view.py")
      continue;  // hold times, threads, folder
    CAPTURE(name);
    CHECK(test::text_of(entry.path()) == test::text_of(scratch.work() / "2" / name));
    ++compared;
  }
  CHECK(compared == files);  // of fields and bodies, and all others
}

TEST_CASE("falling_plates fall in air", "[falling_plates]") {
  const test::Scratch scratch;
  const auto ended =
      test::start(scratch, SPHMBS_FALLING_PLATES,
                  {"--until", "0.02", "--threads", "2", "--quiet", "--output", "run"});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const auto summary = test::summary_of(scratch.work() / "run");
  CHECK(summary["particles"]["gas"] == 46590);
  CHECK(summary["particles"]["virtual"] == 28210);
  CHECK(std::abs(summary["conservation"]["mass"].get<double>()) < 1e-14);
  CHECK(std::abs(summary["conservation"]["momentum"].get<double>()) < 1e-13);
  CHECK(std::abs(summary["conservation"]["energy"].get<double>()) < 1e-6);
  CHECK(summary["results"]["largest_asymmetry_of_P"]["value"].get<double>() < 1e-12);
  // The plates, of 157 N, press on the air below and hang on the air above.
  const test::Table history = test::table_of(scratch.work() / "run" / "history.csv");
  const double lift =
      history.column("gas_force_I_z[N]").back() + history.column("gas_force_II_z[N]").back();
  CHECK(lift > 5);
  CHECK(lift < 100);
  CHECK(std::abs(summary["results"]["work_lost_between_gas_and_bodies"]["value"].get<double>()) <
        1e-11);
}

TEST_CASE("falling_plates converge with the mesh", "[falling_plates][slow]") {
  const auto coarse = run({"--elements", "5", "--until", "0.6"}), medium = run({"--until", "0.6"}),
             fine = run({"--elements", "20", "--until", "0.6"});
  double before = 1;
  for (const auto& [name, a, b] : {std::tuple("5 x 5 against 10 x 10", &coarse, &medium),
                                   std::tuple("10 x 10 against 20 x 20", &medium, &fine)}) {
    const double x = test::largest_difference(a->traces, b->traces, "P_x[m]", 0.6),
                 z = test::largest_difference(a->traces, b->traces, "P_z[m]", 0.6);
    std::cout << "falling_plates up to 0.6 s, " << name << ": x " << x << " m, z " << z << " m\n";
    CHECK(std::max(x, z) < 0.7 * before);
    before = std::max(x, z);
  }
  CHECK(before < 1e-2);
  // 20 x 20 elements of the independent solution, with steps of 1e-3 s, put P here.
  const auto row = fine.traces.rows.back();
  CHECK(row[0] == Approx(0.6));
  CHECK(row[1] == Approx(3 + 3.2322).margin(1e-3));
  CHECK(row[2] == Approx(5 - 1.7650).margin(1e-3));
}
