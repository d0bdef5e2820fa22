// SPDX-License-Identifier: MIT
// A thin plate across a closed box, gas of 1e4 Pa on its one side and of 1.1e4 Pa on the other.
#include <cmath>
#include <iostream>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"

namespace {

using sphmbs::Vec;
namespace geometry = sphmbs::geometry;

constexpr double spacing = 0.05;

struct Outcome {
  double difference;  // of the mean pressures [Pa]
  double force;       // on the plate [N/m]
  std::size_t crossed;
};

/// After one second.
template <class Gas>
Outcome hold(const Gas& gas, bool shielded, double until) {
  const geometry::Box<2> box{.lower = {0, 0}, .upper = {1, 2}};
  const geometry::Domain<2> domain{.box = box};
  const geometry::Lattice<2> lattice{.spacing = spacing, .origin = {spacing / 2, 0}};
  std::vector<Vec<2>> low, high, plate;
  for (const auto& x : lattice.points(box, domain))
    (std::abs(x[1] - 1) < 1e-6 ? plate : x[1] < 1 ? low : high).push_back(x);
  const auto air = [](double p) { return sphmbs::particles::State<2>{.rho = 1.293, .p = p}; };
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(low, air(1e4), {spacing});
  cloud.add_gas(high, air(1.1e4), {spacing});
  // The lattice has points on the floor and the ceiling, so that their surface is half a spacing
  // off.
  const geometry::Box<2> inside{.lower = {0, -spacing / 2}, .upper = {1, 2 + spacing / 2}};
  cloud.add_virtual(lattice.inner_points(box.grown(5.1 * spacing) - box, domain, 5.2 * spacing),
                    air(1e4), {spacing}, geometry::outside(inside));
  int sets[2];
  if (shielded) {
    const auto sides = cloud.add_sheet(plate, std::vector<Vec<2>>(plate.size(), Vec<2>{0, 1}),
                                       air(1e4), {spacing});
    sets[0] = sides.front;
    sets[1] = sides.back;
  } else {
    sets[0] = sets[1] = cloud.add_virtual(plate, air(1e4), {spacing});
  }
  sphmbs::sph::Fluid<Gas, sphmbs::execution::Serial> fluid(gas, domain, cloud);
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = until}, sphmbs::no_report);
  Outcome end{};
  double mean[2] = {}, count[2] = {};
  const auto fields = fluid.particles().fields();
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (fields.set[i] != sphmbs::particles::gas) continue;
    const bool upper = fields.id[i] >= low.size();
    mean[upper] += gas.eos.pressure(fields.rho[i], fields.e[i]);
    count[upper] += 1;
    end.crossed += (fields.r[1][i] > 1) != upper ? 1 : 0;
  }
  end.difference = mean[1] / count[1] - mean[0] / count[0];
  end.force = fluid.force_on(sets[0])[1] + (shielded ? fluid.force_on(sets[1])[1] : 0);
  std::cout << "plate, " << (shielded ? "shielded" : "one layer that both sides see")
            << ": pressure difference " << end.difference << " Pa after " << until << " s, force "
            << end.force << " N/m, " << end.crossed << " particles crossed\n";
  return end;
}

}  // namespace

TEST_CASE("a thin plate holds a pressure difference for a second", "[verification][slow][fault]") {
  for (const double background : {0.0, 1e4}) {
    const auto end = hold(
        sphmbs::sph::SmoothScheme<2>{.eos = {.gamma = 1.4}, .background = background}, true, 1);
    CHECK(end.difference == Approx(1000).epsilon(1e-6));  // measured: to rounding
    CHECK(end.crossed == 0);
    // 969 N/m: the rest of the 1000 N/m is borne by the walls behind the plate's rim.
    CHECK(end.force == Approx(-1000).epsilon(0.05));
  }
}

TEST_CASE("a plate of one layer that both sides see leaks", "[verification][fault]") {
  const auto end = hold(sphmbs::sph::PaperScheme<2>{.eos = {.gamma = 1.4}}, false, 0.1);
  CHECK(std::abs(end.difference) < 500);  // measured: 157 Pa
}
