// SPDX-License-Identifier: MIT
// What a gas between walls has gained is what the walls and the body force have given.
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::Vec;

constexpr double spacing = 0.1;
constexpr int across = 12;  // gas particles along a side
constexpr int layers = 5;
constexpr double side = across * spacing;

/// Disordered air around the origin in a box of walls that are not disordered.
sphmbs::particles::Cloud<2> closed_box() {
  std::vector<Vec<2>> gas, wall;
  for (Vec<2> x : test::cell_centres<2>(across + 2 * layers, spacing)) {
    x = x - Vec<2>::all((across / 2 + layers) * spacing);
    const bool inside = std::abs(x[0]) < side / 2 && std::abs(x[1]) < side / 2;
    (inside ? gas : wall).push_back(x);
  }
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_virtual(wall, test::still_air<2>(), {.spacing = spacing});
  const std::size_t begin = cloud.size();
  cloud.add_gas(gas, test::still_air<2>(), {.spacing = spacing});
  test::disturb(cloud, spacing, 41, {.place = 0.2, .density = 0.1, .pressure = 0.2}, begin);
  return cloud;
}

struct Balance {
  double energy;         // gained and not given, share of the energy exchanged
  double impulse;        // gained and not given, share of the momentum that passed
  double driving_share;  // work of the walls / energy at first
  double body_share;     // work of the body force / energy at first
};

template <class Motion, class Integrator>
Balance balance(const Integrator& integrator, const Motion& motion, int steps) {
  const test::Gas<2> gas{.eos = {.gamma = 1.4}, .acceleration = {3e4, -2e4}};
  sphmbs::sph::Fluid<test::Gas<2>, sphmbs::execution::Serial, Motion> fluid(
      gas, test::cube<2>(side, false), closed_box(), motion);
  const auto start = fluid.totals();
  const double until = 2e-3;  // about two passages of sound across the box
  double passed = 0;
  for (int step = 0; step < steps; ++step) {
    const Vec<2> before = fluid.exchange().impulse();
    integrator.step(fluid, [&] { return until / steps; });
    passed += test::length(fluid.exchange().impulse() - before);
  }
  const auto end = fluid.totals();
  const auto& given = fluid.exchange();
  const double gained =
      end.energy() + end.virtual_internal - start.energy() - start.virtual_internal;
  const double energy = start.energy();
  return {(gained - given.driving_work() - given.body_work()) / energy,
          test::length(end.momentum - start.momentum - given.impulse()) / passed,
          given.driving_work() / energy, given.body_work() / energy};
}

/// The balance of energy holds up to the steps: its error falls with the order of the method at
/// least. That of momentum, which is linear, holds to rounding.
template <class Integrator, class Motion>
Balance check(const std::string& name, const Integrator& integrator, const Motion& motion,
              double order) {
  constexpr double slack = 0.25;  // steps of a Courant number of 0.3 are not small yet
  const int steps = 50;
  Balance found[3];
  for (int level = 0; level < 3; ++level) {
    found[level] = balance(integrator, motion, steps << level);
    CAPTURE(name, level);
    CHECK(found[level].impulse < 1e-12);
  }
  const double orders[] = {std::log2(std::abs(found[0].energy / found[1].energy)),
                           std::log2(std::abs(found[1].energy / found[2].energy))};
  std::cout << name << ": energy " << found[0].energy << ' ' << found[1].energy << ' '
            << found[2].energy << " of the gas's not accounted for, order " << orders[0] << ' '
            << orders[1] << "; momentum " << found[0].impulse << ' ' << found[1].impulse << ' '
            << found[2].impulse << "; work of the walls " << found[2].driving_share
            << ", of the body force " << found[2].body_share << '\n';
  CAPTURE(name, found[0].energy, found[1].energy, found[2].energy);
  CHECK(orders[0] >= order - slack);
  CHECK(orders[1] >= order - slack);
  return found[2];
}

template <class Motion>
void check_all(const std::string& walls, const Motion& motion, bool moving) {
  const auto checks = [&](const Balance& found) {
    // The body force has done work that the balance would miss, and so have moving walls.
    CHECK(std::abs(found.body_share) > 1e-3);
    if (moving)
      CHECK(found.driving_share > 1e-2);
    else
      CHECK(found.driving_share == 0);
  };
  checks(check(walls + ", PredictorCorrector", sphmbs::time::PredictorCorrector{}, motion, 2));
  checks(check(walls + ", Heun", sphmbs::time::Heun{}, motion, 2));
  checks(check(walls + ", ShuOsher", sphmbs::time::ShuOsher{}, motion, 3));
}

}  // namespace

TEST_CASE("energy and momentum of disordered gas between fixed walls balance", "[conservation]") {
  check_all("fixed walls", sphmbs::boundary::Fixed{}, false);
}

TEST_CASE("energy and momentum of disordered gas between moving walls balance", "[conservation]") {
  check_all("moving walls", sphmbs::boundary::Contraction{.length = side, .speed = 40}, true);
}
