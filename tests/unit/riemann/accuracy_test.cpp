// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/riemann/exact.hpp>
#include <sphmbs/riemann/exact_solution.hpp>
#include <sphmbs/riemann/hllc.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "unit/riemann/problems.hpp"

namespace {

using sphmbs::eos::IdealGas;
using sphmbs::riemann::Exact;
using sphmbs::riemann::ExactSolution;
using sphmbs::riemann::Hllc;
using sphmbs::riemann::Star;
using sphmbs::riemann::State;
using test::Problem;
using test::state_of;

const Problem sod{{1, 0, 1}, {0.125, 0, 0.1}};
const Problem two_fans{{1, -2, 0.4}, {1, 2, 0.4}};
const Problem left_blast{{1, 0, 1000}, {1, 0, 0.01}};
const Problem right_blast{{1, 0, 0.01}, {1, 0, 100}};
const Problem collision{{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}};

template <class T = double, class Solver>
Star<double> solve(const Solver& solver, const IdealGas& gas, const Problem& problem) {
  const auto star =
      solver.star(gas, state_of<T>(gas, problem.left), state_of<T>(gas, problem.right));
  return {star.p, star.u};
}

/// Errors of p* by p*, and of u* by the larger of the two jumps of velocity.
Star<double> error(const IdealGas& gas, const Problem& problem, const Star<double>& found) {
  const auto exact = ExactSolution(problem.left, problem.right, gas.gamma).star();
  const double jump =
      std::max(std::abs(exact.u - problem.left.u), std::abs(exact.u - problem.right.u));
  return {std::abs(found.p - exact.p) / exact.p, std::abs(found.u - exact.u) / jump};
}

/// Gases apart by up to `decades` in pressure, closing by up to `mach` of the larger sound speed,
/// or opening where that is negative.
Problem some_problem(const IdealGas& gas, test::Random& random, double decades, double mach) {
  Problem problem = test::some_problem_at_rest(random, decades);
  auto& [left, right] = problem;
  const double closing =
      random.unit() * mach *
      std::max(gas.sound_speed(left.rho, left.p), gas.sound_speed(right.rho, right.p));
  left.u = 0.5 * closing;
  right.u = -0.5 * closing;
  return problem;
}

}  // namespace

TEST_CASE("the exact solver solves Toro's five problems", "[riemann]") {
  const IdealGas gas;
  for (const Problem& problem : {sod, two_fans, left_blast, right_blast, collision}) {
    const auto wrong = error(gas, problem, solve(Exact{}, gas, problem));
    CHECK(wrong.p < 1e-10);
    CHECK(wrong.u < 1e-10);
    const auto in_float = error(gas, problem, solve<float>(Exact{}, gas, problem));
    CHECK(in_float.p < 2e-5);
    CHECK(in_float.u < 2e-6);
  }
}

TEST_CASE("the exact solver meets the exact solution of strong problems", "[riemann]") {
  test::Random random(1);
  for (const double gamma : {1.1, 1.4, 5.0 / 3, 3.0}) {
    const IdealGas gas{.gamma = gamma};
    for (int trial = 0; trial < 500; ++trial) {
      const double mach = (trial % 4 - 1) * 1.0;
      const Problem problem = some_problem(gas, random, 1 + trial % 10, mach);
      const auto wrong = error(gas, problem, solve(Exact{}, gas, problem));
      CAPTURE(gamma, trial);
      CHECK(wrong.p < 1e-10);
      CHECK(wrong.u < 1e-10);
    }
  }
}

TEST_CASE("in vacuum the exact solver gives the mean of both escape speeds", "[riemann]") {
  const IdealGas gas;
  const auto l = state_of(gas, {1, -20, 1});
  const auto r = state_of(gas, {0.2, 20, 3});
  const auto star = Exact{}.star(gas, l, r);
  CHECK(star.p == 0);
  CHECK(star.u == Approx(0.5 * (l.u + 5 * l.c + r.u - 5 * r.c)).epsilon(1e-14));
}

TEST_CASE("gas that runs into vacuum itself is accelerated to half its escape speed", "[riemann]") {
  const IdealGas gas;
  const auto l = state_of(gas, {1, 0, 1});
  const State<double> nothing{1e-3, 5 * l.c * 1.001, 0, 0};
  const auto star = Exact{}.star(gas, l, nothing);
  CHECK(star.p == 0);
  CHECK(star.u == Approx(0.5 * (5 * l.c + nothing.u)).epsilon(1e-14));
}

TEST_CASE("a cold side is the limit of a side of little pressure", "[riemann]") {
  const IdealGas gas;
  for (const double u : {-3.0, 0.0, 2.0, 4.0}) {
    const auto l = state_of(gas, {1, 0, 1});
    const auto cold = Exact{}.star(gas, l, {0.5, u, 0, 0});
    const auto cool = Exact{}.star(gas, l, state_of(gas, {0.5, u, 1e-16}));
    CHECK(cold.p == Approx(cool.p).epsilon(1e-7));
    CHECK(cold.u == Approx(cool.u).epsilon(1e-7));
  }
}

TEST_CASE("HLLC is near the exact solution of Toro's problems", "[riemann]") {
  const IdealGas gas;
  const auto wrong = [&](const Problem& problem) {
    return error(gas, problem, solve(Hllc{}, gas, problem));
  };
  const auto check = [&](const Problem& problem, double p, double u) {
    const auto found = wrong(problem);
    CAPTURE(found.p, found.u);
    CHECK(found.p < p);
    CHECK(found.u < u);
  };
  check(sod, 0.009, 0.036);
  check(left_blast, 0.008, 0.034);
  check(right_blast, 0.008, 0.034);
  check(collision, 0.001, 0.001);
  CHECK(solve(Hllc{}, gas, two_fans).p == 0);  // exact: 0.0019, between states of 0.4
}

TEST_CASE("HLLC is near the exact solution of strong problems", "[riemann]") {
  struct Kind {
    double decades, mach;  // of `some_problem`
    double p, u;           // bounds of all errors
    double median_p, median_u;
  };
  const Kind kinds[] = {{5, 0, 0.11, 0.2, 0.0025, 0.03},
                        {5, 3, 0.11, 0.15, 0.0025, 0.001},
                        {2, 30, 0.035, 0.032, 1e-5, 1e-5},
                        {0.3, -1, 0.11, 0.017, 0.0025, 0.001}};
  for (const double gamma : {1.4, 5.0 / 3}) {
    const IdealGas gas{.gamma = gamma};
    for (const Kind& kind : kinds) {
      test::Random random(2);
      std::vector<double> p, u;
      for (int trial = 0; trial < 2000; ++trial) {
        const Problem problem = some_problem(gas, random, kind.decades, kind.mach);
        const auto wrong = error(gas, problem, solve(Hllc{}, gas, problem));
        p.push_back(wrong.p);
        u.push_back(wrong.u);
      }
      std::sort(p.begin(), p.end());
      std::sort(u.begin(), u.end());
      CAPTURE(gamma, kind.decades, kind.mach, p.back(), u.back(), p[1000], u[1000]);
      CHECK(p.back() < kind.p);
      CHECK(u.back() < kind.u);
      CHECK(p[1000] < kind.median_p);
      CHECK(u[1000] < kind.median_u);
    }
  }
}
