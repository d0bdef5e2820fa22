// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <sphmbs/core/pack.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/riemann/exact_solution.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"

namespace {

using sphmbs::riemann::Acoustic;
using sphmbs::riemann::ExactSolution;
using sphmbs::riemann::Primitive;
using sphmbs::riemann::State;

constexpr double heat_ratio = 1.4;
constexpr double rounding = 1e-14;

State<double> state_of(const Primitive& s) {
  return {s.rho, s.u, s.p, std::sqrt(heat_ratio * s.p / s.rho)};
}

State<double> some_state(test::Random& random) {
  return state_of({random.between(0.5, 3), random.between(-50, 50), random.between(1e4, 2e5)});
}

double impedance(const State<double>& s) { return s.rho * s.c; }

/// The difference of star pressures and velocities, each by its natural scale.
double distance(const sphmbs::riemann::Star<double>& a, const sphmbs::riemann::Star<double>& b,
                const Primitive& scale) {
  const double c = std::sqrt(heat_ratio * scale.p / scale.rho);
  return std::hypot((a.p - b.p) / scale.p, (a.u - b.u) / c);
}

}  // namespace

TEST_CASE("two equal states meet in the same state", "[riemann]") {
  test::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const auto s = some_state(random);
    const auto star = Acoustic{}.star(s, s);
    CHECK(star.p == Approx(s.p).epsilon(rounding));
    CHECK(std::abs(star.u - s.u) < rounding * s.c);
  }
}

TEST_CASE("two states of one velocity and pressure keep them across a jump of density",
          "[riemann]") {
  const auto star = Acoustic{}.star(state_of({1, 7, 1e5}), state_of({30, 7, 1e5}));
  CHECK(star.p == Approx(1e5).epsilon(rounding));
  CHECK(star.u == Approx(7).epsilon(1e-12));
}

TEST_CASE("the mirror image of a problem has the mirror image as its solution", "[riemann]") {
  test::Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const auto l = some_state(random);
    const auto r = some_state(random);
    const auto star = Acoustic{}.star(l, r);
    auto mirrored_l = r;
    auto mirrored_r = l;
    mirrored_l.u = -r.u;
    mirrored_r.u = -l.u;
    const auto mirrored = Acoustic{}.star(mirrored_l, mirrored_r);
    CHECK(std::abs(mirrored.p - star.p) < rounding * (l.p + r.p + impedance(l) * 100));
    CHECK(std::abs(mirrored.u + star.u) < rounding * (l.c + r.c));
  }
}

TEST_CASE("a moving observer sees the same pressure and a shifted velocity", "[riemann]") {
  test::Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    auto l = some_state(random);
    auto r = some_state(random);
    const auto star = Acoustic{}.star(l, r);
    const double shift = random.between(-100, 100);
    l.u += shift;
    r.u += shift;
    const auto shifted = Acoustic{}.star(l, r);
    CHECK(std::abs(shifted.p - star.p) < 1e-12 * (l.p + r.p));
    CHECK(std::abs(shifted.u - star.u - shift) < 1e-12 * (l.c + r.c));
  }
}

TEST_CASE("both acoustic waves carry their jump relations", "[riemann]") {
  test::Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const auto l = some_state(random);
    const auto r = some_state(random);
    const auto star = Acoustic{}.star(l, r);
    const double tolerance = 1e-13 * (l.p + r.p + 100 * (impedance(l) + impedance(r)));
    CHECK(std::abs(star.p - l.p + impedance(l) * (star.u - l.u)) < tolerance);
    CHECK(std::abs(star.p - r.p - impedance(r) * (star.u - r.u)) < tolerance);
  }
}

TEST_CASE("between equal impedances p* is the mean plus rho c (ul - ur) / 2", "[riemann]") {
  const State<double> l{1.2, 30, 1.0e5, 340};
  const State<double> r{1.2, -10, 1.4e5, 340};
  const auto star = Acoustic{}.star(l, r);
  CHECK(star.p == Approx(1.2e5 + 1.2 * 340 * 20).epsilon(rounding));
  CHECK(star.u == Approx(10 - 0.4e5 / (2 * 1.2 * 340)).epsilon(rounding));
}

TEST_CASE("pressure from the left pushes to the right, and approach compresses", "[riemann]") {
  const auto calm = state_of({1, 0, 1e5});
  CHECK(Acoustic{}.star(state_of({1, 0, 2e5}), calm).u > 0);
  CHECK(Acoustic{}.star(state_of({1, 10, 1e5}), calm).p > 1e5);
  CHECK(Acoustic{}.star(state_of({1, -10, 1e5}), calm).p < 1e5);
}

TEST_CASE("the acoustic solution differs from the exact one by the square of the jump",
          "[riemann]") {
  const Primitive base{1.2, 0, 1e5};
  const double c = std::sqrt(heat_ratio * base.p / base.rho);
  const auto error = [&](double size) {
    const Primitive l{base.rho * (1 + 0.5 * size), 0.3 * size * c, base.p * (1 + size)};
    const Primitive r{base.rho * (1 - 0.8 * size), -0.7 * size * c, base.p * (1 - 0.4 * size)};
    return distance(Acoustic{}.star(state_of(l), state_of(r)),
                    ExactSolution(l, r, heat_ratio).star(), base);
  };
  for (const double size : {0.1, 0.05, 0.025, 0.0125}) {
    const double order = std::log2(error(size) / error(size / 2));
    CAPTURE(size, order);
    CHECK(order > 1.9);
    CHECK(order < 2.2);
  }
}

TEST_CASE("single precision and packs agree with double precision", "[riemann]") {
  using sphmbs::Pack;
  test::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    State<Pack<double, 4>> l, r;
    State<double> left[4], right[4];
    for (int i = 0; i < 4; ++i) {
      left[i] = some_state(random);
      right[i] = some_state(random);
      l.rho.v[i] = left[i].rho, l.u.v[i] = left[i].u, l.p.v[i] = left[i].p, l.c.v[i] = left[i].c;
      r.rho.v[i] = right[i].rho, r.u.v[i] = right[i].u;
      r.p.v[i] = right[i].p, r.c.v[i] = right[i].c;
    }
    const auto packed = Acoustic{}.star(l, r);
    for (int i = 0; i < 4; ++i) {
      const auto plain = Acoustic{}.star(left[i], right[i]);
      const auto single = [](const State<double>& s) {
        return State<float>{static_cast<float>(s.rho), static_cast<float>(s.u),
                            static_cast<float>(s.p), static_cast<float>(s.c)};
      };
      const auto in_single = Acoustic{}.star(single(left[i]), single(right[i]));
      const double p_scale = left[i].p + right[i].p + 100 * impedance(left[i]);
      const double u_scale = left[i].c + right[i].c;
      CHECK(std::abs(packed.p.v[i] - plain.p) < rounding * p_scale);
      CHECK(std::abs(packed.u.v[i] - plain.u) < rounding * u_scale);
      CHECK(std::abs(static_cast<double>(in_single.p) - plain.p) < 1e-6 * p_scale);
      CHECK(std::abs(static_cast<double>(in_single.u) - plain.u) < 1e-6 * u_scale);
    }
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
