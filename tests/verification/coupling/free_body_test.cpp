// SPDX-License-Identifier: MIT
// A free body in gas: what coupled runs conserve, at which order, and with which bits.
#include <cmath>
#include <vector>

#include "support/ball_in_gas.hpp"
#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/policies.hpp"
#include "support/state.hpp"

namespace {

namespace coupling = sphmbs::coupling;
namespace sph = sphmbs::sph;
using sphmbs::Vec;

/// Momentum of gas and body, and their energy.
struct Sums {
  Vec<2> momentum;
  double energy;
};

template <class Ball>
Sums sums(Ball& ball) {
  const auto totals = ball.fluid.totals();
  const auto v = ball.velocity();
  return {totals.momentum + ball.mass() * Vec<2>{v[0], v[1]},
          totals.energy() + totals.virtual_internal + ball.bodies.energies().kinetic};
}

template <class Ball, class Scheme>
void run(Ball& ball, const Scheme& scheme, double until, double step) {
  sphmbs::run(ball.system, scheme, {.until = until, .step = step}, sphmbs::no_report);
}

}  // namespace

TEMPLATE_TEST_CASE("momentum of gas and body is conserved to rounding", "[coupling]",
                   coupling::Staggered<>, coupling::Strong<>) {
  using Gas = sph::SmoothScheme<2>;
  for (const double ratio : {10.0, 0.3}) {
    CAPTURE(ratio);
    test::BallInGas<Gas> ball({.mass_ratio = ratio, .velocity = {0.3, 0.1}, .spin = 1});
    const Sums start = sums(ball);
    run(ball, TestType{}, 0.5, 0.01);
    const Sums end = sums(ball);
    const double exchanged = std::sqrt(norm2(ball.system.exchanged().impulse));
    CHECK(exchanged > 0.01);
    CHECK(std::sqrt(norm2(end.momentum - start.momentum)) < 1e-11 * exchanged);
  }
}

TEST_CASE("work that leaves the gas is what the body gets", "[coupling]") {
  using Gas = sph::SmoothScheme<2>;
  const auto lost = [](const auto& scheme, double step) {
    test::BallInGas<Gas> ball({.mass_ratio = 1, .velocity = {0.3, 0}});
    run(ball, scheme, 0.4, step);
    const auto& passed = ball.system.exchanged();
    CHECK(std::abs(passed.work_on_bodies) > 1e-3);
    return std::abs(passed.work_of_gas / passed.work_on_bodies - 1);
  };
  SECTION("strong: to rounding") { CHECK(lost(coupling::Strong<>{}, 0.02) < 1e-10); }
  SECTION("staggered: of second order") {
    const double coarse = lost(coupling::Staggered<>{}, 0.02);
    const double fine = lost(coupling::Staggered<>{}, 0.01);
    CHECK(coarse < 1e-3);
    CHECK(coarse / fine > 3);
  }
}

TEST_CASE("sub-cycling keeps momentum", "[coupling]") {
  using Gas = sph::SmoothScheme<2>;
  for (const auto& scheme :
       {coupling::Staggered<>{.gas_steps = 3}, coupling::Staggered<>{.structure_steps = 4}}) {
    test::BallInGas<Gas> ball({.mass_ratio = 5, .velocity = {0.3, 0.1}});
    const Sums start = sums(ball);
    run(ball, scheme, 0.48, scheme.gas_steps > 1 ? 0.03 : 0.01);
    CHECK(ball.fluid.time() == Approx(0.48));
    CHECK(ball.bodies.time() == Approx(0.48));
    CHECK(ball.fluid.statistics().steps == 48);
    CHECK(std::sqrt(norm2(sums(ball).momentum - start.momentum)) < 1e-13);
    // One step a time differs by what the longer way costs.
    test::BallInGas<Gas> plain({.mass_ratio = 5, .velocity = {0.3, 0.1}});
    run(plain, coupling::Staggered<>{}, 0.48, 0.01);
    CHECK((ball.velocity() - plain.velocity()).norm() < 1e-5);
    CHECK((ball.velocity() - plain.velocity()).norm() > 0);
  }
}

TEST_CASE("sub-cycled gas takes the steps that its stability allows", "[coupling]") {
  using Gas = sph::SmoothScheme<2>;
  const auto steps = [](int gas_steps) {
    test::BallInGas<Gas> ball({.mass_ratio = 5, .velocity = {0.1, 0}});
    sphmbs::run(ball.system, coupling::Staggered<>{.gas_steps = gas_steps}, {.until = 1},
                sphmbs::no_report);
    CHECK(ball.bodies.statistics().steps * gas_steps ==
          static_cast<long>(ball.fluid.statistics().steps));
    return static_cast<double>(ball.fluid.statistics().steps);
  };
  CHECK(steps(3) == Approx(steps(1)).epsilon(0.1));
}

TEST_CASE("coupling schemes converge to each other at second order in the step", "[coupling]") {
  using Gas = sph::SmoothScheme<2>;
  const auto speed = [](const auto& scheme, double step) {
    test::BallInGas<Gas> ball({.mass_ratio = 1, .velocity = {0.1, 0}});
    run(ball, scheme, 0.32, step);
    return ball.velocity()[0];
  };
  const double reference = speed(coupling::Strong<>{}, 0.00125);
  const auto order = [&](const auto& scheme) {
    const double coarse = speed(scheme, 0.01) - reference, fine = speed(scheme, 0.005) - reference;
    CAPTURE(coarse, fine);
    CHECK(std::abs(coarse) < 1e-4);
    return std::log2(std::abs(coarse / fine));
  };
  CHECK(order(coupling::Strong<>{}) > 1.7);
  CHECK(order(coupling::Staggered<>{}) > 1.7);
}

TEST_CASE("a body much lighter than the gas needs the strong coupling", "[coupling][fault]") {
  using Gas = sph::SmoothScheme<2>;
  const auto speed = [](const auto& scheme) {
    test::BallInGas<Gas> ball({.mass_ratio = 0.02, .velocity = {0.01, 0}});
    run(ball, scheme, 1, 0.03);
    return ball.velocity().norm();
  };
  double staggered = 0;
  try {
    staggered = speed(coupling::Staggered<>{});
  } catch (const sphmbs::NumericalFailure&) {
    staggered = 1;
  }
  CHECK(staggered > 0.05);
  CHECK(speed(coupling::Strong<>{}) < 0.01);
  CHECK(speed(coupling::Strong<coupling::Relaxation>{}) < 0.01);
  CHECK(speed(coupling::Strong<coupling::Aitken>{}) < 0.01);
}

TEST_CASE("coupled runs have the same bits on any number of threads", "[coupling]") {
  using Gas = sph::SmoothScheme<2>;
  const auto result = [](auto policy, int threads) {
    omp_set_num_threads(threads);
    test::BallInGas<Gas, decltype(policy)> ball(
        {.spacing = 0.06, .velocity = {0.3, 0.1}, .spin = 1});
    run(ball, coupling::Strong<>{}, 0.05, 0.01);
    const auto& s = ball.bodies.state();
    return std::pair(test::state_of(ball.fluid), std::vector<double>(s.q.begin(), s.q.end()));
  };
  const auto serial = result(sphmbs::execution::Serial{}, 1);
  for (const int threads : {1, 2, 4}) {
    const auto parallel = result(sphmbs::execution::OpenMP{}, threads);
    CHECK(same_bits(serial.first, parallel.first));
    CHECK(test::same_bits(serial.second, parallel.second));
  }
}

TEST_CASE("a body goes round a periodic box many times", "[coupling]") {
  using Gas = sph::PaperScheme<2>;
  // So heavy that it goes on.
  test::BallInGas<Gas> ball({.spacing = 0.2, .side = 4, .mass_ratio = 1e4, .velocity = {0.5, 0}});
  sphmbs::run(ball.system, coupling::Staggered<>{}, {.until = 20}, sphmbs::no_report);
  const auto r = ball.body.point({0, 0}).at(ball.bodies.state().q);
  CHECK(r[0] == Approx(2 + 20 * 0.5).epsilon(0.01));
}

TEST_CASE("a strong coupling that does not come to agree says so", "[coupling][fault]") {
  using Gas = sph::SmoothScheme<2>;
  test::BallInGas<Gas> ball({.mass_ratio = 0.1, .velocity = {0.1, 0}});
  const auto complaint = test::complaint<sphmbs::NumericalFailure>(
      [&] { coupling::Strong<>{.most = 1}.step(ball.system, [] { return 0.02; }); });
  CHECK(test::mentions(complaint, {"t = 0", "do not agree after 1 repetitions", "--cfl",
                                   "the change of the forces"}));
  // What was computed stands.
  CHECK(ball.fluid.time() == ball.bodies.time());
}
