// SPDX-License-Identifier: MIT
// The best schemes, with walls of known surface and a thin body, on every execution policy.
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/sph/presets.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::Vec;
constexpr double spacing = 0.1;

struct Walls {
  static constexpr int dim = 2;
  double distance(Vec<2> x) const { return std::min(x[1] - 0.4, 3.6 - x[1]); }
};

/// Gas in a channel, periodic along x, between two walls and around a plate.
sphmbs::particles::Cloud<2> channel() {
  std::vector<Vec<2>> gas, wall, plate;
  for (const auto& x : test::cell_centres<2>(40, spacing)) {
    if (x[1] < 0.4 || x[1] > 3.6)
      wall.push_back(x);
    else if (std::abs(x[1] - 2.05) < 0.01 && x[0] > 1 && x[0] < 3)
      plate.push_back(x);
    else
      gas.push_back(x);
  }
  const auto air = test::still_air<2>();
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(gas, air, {.spacing = spacing});
  test::disturb(cloud, spacing, 95, {.place = 0.1, .speed = 10, .density = 0.05, .pressure = 0.05});
  cloud.add_virtual(wall, air, {.spacing = spacing}, Walls{});
  cloud.add_sheet(plate, std::vector<Vec<2>>(plate.size(), Vec<2>{0, 1}), air,
                  {.spacing = spacing});
  return cloud;
}

template <class Scheme, class Policy, class T>
test::State<2> ten_steps() {
  auto domain = test::cube<2>(4, true);
  domain.periodic[1] = false;
  Scheme gas{};
  gas.background = 9e4;
  gas.acceleration = {100, 0};
  sphmbs::sph::Fluid<Scheme, Policy, sphmbs::boundary::Fixed, T> fluid(gas, domain, channel());
  for (int step = 0; step < 10; ++step)
    sphmbs::time::PredictorCorrector{}.step(
        fluid, [&] { return sphmbs::sph::step_limit(fluid.survey(), 0.25).dt; });
  CHECK(fluid.statistics().rebuilds > 1);
  return test::state_of(fluid);
}

template <class Scheme, class T>
void check_policies() {
  const auto serial = ten_steps<Scheme, sphmbs::execution::Serial, T>();
  for (const double e : serial.e) REQUIRE(std::isfinite(e));
  for (const int count : {1, 2, 3}) {
    const test::Threads threads(count);
    CHECK(same_bits(ten_steps<Scheme, sphmbs::execution::OpenMP, T>(), serial));
  }
}

}  // namespace

TEST_CASE("the best schemes give the same bits on every policy and number of threads", "[sph]") {
  check_policies<sphmbs::sph::SmoothScheme<2>, double>();
  check_policies<sphmbs::sph::SmoothScheme<2, sphmbs::sph::Newtonian>, double>();
  check_policies<sphmbs::sph::ShockScheme<2>, double>();
  check_policies<sphmbs::sph::SmoothScheme<2>, float>();
}
