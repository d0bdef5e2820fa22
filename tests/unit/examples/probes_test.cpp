// SPDX-License-Identifier: MIT
#include "support/probes.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <sphmbs/run.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/rates.hpp"

namespace {

namespace examples = sphmbs::examples;
namespace fs = std::filesystem;
using examples::ProbeSpec;
using sphmbs::Vec;
using Fluid = sphmbs::sph::Fluid<test::Gas<2>, sphmbs::execution::Serial>;
using Probes = examples::Probes<Fluid>;

struct Directory {
  fs::path path =
      fs::temp_directory_path() / ("sphmbs_probes_" + std::to_string(std::random_device{}()));
  Directory() { fs::create_directories(path); }
  ~Directory() { fs::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

/// Gas at 1e5 Pa in the lower left quarter of the domain from (0, 0) to (2, 2) m; `speed` disturbs
/// it.
Fluid quarter(double speed = 0) {
  auto cloud = test::disordered_cloud<2>(
      10, 0.1, 1,
      {.place = 0, .speed = speed, .density = 0, .pressure = 0, .smoothing = 0, .mass = 0});
  return Fluid(test::Gas<2>{}, test::cube<2>(2, false), std::move(cloud));
}

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  REQUIRE(stream.is_open());
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Table {
  std::string comment, head;
  std::vector<std::vector<double>> rows;
};

Table read(const fs::path& path) {
  std::istringstream stream(text_of(path));
  Table table;
  std::getline(stream, table.comment);
  std::getline(stream, table.head);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    table.rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      table.rows.back().push_back(cell == "nan" ? NAN : std::stod(cell));
  }
  return table;
}

/// What a session does with probes at the beginning of each step.
struct Observe {
  Probes* probes;
  examples::Report* report;
  const bool* begun = nullptr;  // if given, whether the probes have begun
  double barrier() const { return std::numeric_limits<double>::infinity(); }
  void observe(Fluid&, bool last) {
    if (begun != nullptr && !*begun) return;
    if (probes->due(last)) probes->observe(*report, last);
  }
};

/// Acts once, at the first step after a time, when all others have observed.
struct At {
  double time;
  std::function<void()> act;
  double barrier() const { return std::numeric_limits<double>::infinity(); }
  void observe(Fluid& fluid, bool) {
    if (!act || fluid.time() < time) return;
    act();
    act = {};
  }
};

struct Quiet {
  std::ostringstream out, err;
  examples::Report report{out, err, {.quiet = true}};
};

}  // namespace

TEST_CASE("probes write a file each, with units and what they saw", "[probes]") {
  const Directory directory;
  Fluid fluid = quarter();
  Probes probes({{.name = "gauge", .at = {0.5, 0.5}, .fields = {"p", "v", "T"}},
                 {.name = "far", .at = {1.9, 1.9}, .fields = {"p", "mach"}},
                 {.name = "cut", .kind = "line", .from = {0.5, 0.5}, .to = {0.5, 1.9}, .points = 8},
                 {.name = "map",
                  .kind = "plane",
                  .from = {0.8, 0.6},
                  .to = {0.2, 0.2},
                  .points = 4,
                  .fields = {"rho"}},
                 {.name = "box", .kind = "volume", .from = {0, 0}, .to = {1, 0.5}}},
                fluid);
  probes.add("gauge", {"twice", "Pa", [](const auto& gas) { return 2 * gas.p; }});
  probes.add("far", {"one", "-", [](const auto&) { return 1.0; }});
  CHECK_THROWS_AS(probes.add("nobody", {}), sphmbs::InvalidInput);
  probes.begin(directory.path, "case, sphmbs", 0.1);
  Quiet quiet;
  CHECK(probes.due());
  probes.observe(quiet.report);
  CHECK(!probes.due());
  CHECK(!probes.due(true));

  const Table gauge = read(directory.path / "probe_gauge.csv");
  CHECK(gauge.comment == "# case, sphmbs, point at (0.5, 0.5) m");
  CHECK(gauge.head == "t[s],p[Pa],v_x[m/s],v_y[m/s],T[K],twice[Pa],seen[-]");
  REQUIRE(gauge.rows.size() == 1);
  CHECK(gauge.rows[0][0] == 0);
  CHECK(gauge.rows[0][1] == Approx(1e5).epsilon(1e-12));
  CHECK(gauge.rows[0][4] == Approx(1e5 / 1.2 * 0.02895 / 8.314));
  CHECK(gauge.rows[0][5] == Approx(2e5).epsilon(1e-12));
  CHECK(gauge.rows[0][6] > 20);

  const Table far = read(directory.path / "probe_far.csv");
  REQUIRE(far.rows.size() == 1);
  for (const std::size_t column : {1u, 2u, 3u}) CHECK(std::isnan(far.rows[0][column]));
  CHECK(far.rows[0][4] == 0);

  const Table cut = read(directory.path / "probe_cut.csv");
  CHECK(cut.head == "t[s],s[m],p[Pa],seen[-]");
  REQUIRE(cut.rows.size() == 8);
  CHECK(cut.rows[3][1] == Approx(0.6));
  std::int64_t blind = 0;
  for (const auto& row : cut.rows) {
    CHECK(std::isnan(row[2]) == (row[3] == 0));
    blind += row[3] == 0;
  }
  CHECK(blind > 1);
  CHECK(blind < 5);

  const Table map = read(directory.path / "probe_map.csv");
  CHECK(map.head == "t[s],x[m],y[m],rho[kg/m^3],seen[-]");
  REQUIRE(map.rows.size() == 12);
  CHECK(map.rows[11][1] == Approx(0.8));
  CHECK(map.rows[11][2] == Approx(0.6));
  CHECK(map.rows[5][3] == Approx(1.2));
  const std::string vtp = text_of(directory.path / "probe_map_0001.vtp");
  CHECK_THAT(vtp, Catch::Contains("Name=\"rho [kg/m^3]\""));
  CHECK_THAT(vtp, Catch::Contains("NumberOfPoints=\"12\""));
  CHECK_THAT(vtp, Catch::Contains("NumberOfPolys=\"6\""));

  const Table box = read(directory.path / "probe_box.csv");
  CHECK(box.head ==
        "t[s],particles[-],mass[kg/m],volume[m^2],momentum_x[kg m/s/m],"
        "momentum_y[kg m/s/m],kinetic[J/m],internal[J/m],p[Pa]");
  REQUIRE(box.rows.size() == 1);
  CHECK(box.rows[0][1] == 50);
  CHECK(box.rows[0][2] == Approx(0.6));
  CHECK(box.rows[0][3] == Approx(0.5));
  CHECK(box.rows[0][7] == Approx(1e5 / 0.4 * 0.5));
  CHECK(box.rows[0][8] == Approx(1e5));

  CHECK_THAT(quiet.err.str(),
             Catch::Contains("probe far without gas: W030 no gas is seen at 1 of 1 place at"));
  CHECK_THAT(quiet.err.str(), Catch::Contains("probe cut without gas"));
  CHECK_THAT(quiet.err.str(), !Catch::Contains("gauge"));
  examples::Summary summary;
  probes.summarise(summary);
  REQUIRE(summary.results.size() == 2);
  CHECK(summary.results[0].name == "probe_far_without_gas");
  CHECK(summary.results[0].value == 1);
  CHECK(summary.results[1].value == static_cast<double>(blind));
}

TEST_CASE("each probe has its interval, changes no step, and goes on after a restart", "[probes]") {
  const std::vector<ProbeSpec> specs{
      {.name = "often", .at = {0.5, 0.5}, .interval = 4e-4},
      {.name = "as_history", .kind = "line", .from = {0.1, 0.1}, .to = {0.9, 0.9}, .points = 3},
      {.name = "plane", .kind = "plane", .from = {0, 0}, .to = {1, 1}, .points = 3}};
  constexpr double checkpoint = 1.95e-3, whole = 4e-3;
  const auto to = [](Fluid& fluid, double until, auto... observers) {
    sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = until, .step = 1e-4},
                sphmbs::no_report, observers...);
  };
  const Directory once, twice;
  Quiet quiet;
  Fluid a = quarter(20);
  Probes all(specs, a);
  all.begin(once.path, "case", 1e-3);
  to(a, whole, Observe{&all, &quiet.report});
  CHECK(read(once.path / "probe_often.csv").rows.size() == 11);
  CHECK(read(once.path / "probe_as_history.csv").rows.size() == 3 * 5);
  CHECK(fs::exists(once.path / "probe_plane_0005.vtp"));
  CHECK(!fs::exists(once.path / "probe_plane_0006.vtp"));
  Fluid without = quarter(20);
  to(without, whole);
  CHECK(a.totals().kinetic == without.totals().kinetic);

  // Stopped some time after a checkpoint: the last rows are written anew.
  Fluid b = quarter(20);
  Probes first(specs, b);
  first.begin(twice.path, "case", 1e-3);
  std::vector<examples::ProbeProgress> kept;
  to(b, whole - 5e-4, Observe{&first, &quiet.report},
     At{checkpoint, [&] { kept = first.progress(); }});
  REQUIRE(kept.size() == 3);
  CHECK(text_of(twice.path / "probe_often.csv").size() > static_cast<std::size_t>(kept[0].bytes));
  Fluid c = quarter(20);
  Probes second(specs, c);
  bool resumed = false;
  to(c, whole, Observe{&second, &quiet.report, &resumed}, At{checkpoint, [&] {
                                                               second.begin(twice.path, "case",
                                                                            1e-3, kept);
                                                               resumed = true;
                                                             }});
  for (const char* name :
       {"probe_often.csv", "probe_as_history.csv", "probe_plane.csv", "probe_plane_0005.vtp"}) {
    CAPTURE(name);
    CHECK(text_of(once.path / name) == text_of(twice.path / name));
  }
  CHECK(second.progress()[1].rows == 15);
  CHECK_THROWS_AS(second.begin(twice.path, "case", 1e-3, {kept[0]}), sphmbs::InvalidInput);
  kept[0].bytes = 1'000'000;
  CHECK_THROWS_AS(second.begin(twice.path, "case", 1e-3, kept), sphmbs::OutputError);
}

TEST_CASE("probes refuse what they cannot sample", "[probes]") {
  Fluid fluid = quarter();
  const auto refused = [&](const ProbeSpec& spec, const std::string& id, const std::string& text) {
    try {
      Probes probes({spec}, fluid);
    } catch (const sphmbs::InvalidInput& fault) {
      CHECK(fault.id == id);
      CHECK_THAT(fault.what(), Catch::Contains("probe \"" + spec.name + "\": "));
      CHECK_THAT(fault.what(), Catch::Contains(text));
      return;
    }
    FAIL("accepted: " << text);
  };
  refused({.name = "a", .at = {0.5, 2.5}}, "E050",
          "at = (0.5, 2.5) m: must lie in the domain, from (0, 0) to (2, 2) m");
  refused({.name = "a", .at = {0.5, 2.5}, .place = {"case.toml", 3, 1}}, "E050",
          "case.toml:3:1: error E050 probe \"a\": at = (0.5, 2.5) m: must lie in the domain");
  refused({.name = "a", .kind = "line", .from = {0, 0}, .to = {3, 0}}, "E050", "to = (3, 0) m");
  refused({.name = "a", .at = {0.5, 0.5}, .fields = {"p", "vx"}}, "E051",
          "field \"vx\": must be one of");
  refused({.name = "a", .at = {0.5}}, "E052", "at = (0.5): must have 2 coordinates");
  refused({.name = "a", .at = {0.5, NAN}}, "E052", "must be finite");
  refused({.name = "a"}, "E052", "at = (): must have 2 coordinates");
  refused({.name = "a b", .at = {0.5, 0.5}}, "E052", "letters, digits, - and _");
  refused({.name = "a", .kind = "ring"}, "E052", "kind = \"ring\": must be point, line");
  refused({.name = "a", .at = {1, 1}, .fields = {}}, "E052", "fields: must name at least one");
  refused({.name = "a", .at = {1, 1}, .interval = -1}, "E052", "interval = -1: must be positive");
  refused({.name = "a", .at = {1, 1}, .from = {1, 1}}, "E052", "without \"from\"");
  refused({.name = "a", .kind = "line", .from = {1, 1}, .to = {1, 1}}, "E052", "must differ");
  refused({.name = "a", .kind = "line", .from = {1, 1}, .to = {1, 0}, .points = 1}, "E052",
          "points = 1: must be between 2 and");
  refused({.name = "a", .kind = "plane", .from = {0, 0}, .to = {1, 0}}, "E052", "two axes");
  refused({.name = "a", .kind = "volume", .from = {0, 0}, .to = {1, 0}}, "E052", "2 axes");
  struct Structure {
  } structure;
  CHECK(examples::probes_of({}, structure).empty());
  CHECK_THROWS_WITH(examples::probes_of({{.name = "a", .at = {1, 1}}}, structure),
                    "probe \"a\": there is no gas to sample");
  struct Coupled {
    Fluid& gas;
    Fluid& fluid() { return gas; }
  } coupled{fluid};
  CHECK(!examples::probes_of({{.name = "a", .at = {1, 1}}}, coupled).empty());
  CHECK_THROWS_WITH(Probes({{.name = "a", .at = {1, 1}}, {.name = "a", .at = {0, 1}}}, fluid),
                    Catch::Contains("another probe has this name"));
}

TEST_CASE("places of probes in space, and beyond a period", "[probes]") {
  const examples::ProbeSpace space{
      .dim = 3, .lower = {0, 0, 0}, .upper = {1, 2, 3}, .periodic = {true, false, false}};
  const auto plane = examples::places_of(
      {.name = "a", .kind = "plane", .from = {0.5, 2, 1}, .to = {1.5, 2, 3}, .points = 5}, space);
  CHECK(plane.along_row == 3);
  CHECK(plane.points.size() == 15);
  CHECK(plane.points.back() == std::array<double, 3>{1.5, 2, 3});
  CHECK_THROWS_AS(examples::places_of(
                      {.name = "a", .kind = "plane", .from = {0, 0, 0}, .to = {1, 1, 1}}, space),
                  sphmbs::InvalidInput);
  CHECK_NOTHROW(examples::places_of(
      {.name = "a", .kind = "volume", .from = {0.5, 0, 0}, .to = {1.5, 1, 1}}, space));
  CHECK_THROWS_WITH(
      examples::places_of({.name = "a", .kind = "volume", .from = {0, 0, 0}, .to = {1.5, 1, 1}},
                          space),
      Catch::Contains("longer than the period"));
  const examples::ProbeSpace line{.dim = 1, .lower = {0, 0, 0}, .upper = {1, 0, 0}};
  CHECK(examples::places_of({.name = "a", .kind = "volume", .from = {0}, .to = {1}}, line)
            .points.size() == 2);
  CHECK_THROWS_AS(examples::places_of({.name = "a", .kind = "plane", .from = {0}, .to = {1}}, line),
                  sphmbs::InvalidInput);
}
