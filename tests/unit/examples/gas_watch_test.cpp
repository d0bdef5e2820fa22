// SPDX-License-Identifier: MIT
// What a run says and does about gas that gets lost.
#include "support/gas_watch.hpp"

#include <filesystem>
#include <sstream>
#include <string>

#include <unistd.h>

#include <sphmbs/io/checkpoints.hpp>
#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/setups.hpp"

namespace {

namespace examples = sphmbs::examples;
using Catch::Matchers::Contains;
using Fluid = sphmbs::sph::Fluid<sphmbs::sph::PaperScheme<2>, sphmbs::execution::Serial>;

constexpr double side = 1.8, spacing = 0.1;

Fluid some_fluid(bool with_opening = false) {
  auto cloud = test::lattice_cloud<2>(18, spacing, test::still_air<2>());
  auto domain = test::cube<2>(side, !with_opening);
  if (with_opening) {
    domain.box.lower[0] -= 4 * spacing;
    const sphmbs::geometry::Box<2> zone{.lower = domain.box.lower, .upper = {0, side}};
    cloud.add_opening(
        {.lower = zone.lower,
         .upper = zone.upper,
         .axis = 0,
         .side = 1,
         .far = test::still_air<2>(),
         .distance = side},
        sphmbs::geometry::Lattice<2>{.spacing = spacing, .origin = {0.05, 0.05}}.points(zone,
                                                                                        domain),
        {spacing});
  }
  return {{}, domain, cloud};
}

void heat(Fluid& fluid, double factor) {
  const auto fields = fluid.particles().fields();
  for (std::size_t i = 0; i < fluid.size(); ++i) fields.e[i] *= factor;
}

struct Console {
  std::ostringstream out{}, err{};
  examples::Report report{out, err, {}};
};

}  // namespace

TEST_CASE("gas that is all there is not warned of", "[guards]") {
  Fluid fluid = some_fluid();
  examples::GasWatch watch(fluid);
  watch.guard({});
  Console console;
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = 1e-4, .cfl = 0.4},
              sphmbs::no_report);
  watch.look(console.report);
  CHECK(console.err.str().empty());
  examples::Summary summary;
  watch.summarise(summary);
  CHECK(std::abs(summary.conservation.mass) < 1e-14);
  CHECK(std::abs(summary.conservation.energy) < 1e-6);
  CHECK(summary.incidents.lost == 0);
}

TEST_CASE("energy that gets lost is warned of once, and much of it ends the run", "[guards]") {
  Fluid fluid = some_fluid();
  examples::GasWatch watch(fluid);
  Console console;
  watch.guard({});
  heat(fluid, 0.95);
  watch.look(console.report);
  watch.look(console.report);
  CHECK_THAT(console.err.str(), Contains("warning: balance of the gas: W320 energy at t = 0 s"));
  CHECK(console.err.str().find("W320") == console.err.str().rfind("W320"));
  examples::Summary summary;
  watch.summarise(summary);
  CHECK(summary.conservation.energy == Approx(-0.05));
  heat(fluid, 0.7);
  SECTION("by itself") { CHECK_THROWS_AS(watch.look(console.report), sphmbs::BeyondModel); }
  SECTION("not where a warning is enough") {
    watch.guard({.balance = "warn"});
    watch.look(console.report);
  }
  SECTION("not beyond what the run allows") {
    watch.guard({.energy = 0.5});
    watch.look(console.report);
  }
}

TEST_CASE("where gas comes in and goes out nothing ends the run", "[guards]") {
  Fluid fluid = some_fluid(true);
  examples::GasWatch watch(fluid);
  Console console;
  watch.guard({});
  heat(fluid, 2);
  watch.look(console.report);
  CHECK_THAT(console.err.str(), Contains("W320"));
}

TEST_CASE("who does not want to know is told nothing", "[guards]") {
  Fluid fluid = some_fluid();
  examples::GasWatch watch(fluid);
  Console console;
  watch.guard({.balance = "off"});
  heat(fluid, 3);
  watch.look(console.report);
  CHECK(console.err.str().empty());
}

TEST_CASE("a run that goes on tells again what was told before", "[guards]") {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("sphmbs_watch_" + std::to_string(::getpid()));
  Fluid fluid = some_fluid();
  examples::GasWatch watch(fluid), later(fluid);
  Console console, second;
  heat(fluid, 1.05);
  watch.look(console.report);
  const auto path = sphmbs::io::Checkpoints(folder).write(
      1, {}, [&](sphmbs::io::StateWriter& archive) { archive("watch", watch); });
  sphmbs::io::CheckpointFile file(path);
  sphmbs::io::StateReader archive(file);
  archive("watch", later);
  heat(fluid, 1 / 1.05);
  later.look(second.report);
  CHECK(second.err.str() == console.err.str());
  fs::remove_all(folder);
}
