// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/riemann/exact_solution.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"
#include "unit/riemann/problems.hpp"

namespace {

using sphmbs::riemann::Acoustic;
using sphmbs::riemann::ExactSolution;
using sphmbs::riemann::Primitive;
using sphmbs::riemann::State;
using test::impedance;
using test::some_state;
using test::state_of;

constexpr double heat_ratio = 1.4;
constexpr double rounding = 1e-14;
constexpr sphmbs::eos::IdealGas gas{.gamma = heat_ratio};

/// The difference of star pressures and velocities, each by its natural scale.
double distance(const sphmbs::riemann::Star<double>& a, const sphmbs::riemann::Star<double>& b,
                const Primitive& scale) {
  const double c = std::sqrt(heat_ratio * scale.p / scale.rho);
  return std::hypot((a.p - b.p) / scale.p, (a.u - b.u) / c);
}

}  // namespace

TEST_CASE("two states of one velocity and pressure keep them across a jump of density",
          "[riemann]") {
  const auto star = Acoustic{}.star(gas, state_of(gas, {1, 7, 1e5}), state_of(gas, {30, 7, 1e5}));
  CHECK(star.p == Approx(1e5).epsilon(rounding));
  CHECK(star.u == Approx(7).epsilon(1e-12));
}

TEST_CASE("both acoustic waves carry their jump relations", "[riemann]") {
  test::Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const auto l = some_state(gas, random);
    const auto r = some_state(gas, random);
    const auto star = Acoustic{}.star(gas, l, r);
    const double tolerance = 1e-13 * (l.p + r.p + 100 * (impedance(l) + impedance(r)));
    CHECK(std::abs(star.p - l.p + impedance(l) * (star.u - l.u)) < tolerance);
    CHECK(std::abs(star.p - r.p - impedance(r) * (star.u - r.u)) < tolerance);
  }
}

TEST_CASE("between equal impedances p* is the mean plus rho c (ul - ur) / 2", "[riemann]") {
  const State<double> l{1.2, 30, 1.0e5, 340};
  const State<double> r{1.2, -10, 1.4e5, 340};
  const auto star = Acoustic{}.star(gas, l, r);
  CHECK(star.p == Approx(1.2e5 + 1.2 * 340 * 20).epsilon(rounding));
  CHECK(star.u == Approx(10 - 0.4e5 / (2 * 1.2 * 340)).epsilon(rounding));
}

TEST_CASE("pressure from the left pushes to the right, and approach compresses", "[riemann]") {
  const auto calm = state_of(gas, {1, 0, 1e5});
  CHECK(Acoustic{}.star(gas, state_of(gas, {1, 0, 2e5}), calm).u > 0);
  CHECK(Acoustic{}.star(gas, state_of(gas, {1, 10, 1e5}), calm).p > 1e5);
  CHECK(Acoustic{}.star(gas, state_of(gas, {1, -10, 1e5}), calm).p < 1e5);
}

TEST_CASE("the acoustic solution differs from the exact one by the square of the jump",
          "[riemann]") {
  const Primitive base{1.2, 0, 1e5};
  const double c = std::sqrt(heat_ratio * base.p / base.rho);
  const auto error = [&](double size) {
    const Primitive l{base.rho * (1 + 0.5 * size), 0.3 * size * c, base.p * (1 + size)};
    const Primitive r{base.rho * (1 - 0.8 * size), -0.7 * size * c, base.p * (1 - 0.4 * size)};
    return distance(Acoustic{}.star(gas, state_of(gas, l), state_of(gas, r)),
                    ExactSolution(l, r, heat_ratio).star(), base);
  };
  for (const double size : {0.1, 0.05, 0.025, 0.0125}) {
    const double order = std::log2(error(size) / error(size / 2));
    CAPTURE(size, order);
    CHECK(order > 1.9);
    CHECK(order < 2.2);
  }
}

TEST_CASE("the exact solution meets the star states of Toro's table 4.3", "[riemann]") {
  // Printed to about six digits.
  struct Row {
    Primitive l, r;
    double p, u;
  };
  const Row rows[] = {
      {{1, 0, 1}, {0.125, 0, 0.1}, 0.30313, 0.92745},
      {{1, -2, 0.4}, {1, 2, 0.4}, 0.00189, 0.0},
      {{1, 0, 1000}, {1, 0, 0.01}, 460.894, 19.5975},
      {{1, 0, 0.01}, {1, 0, 100}, 46.0950, -6.19633},
      {{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 1691.64, 8.68975}};
  for (const Row& row : rows) {
    const auto star = ExactSolution(row.l, row.r, heat_ratio).star();
    CHECK(std::abs(star.p - row.p) < 6e-6 * std::max(1.0, row.p));
    CHECK(std::abs(star.u - row.u) < 6e-6 * std::max(1.0, std::abs(row.u)));
  }
}

TEST_CASE("shocks of the exact solution conserve mass, momentum and energy", "[riemann]") {
  const Primitive l{1, 0, 1e5};
  const Primitive r{0.3, -200, 2e4};
  const ExactSolution solution(l, r, heat_ratio);
  const Primitive behind = solution.at(solution.star().u + 1e-6);
  const double speed = (behind.rho * behind.u - r.rho * r.u) / (behind.rho - r.rho);
  const auto momentum = [&](const Primitive& s) { return s.rho * (s.u - speed) * s.u + s.p; };
  const auto energy = [&](const Primitive& s) {
    const double total = s.p / (heat_ratio - 1) + s.rho * s.u * s.u / 2;
    return total * (s.u - speed) + s.p * s.u;
  };
  CHECK(momentum(behind) == Approx(momentum(r)).epsilon(1e-12));
  CHECK(energy(behind) == Approx(energy(r)).epsilon(1e-12));
  CHECK(solution.at(speed + 1e-6).p == r.p);
  CHECK(solution.at(speed - 1e-6).p == behind.p);
}

TEST_CASE("rarefactions of the exact solution keep entropy and their invariant", "[riemann]") {
  const auto check = [](const Primitive& outer, const ExactSolution& solution, double sign) {
    const auto sound = [](const Primitive& s) { return std::sqrt(heat_ratio * s.p / s.rho); };
    const double head = outer.u + sign * sound(outer);
    const double tail = solution.star().u;
    for (double share = 0.01; share < 1; share += 0.07) {
      const Primitive s = solution.at(head + share * (tail - head));
      CHECK(s.p / std::pow(s.rho, heat_ratio) ==
            Approx(outer.p / std::pow(outer.rho, heat_ratio)).epsilon(1e-12));
      CHECK(s.u - sign * 2 * sound(s) / (heat_ratio - 1) ==
            Approx(outer.u - sign * 2 * sound(outer) / (heat_ratio - 1)).epsilon(1e-12));
    }
  };
  const Primitive dense{1, 0, 1e5};
  const Primitive thin{0.3, 0, 2e4};
  check(dense, ExactSolution(dense, thin, heat_ratio), -1);
  check(dense, ExactSolution(thin, dense, heat_ratio), 1);
}

TEST_CASE("the exact solution refuses vacuum and states that are not physical", "[riemann]") {
  using Catch::Matchers::Contains;
  const auto refusal = [](const Primitive& l, const Primitive& r, double g) {
    return test::refusal([&] { ExactSolution(l, r, g); });
  };
  CHECK(refusal({1, 0, 1}, {1, 0, 1}, heat_ratio).empty());
  CHECK_THAT(refusal({1, -10, 1}, {1, 10, 1}, heat_ratio), Contains("velocity jump = 20"));
  CHECK_THAT(refusal({-1, 0, 1}, {1, 0, 1}, heat_ratio), Contains("density = -1"));
  CHECK_THAT(refusal({1, 0, 1}, {1, 0, 0}, heat_ratio), Contains("pressure = 0"));
  CHECK_THAT(refusal({1, 0, 1}, {1, 0, 1}, 1), Contains("gamma = 1"));
}
