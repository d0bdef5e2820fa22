// SPDX-License-Identifier: MIT
// gas_cylinder as its users run it, against the finite-volume reference it compares itself with.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

Words arguments(const std::string& spacing) {
  return {"--spacing", spacing, "--until", "1", "--threads", "1", "--quiet", "--output", "run"};
}

double value(const Json& summary, const std::string& name) {
  return summary["results"][name]["value"].get<double>();
}
double reference(const Json& summary, const std::string& name) {
  return summary["results"][name]["reference"].get<double>();
}
double force_excess(const Json& summary) {
  return value(summary, "force") / reference(summary, "force") - 1;
}

const Words points = {"upstream", "above", "downstream", "far"};

/// Deviations in the measures of the bands, into the log.
void print(const std::string& spacing, const Json& summary) {
  std::cout << "gas_cylinder, spacing " << spacing << ":";
  for (const std::string& point : points) {
    const double speed = value(summary, "speed_" + point) - reference(summary, "speed_" + point);
    const double p = value(summary, "p_" + point) - reference(summary, "p_" + point);
    std::cout << ' ' << point << ' ' << 100 * speed / 3 << " % of 3t, " << p << " Pa;";
  }
  std::cout << " force " << 100 * force_excess(summary) << " %\n";
}

/// What a run of 1 s at 0.5 and at 0.25 m keeps to: where gas passes freely speeds are right; on
/// the cylinder's axis, in the gas that the cylinder holds up, the layers of virtual particles,
/// which never move, slow it down beyond what a slip wall does.
void check_flow(const Json& summary) {
  CHECK(summary["time_end"].get<double>() == Approx(1).epsilon(1e-12));
  for (const std::string& point : points) {
    CAPTURE(point);
    const double p = value(summary, "p_" + point) - reference(summary, "p_" + point);
    CHECK(std::abs(p) < 3);  // [Pa], of a rise of 28 Pa at the front
  }
  for (const char* name : {"speed_above", "speed_far"}) {
    CAPTURE(name);
    CHECK(std::abs(value(summary, name) - reference(summary, name)) < 0.03 * 3);
  }
  const Json& conserved = summary["conservation"];
  CHECK(std::abs(conserved["mass"].get<double>()) < 1e-13);
  CHECK(std::abs(conserved["momentum"].get<double>()) < 1e-12);
  CHECK(std::abs(conserved["energy"].get<double>()) < 1e-7);  // what the steps lose
}

}  // namespace

TEST_CASE("gas_cylinder at 0.5 m leaves summary, history, fields and pictures", "[gas_cylinder]") {
  const test::Scratch scratch;
  const auto ended = test::start(scratch, SPHMBS_GAS_CYLINDER, arguments("0.5"));
  REQUIRE(ended.code == 0);
  CHECK(ended.out.empty());  // --quiet
  CHECK(ended.err.empty());
  const fs::path run = scratch.work() / "run";
  const Json summary = test::summary_of(run);
  print("0.5", summary);

  CHECK(test::keys_of(summary) ==
        Words{"case", "version", "backend", "threads", "particles", "steps", "time_end",
              "wall_seconds", "phases", "pair_interactions", "pair_interactions_per_second",
              "peak_memory_bytes", "conservation", "incidents", "results"});
  CHECK(test::keys_of(summary["particles"]) == Words{"gas", "virtual"});
  CHECK(test::keys_of(summary["conservation"]) == Words{"mass", "momentum", "energy"});
  CHECK(summary["case"] == "gas_cylinder");
  CHECK(summary["backend"] == "openmp");
  CHECK(summary["threads"] == 1);
  const std::string version = summary["version"].get<std::string>();
  CHECK(test::start(scratch, SPHMBS_GAS_CYLINDER, {"--version"}).out.find(version) !=
        std::string::npos);
  const double wall = summary["wall_seconds"].get<double>();
  CHECK(wall > 0);
  double phases = 0;
  for (const auto& phase : summary["phases"]) phases += phase.get<double>();
  CHECK(phases == Approx(wall).epsilon(0.05));
  // A lattice point has 44 others within 3.75 spacings; those at the rims of the walls have fewer.
  const double pairs = summary["pair_interactions"].get<double>();
  const double all =
      summary["particles"]["gas"].get<double>() + summary["particles"]["virtual"].get<double>();
  const double evaluations = 2 * summary["steps"].get<double>();
  CHECK(pairs / evaluations / all == Approx(43).margin(2).epsilon(0));
  CHECK(summary["pair_interactions_per_second"].get<double>() ==
        Approx(pairs / wall).epsilon(1e-6));
  CHECK(summary["peak_memory_bytes"].get<double>() > 1e6);
  REQUIRE(summary["results"].size() > 0);
  for (const auto& result : summary["results"]) {
    CHECK(test::keys_of(result) == Words{"value", "reference", "unit"});
    CHECK(result["value"].is_number());
    CHECK((result["reference"].is_number() || result["reference"].is_null()));
    CHECK(!result["unit"].get<std::string>().empty());
  }

  check_flow(summary);
  for (const char* name : {"speed_upstream", "speed_downstream"}) {
    CAPTURE(name);
    const double lack = (reference(summary, name) - value(summary, name)) / 3;
    CHECK(lack > 0.09);
    CHECK(lack < 0.14);
  }
  CHECK(force_excess(summary) == Approx(0.74).margin(0.04).epsilon(0));

  const auto history = test::table_of(run / "history.csv");
  CHECK(history.comment.find("gas_cylinder") != std::string::npos);
  Words head{"t[s]"};
  for (const std::string& point : points) {
    head.push_back("speed_" + point + "[m/s]");
    head.push_back("p_" + point + "[Pa]");
  }
  head.push_back("force[N/m]");
  CHECK(history.head == head);
  const auto times = history.column("t[s]");
  // 400 rows are asked for, which are more than there are steps: one a step, and one at the end.
  REQUIRE(summary["steps"].get<std::size_t>() < 400);
  CHECK(times.size() == summary["steps"].get<std::size_t>() + 1);
  CHECK(std::is_sorted(times.begin(), times.end()));
  CHECK(times.front() == 0);
  CHECK(times.back() == Approx(1).epsilon(1e-12));
  CHECK(history.column("force[N/m]").back() == Approx(value(summary, "force")).epsilon(1e-12));
  for (const auto& row : history.rows)
    for (const double number : row) REQUIRE(std::isfinite(number));

  const auto fields = test::fields_of(run);
  REQUIRE(fields.size() == 5);
  int number = 0;
  for (const auto& [time, file] : fields) {
    CHECK(time == Approx(0.25 * number++).margin(1e-12));
    CHECK(test::points_of(run / file) == std::lround(all));
  }
  CHECK(test::is_picture(run / "history.svg"));
  CHECK(test::is_picture(run / "history.png"));
  for (const char* quantity : {"speed", "pressure", "density"})
    for (int frame = 0; frame < 5; ++frame)
      CHECK(test::is_picture(run /
                             (std::string(quantity) + "_000" + std::to_string(frame) + ".png")));
}

TEST_CASE("gas_cylinder has the paper's particles at the paper's spacing", "[gas_cylinder]") {
  const test::Scratch scratch;
  const auto ended = test::start(scratch, SPHMBS_GAS_CYLINDER,
                                 {"--spacing", "0.1", "--until", "1e-6", "--step", "1e-6",
                                  "--threads", "1", "--output", "run"});
  REQUIRE(ended.code == 0);
  const Json summary = test::summary_of(scratch.work() / "run");
  CHECK(summary["particles"]["gas"] == 469567);
  CHECK(summary["particles"]["virtual"] == 14296);
  CHECK(summary["steps"] == 1);
  CHECK(ended.out.find("469 567 gas + 14 296 virtual") != std::string::npos);
}

TEST_CASE("gas_cylinder at 0.25 m is nearer to the reference than at 0.5 m",
          "[gas_cylinder][slow]") {
  Json summaries[2];
  const char* spacings[] = {"0.5", "0.25"};
  for (int i = 0; i < 2; ++i) {
    const test::Scratch scratch;
    REQUIRE(test::start(scratch, SPHMBS_GAS_CYLINDER, arguments(spacings[i])).code == 0);
    summaries[i] = test::summary_of(scratch.work() / "run");
    print(spacings[i], summaries[i]);
  }
  check_flow(summaries[1]);
  CHECK(force_excess(summaries[1]) > 0);
  CHECK(force_excess(summaries[1]) < force_excess(summaries[0]));
  for (const char* name : {"speed_upstream", "speed_downstream"}) {
    CAPTURE(name);
    const double fine = reference(summaries[1], name) - value(summaries[1], name);
    CHECK(fine > 0);
    CHECK(fine < reference(summaries[0], name) - value(summaries[0], name));
  }
}
