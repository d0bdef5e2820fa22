// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>

#include "support/cable_cantilever.hpp"
#include "support/catch.hpp"

using namespace sphmbs::mbs;
using ancf::Cable, ancf::Engineering, ancf::Green;
using test::bend, test::Bent, test::displacement, test::to_rounding, test::ExactRod, test::order,
    test::RodLoad, test::unit_rod;

// Cables in space bend in a slanted plane as those in the plane do, whose tests have the tables.

TEMPLATE_TEST_CASE("in space, a thin cantilever bends to the elastica in any plane", "[mbs]", Green,
                   Engineering) {
  for (const double alpha : {1.0, 10.0}) {
    RodLoad load = unit_rod(1e6);
    load.force = {0, alpha};
    const test::Elastica elastica(alpha);
    const Bent bent = bend<Cable<3, TestType>>(load, 32);
    CAPTURE(alpha, bent.tip.transpose(), bent.found.iterations);
    CHECK(std::abs(1 - bent.tip[0] - elastica.shortening) < 2e-5);
    CHECK(std::abs(bent.tip[1] - elastica.deflection) < 2e-5);
    CHECK(std::abs(bent.angle - elastica.angle) < 2e-5);
    CHECK(bent.aside < 1e-9);
  }
}

TEMPLATE_TEST_CASE("in space, a cantilever under a tip force converges to the exact rod", "[mbs]",
                   Green, Engineering) {
  RodLoad load = unit_rod(1e3);
  load.force = {0, 10};
  const ExactRod<TestType> exact(load);
  double before = 0, error = 0;
  for (const int n : {16, 32}) {
    before = error;
    error = (bend<Cable<3, TestType>>(load, n, to_rounding).tip - exact.tip()).norm();
  }
  CAPTURE(before, error, order(before, error));
  CHECK(error < 3e-7);
  CHECK(order(before, error) > 3.85);
}

TEMPLATE_TEST_CASE("in space, a moment 2 pi EI/L bends a cantilever to a full circle", "[mbs]",
                   Green, Engineering) {
  RodLoad load = unit_rod(1e3);
  load.moment = 2 * std::numbers::pi;
  const ExactRod<TestType> exact(load);
  double before = 0, error = 0, aside = 0;
  for (const int n : {16, 32}) {
    const Bent bent = bend<Cable<3, TestType>>(load, n, {.first_step = 0.1});
    before = error;
    error = (bent.tip - exact.tip()).norm();
    aside = bent.aside;
  }
  CAPTURE(before, error, order(before, error), aside);
  CHECK(error < 1e-5);
  CHECK(order(before, error) > 3.85);
  CHECK(aside < 1e-8);
}

TEST_CASE("in space, cantilevers bend as independent codes say", "[mbs]") {
  constexpr double nine_digits = 1.5e-9, six_digits = 1.5e-6;
  const RodLoad tip_force = test::gerstmayr_irschik();
  const RodLoad weight{.length = 2, .EA = 1e6, .EI = 833.3333333, .line_load = {0, -78 * 9.81}};
  const auto moved = [](auto measure, const RodLoad& load, int n) {
    return displacement(bend<Cable<3, decltype(measure)>>(load, n, to_rounding).tip, load);
  };
  CHECK((moved(Engineering{}, tip_force, 8) - Vector<2>(-0.508509237, -1.207197756)).norm() <
        nine_digits);
  CHECK((moved(Green{}, tip_force, 8) - Vector<2>(-0.508894944, -1.208355963)).norm() <
        nine_digits);
  CHECK((moved(Engineering{}, weight, 32) - Vector<2>(-0.501305814, -1.232510003)).norm() <
        nine_digits);
  CHECK((moved(Green{}, weight, 32) - Vector<2>(-0.502297303, -1.234456033)).norm() < nine_digits);

  RodLoad thin = unit_rod(1e7);
  thin.force = {0, 10};
  CHECK((bend<Cable<3, Green>>(thin, 32).tip - Vector<2>(0.445040, 0.810559)).norm() < six_digits);
}
