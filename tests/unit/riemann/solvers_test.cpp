// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>

#include <sphmbs/core/pack.hpp>
#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/eos/stiffened_gas.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/riemann/exact.hpp>
#include <sphmbs/riemann/hllc.hpp>
#include <sphmbs/riemann/limited_acoustic.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"
#include "unit/riemann/problems.hpp"

namespace {

using sphmbs::Pack;
using sphmbs::Scalar;
using sphmbs::eos::IdealGas;
using sphmbs::eos::StiffenedGas;
using sphmbs::riemann::Acoustic;
using sphmbs::riemann::Exact;
using sphmbs::riemann::Hllc;
using sphmbs::riemann::LimitedAcoustic;
using sphmbs::riemann::Star;
using sphmbs::riemann::State;
using test::impedance;
using test::power_of_ten;
using test::some_state;
using test::state_of;

using Solvers = std::tuple<Acoustic, LimitedAcoustic, Hllc, Exact>;
using GammaLawSolvers = std::tuple<Hllc, Exact>;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Pair {
  State<double> left;
  State<double> right;
};

/// Gases apart by up to `decades` in pressure, their velocities by up to `mach` of the larger sound
/// speed, closing or opening.
Pair strong_pair(const IdealGas& gas, test::Random& random, double decades, double mach) {
  const auto problem = test::some_problem_at_rest(random, decades);
  Pair pair{state_of(gas, problem.left), state_of(gas, problem.right)};
  const double c = std::max(pair.left.c, pair.right.c);
  pair.left.u = random.between(-mach, mach) * c;
  pair.right.u = random.between(-mach, mach) * c;
  return pair;
}

Pair mirrored(const Pair& pair) {
  Pair image{pair.right, pair.left};
  image.left.u = -pair.right.u;
  image.right.u = -pair.left.u;
  return image;
}

/// What rounding of p* and u* is measured by.
Star<double> size_of(const Pair& pair, double p_inf = 0) {
  const double u = std::abs(pair.left.u) + std::abs(pair.right.u) + pair.left.c + pair.right.c;
  const double p = pair.left.p + pair.right.p + 2 * p_inf;
  const double rho = std::max(pair.left.rho, pair.right.rho);
  return {p + rho * u * u, u + p / std::max(1e-12, impedance(pair.left) + impedance(pair.right))};
}

void check_close(const Star<double>& a, const Star<double>& b, const Star<double>& size,
                 double tolerance) {
  CAPTURE(a.p, b.p, size.p, a.u, b.u, size.u);
  CHECK(std::abs(a.p - b.p) <= tolerance * size.p);
  CHECK(std::abs(a.u - b.u) <= tolerance * size.u);
}

template <class N>
void set_lane(State<N>& pack, int lane, const State<double>& s) {
  using T = Scalar<N>;
  pack.rho.v[lane] = static_cast<T>(s.rho);
  pack.u.v[lane] = static_cast<T>(s.u);
  pack.p.v[lane] = static_cast<T>(s.p);
  pack.c.v[lane] = static_cast<T>(s.c);
}

template <class N>
State<Scalar<N>> lane_of(const State<N>& pack, int lane) {
  return {pack.rho.v[lane], pack.u.v[lane], pack.p.v[lane], pack.c.v[lane]};
}

/// Packs of different kinds of problems against the same problems one by one.
template <class N, class Solver>
void check_lanes(const Solver& solver, const IdealGas& gas) {
  using T = Scalar<N>;
  const double tolerance = 200 * static_cast<double>(std::numeric_limits<T>::epsilon());
  test::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    State<N> l, r;
    for (int lane = 0; lane < N::lanes; ++lane) {
      const Pair pair = strong_pair(gas, random, lane, lane % 3);
      set_lane(l, lane, pair.left);
      set_lane(r, lane, pair.right);
    }
    const auto packed = solver.star(gas, l, r);
    for (int lane = 0; lane < N::lanes; ++lane) {
      const auto left = lane_of(l, lane);
      const auto right = lane_of(r, lane);
      const auto plain = solver.star(gas, left, right);
      const Pair pair{{left.rho, left.u, left.p, left.c}, {right.rho, right.u, right.p, right.c}};
      check_close({packed.p.v[lane], packed.u.v[lane]}, {plain.p, plain.u}, size_of(pair),
                  tolerance);
    }
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("two equal states meet in the same state", "[riemann]", Solvers) {
  const TestType solver;
  test::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const IdealGas gas;
    const auto s = some_state(gas, random);
    check_close(solver.star(gas, s, s), {s.p, s.u}, {s.p, s.c}, 1e-14);
    const StiffenedGas water;
    const auto w = some_state(water, random);
    check_close(solver.star(water, w, w), {w.p, w.u}, {water.stiffness, w.c}, 1e-14);
  }
}

TEMPLATE_LIST_TEST_CASE("the mirror image of a problem has the mirror image as its solution",
                        "[riemann]", Solvers) {
  const TestType solver;
  const IdealGas gas;
  test::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Pair pair = strong_pair(gas, random, trial % 8, trial % 4);
    const Pair image = mirrored(pair);
    const auto star = solver.star(gas, pair.left, pair.right);
    const auto other = solver.star(gas, image.left, image.right);
    check_close(star, {other.p, -other.u}, size_of(pair), 1e-14);
  }
}

TEMPLATE_LIST_TEST_CASE("a moving observer sees the same pressure and a shifted velocity",
                        "[riemann]", Solvers) {
  const TestType solver;
  const IdealGas gas;
  test::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Pair pair = strong_pair(gas, random, trial % 8, trial % 4);
    const auto star = solver.star(gas, pair.left, pair.right);
    const double shift = random.between(-1, 1) * (pair.left.c + pair.right.c);
    pair.left.u += shift;
    pair.right.u += shift;
    const auto shifted = solver.star(gas, pair.left, pair.right);
    check_close({star.p, star.u + shift}, shifted, size_of(pair), 1e-12);
  }
}

TEMPLATE_LIST_TEST_CASE("units of mass and speed scale the solution", "[riemann]", Solvers) {
  const TestType solver;
  const IdealGas gas;
  test::Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Pair pair = strong_pair(gas, random, trial % 8, trial % 4);
    const double density = power_of_ten(random, -4, 4);
    const double speed = power_of_ten(random, -4, 4);
    const double pressure = density * speed * speed;
    const auto scaled = [&](const State<double>& s) {
      return State<double>{density * s.rho, speed * s.u, pressure * s.p, speed * s.c};
    };
    const auto star = solver.star(gas, pair.left, pair.right);
    const auto other = solver.star(gas, scaled(pair.left), scaled(pair.right));
    check_close(star, {other.p / pressure, other.u / speed}, size_of(pair), 1e-12);
  }
}

TEMPLATE_LIST_TEST_CASE("weak waves are acoustic but for the square of the jump", "[riemann]",
                        GammaLawSolvers) {
  const TestType solver;
  const IdealGas gas;
  const double c = gas.sound_speed(1.2, 1e5);
  for (const double sign : {1.0, -1.0}) {
    const auto difference = [&](double size) {
      size *= sign;
      const auto l = state_of(gas, {1.2 * (1 + 0.5 * size), 0.3 * size * c, 1e5 * (1 + size)});
      const auto r =
          state_of(gas, {1.2 * (1 - 0.8 * size), -0.7 * size * c, 1e5 * (1 - 0.4 * size)});
      const auto star = solver.star(gas, l, r);
      const auto weak = Acoustic{}.star(gas, l, r);
      return std::hypot((star.p - weak.p) / 1e5, (star.u - weak.u) / c);
    };
    for (const double size : {0.04, 0.02, 0.01}) {
      const double order = std::log2(difference(size) / difference(size / 2));
      CAPTURE(sign, size, order);
      CHECK(order > 1.9);
      CHECK(order < 2.2);
    }
  }
}

TEMPLATE_LIST_TEST_CASE("a pack of problems has the solutions of each of them", "[riemann]",
                        Solvers) {
  for (const double gamma : {1.4, 5.0 / 3}) {
    const IdealGas gas{.gamma = gamma};
    const TestType solver;
    check_lanes<Pack<double, 2>>(solver, gas);
    check_lanes<Pack<double, 4>>(solver, gas);
    check_lanes<Pack<double, 8>>(solver, gas);
    check_lanes<Pack<float, 4>>(solver, gas);
    check_lanes<Pack<float, 8>>(solver, gas);
  }
}

TEMPLATE_LIST_TEST_CASE("single precision agrees with double precision", "[riemann]", Solvers) {
  const TestType solver;
  const IdealGas gas;
  const auto single = [](const State<double>& s) {
    return State<float>{static_cast<float>(s.rho), static_cast<float>(s.u), static_cast<float>(s.p),
                        static_cast<float>(s.c)};
  };
  test::Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Pair pair = strong_pair(gas, random, trial % 6, trial % 4);
    const auto star = solver.star(gas, single(pair.left), single(pair.right));
    check_close({star.p, star.u}, solver.star(gas, pair.left, pair.right), size_of(pair), 5e-6);
  }
}

TEMPLATE_LIST_TEST_CASE("gas without pressure on both sides has a finite answer", "[riemann]",
                        Solvers) {
  const TestType solver;
  const IdealGas gas;
  for (const double speed : {0.0, 1.0, -1.0, 1e3, -1e3})
    for (const double rho : {1.0, 1e-3}) {
      const State<double> l{1, speed, 0, 0};
      const State<double> r{rho, -speed, 0, 0};
      const auto star = solver.star(gas, l, r);
      CAPTURE(speed, rho, star.p, star.u);
      CHECK(std::isfinite(star.p));
      CHECK(std::abs(star.u) <= std::abs(speed) * (1 + 1e-14));
      const State<float> lf{1, static_cast<float>(speed), 0, 0};
      const State<float> rf{static_cast<float>(rho), static_cast<float>(-speed), 0, 0};
      const auto in_float = solver.star(gas, lf, rf);
      CHECK(std::isfinite(in_float.p));
      CHECK(std::abs(static_cast<double>(in_float.u)) <= std::abs(speed) * (1 + 1e-6));
    }
}

TEMPLATE_LIST_TEST_CASE("strong states, vacuum and cold streams have finite answers", "[riemann]",
                        Solvers) {
  constexpr bool keeps_off_tension =
      std::is_same_v<TestType, Hllc> || std::is_same_v<TestType, Exact>;
  const TestType solver;
  test::Random random(7);
  for (const double gamma : {1.1, 1.4, 5.0 / 3, 3.0}) {
    const IdealGas gas{.gamma = gamma};
    for (int trial = 0; trial < 1000; ++trial) {
      Pair pair = strong_pair(gas, random, trial % 21, power_of_ten(random, -2, 3));
      if (trial % 10 == 0) pair.left.p = pair.left.c = 0;
      if (trial % 20 == 0) pair.right.p = pair.right.c = 0;
      const auto star = solver.star(gas, pair.left, pair.right);
      CAPTURE(gamma, trial, star.p, star.u);
      CHECK(std::isfinite(star.p));
      CHECK(std::isfinite(star.u));
      if (keeps_off_tension) CHECK(star.p >= 0);
    }
  }
}

TEMPLATE_LIST_TEST_CASE("cold streams collide with the pressure of the strong shock", "[riemann]",
                        GammaLawSolvers) {
  for (const double gamma : {1.4, 5.0 / 3}) {
    const IdealGas gas{.gamma = gamma};
    for (const double p : {0.0, 1e-6}) {
      const auto star = TestType{}.star(gas, state_of(gas, {1, 1, p}), state_of(gas, {1, -1, p}));
      CHECK(star.p == Approx((gamma + 1) / 2).epsilon(2e-3));
      CHECK(std::abs(star.u) < 1e-15);
    }
  }
}

TEMPLATE_LIST_TEST_CASE("gas that parts faster than it can follow leaves vacuum", "[riemann]",
                        GammaLawSolvers) {
  const IdealGas gas;
  const StiffenedGas water;
  CHECK(TestType{}.star(gas, state_of(gas, {1, -10, 1}), state_of(gas, {1, 10, 1})).p == 0);
  const auto star =
      TestType{}.star(water, state_of(water, {1e3, -1e4, 1e5}), state_of(water, {1e3, 1e4, 1e5}));
  CHECK(star.p == Approx(-water.stiffness).epsilon(1e-14));
  const StiffenedGas soft{.gamma = 4.4, .stiffness = 1};
  const auto beside_strong =
      TestType{}.star(soft, state_of(soft, {1, -1e10, 1e16}), state_of(soft, {1, 1e10, 0}));
  CHECK(beside_strong.p == Approx(-1).epsilon(1e-14));
}

TEMPLATE_LIST_TEST_CASE("a stiffened gas is an ideal gas of another pressure", "[riemann]",
                        GammaLawSolvers) {
  const TestType solver;
  test::Random random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const StiffenedGas stiff{.gamma = 4.4, .stiffness = power_of_ten(random, -3, 3)};
    const IdealGas ideal{.gamma = 4.4};
    const Pair pair = strong_pair(ideal, random, trial % 8, trial % 3);
    const auto lowered = [&](State<double> s) {
      s.p -= stiff.stiffness;
      return s;
    };
    auto star = solver.star(stiff, lowered(pair.left), lowered(pair.right));
    star.p += stiff.stiffness;
    check_close(star, solver.star(ideal, pair.left, pair.right), size_of(pair, stiff.stiffness),
                1e-11);
  }
}

TEST_CASE("the limited solver is the acoustic one in strong compression", "[riemann]") {
  const IdealGas gas;
  const LimitedAcoustic solver;
  const auto l = state_of(gas, {1.2, 150, 1.3e5});
  const auto r = state_of(gas, {0.8, 0, 1e5});
  const auto star = solver.star(gas, l, r);
  const auto full = Acoustic{}.star(gas, l, r);
  CHECK(star.p == Approx(full.p).epsilon(1e-14));
  CHECK(star.u == Approx(full.u).epsilon(1e-14));
}

TEST_CASE("the limited solver takes means where gas expands", "[riemann]") {
  const IdealGas gas;
  const auto l = state_of(gas, {1.2, -30, 1.3e5});
  const auto r = state_of(gas, {0.8, 20, 1e5});
  const auto star = LimitedAcoustic{}.star(gas, l, r);
  const double Zl = impedance(l);
  const double Zr = impedance(r);
  CHECK(star.p == Approx((Zr * l.p + Zl * r.p) / (Zl + Zr)).epsilon(1e-14));
  CHECK(star.u == Approx((Zl * l.u + Zr * r.u) / (Zl + Zr)).epsilon(1e-14));
}

TEST_CASE("the limited solver weighs both dissipations with the closing speed", "[riemann]") {
  const IdealGas gas;
  const auto l = state_of(gas, {1.2, 10, 1.3e5});
  const auto r = state_of(gas, {0.8, 0, 1e5});
  for (const double strength : {0.5, 3.0}) {
    const LimitedAcoustic solver{.strength = strength};
    const double share = strength * 10 / (0.5 * (l.c + r.c));
    const auto star = solver.star(gas, l, r);
    const auto full = Acoustic{}.star(gas, l, r);
    auto opening = l;
    opening.u = r.u;
    const double Z = impedance(l) * impedance(r) / (impedance(l) + impedance(r));
    const double mean = LimitedAcoustic{}.star(gas, opening, r).p;
    CHECK(star.p == Approx(mean + share * Z * 10).epsilon(1e-13));
    const double diffusion = (l.p - r.p) / (impedance(l) + impedance(r));
    CHECK(star.u == Approx(full.u - (1 - share) * diffusion).epsilon(1e-13));
  }
}

TEST_CASE("a strength of the limiter out of range is refused by its name", "[riemann]") {
  for (const double strength : {0.0, -1.0, infinity, std::nan("")})
    CHECK(test::mentions(test::refusal([&] { LimitedAcoustic{.strength = strength}.check(); }),
                         {"strength", "positive and finite"}));
  CHECK(test::refusal([] { LimitedAcoustic{}.check(); }).empty());
}
