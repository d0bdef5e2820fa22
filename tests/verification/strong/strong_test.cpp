// SPDX-License-Identifier: MIT
// Shocks of pressure ratio 1e5, gas that is torn apart and gas that expands into next to nothing,
// against exact solutions.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/tube.hpp"

namespace {

namespace riemann = sphmbs::riemann;
using riemann::Primitive;
using test::Station;

const auto density = [](const Station& s) { return s.rho; };
const auto velocity = [](const Station& s) { return s.u; };
const auto pressure = [](const Station& s) { return s.p; };

/// Mean errors of density, velocity and pressure.
struct Errors {
  double rho, u, p;
};

/// @param exact  gives a Primitive at a place
template <class Exact>
Errors errors(const std::vector<Station>& gas, double a, double b, Exact&& exact) {
  return {test::mean_error(gas, a, b, density, [&](double x) { return exact(x).rho; }),
          test::mean_error(gas, a, b, velocity, [&](double x) { return exact(x).u; }),
          test::mean_error(gas, a, b, pressure, [&](double x) { return exact(x).p; })};
}

struct Case {
  const char* name;
  Primitive left;
  Primitive right;
  double time;
  double beyond;  // gas on either side of the unit length that is looked at [m]
};

template <class Gas>
Errors solve(const Case& c, int per_metre) {
  const long count = std::lround((0.5 + c.beyond) * per_metre);
  const bool walls = c.beyond == 0;
  const auto end = test::Tube()
                       .fill(c.left, -c.beyond, 0.5, count, walls, false)
                       .fill(c.right, 0.5, 1 + c.beyond, count, false, walls)
                       .template after<Gas>(c.time);
  REQUIRE(test::sound(end));
  const riemann::ExactSolution exact(c.left, c.right, 1.4);
  const Errors found = errors(end, 0, 1, [&](double x) { return exact.at((x - 0.5) / c.time); });
  std::cout << c.name << ", " << per_metre << " particles: L1 of rho " << found.rho << ", u "
            << found.u << ", p " << found.p << '\n';
  return found;
}

/// Errors at 100, 200 and 400 particles stay below their bounds, and those of density fall.
template <class Gas>
void check(const Case& c, const Errors (&bound)[3], double order) {
  const int size[] = {100, 200, 400};
  Errors found[3];
  for (int i = 0; i < 3; ++i) {
    found[i] = solve<Gas>(c, size[i]);
    CAPTURE(c.name, size[i]);
    CHECK(found[i].rho <= bound[i].rho);
    CHECK(found[i].u <= bound[i].u);
    CHECK(found[i].p <= bound[i].p);
  }
  CHECK(std::log2(found[0].rho / found[2].rho) / 2 >= order);
}

/// Gas of unit density and pressure at x < 0.5 that expands into vacuum from time 0 on: one
/// rarefaction, u + 2 c / (gamma - 1) = 2 c_0 / (gamma - 1).
Primitive into_vacuum(double x, double t) {
  const double c0 = std::sqrt(1.4);
  const double xi = (x - 0.5) / t;
  if (xi <= -c0) return {1, 0, 1};
  const double c = (5 * c0 - xi) / 6;
  if (c <= 0) return {0, 0, 0};
  return {std::pow(c / c0, 5), 5 * (c0 - c), std::pow(c / c0, 7)};
}

/// sum m |u - exact| / sum m: the mass counts, as the rim of the gas is thin without bounds.
template <class Exact>
double velocity_error(const std::vector<Station>& gas, Exact&& exact) {
  double sum = 0;
  double mass = 0;
  for (const Station& s : gas) {
    sum += s.m * std::abs(s.u - exact(s.x).u);
    mass += s.m;
  }
  return sum / mass;
}

double energy(const std::vector<Station>& gas) {
  double sum = 0;
  for (const Station& s : gas) sum += s.m * (s.p / (0.4 * s.rho) + 0.5 * s.u * s.u);
  return sum;
}

}  // namespace

// Measured: L1(rho) 4.71e-2, 2.52e-2, 1.54e-2 and 4.98e-2, 2.62e-2, 1.46e-2; u to 0.5 % of its
// largest value, p to 0.9 %. The paper's scheme has L1(rho) = 0.65 at any resolution: its faces do
// not push what they move.
TEST_CASE("blasts of pressure ratio 1e5 and 1e4 converge", "[strong]") {
  using Gas = test::ShockGas<1>;
  check<Gas>({"blast 1000 : 0.01", {1, 0, 1000}, {1, 0, 0.01}, 0.012, 0},
             {{5.1e-2, 0.34, 14}, {2.7e-2, 0.2, 7.5}, {1.65e-2, 0.11, 4.3}}, 0.78);
  check<Gas>({"blast 0.01 : 100", {1, 0, 0.01}, {1, 0, 100}, 0.035, 0},
             {{5.3e-2, 0.125, 1.55}, {2.8e-2, 0.065, 0.8}, {1.55e-2, 0.036, 0.43}}, 0.85);
}

TEST_CASE("the exact solver is as good at blasts as Hllc", "[strong]") {
  const Case blast{"blast 1000 : 0.01", {1, 0, 1000}, {1, 0, 0.01}, 0.012, 0};
  const Errors a = solve<test::ShockGas<1>>(blast, 200);
  const Errors b = solve<test::ShockGas<1, riemann::Exact>>(blast, 200);
  CHECK(b.rho == Approx(a.rho).epsilon(0.02));
  CHECK(b.u == Approx(a.u).epsilon(0.02));
  CHECK(b.p == Approx(a.p).epsilon(0.02));
}

// Toro's second test, "123": p falls to 0.0019, rho to 0.021. Measured: L1(rho) 5.53e-2, 2.98e-2,
// 1.54e-2.
TEST_CASE("gas that is torn apart keeps positive density and energy", "[strong]") {
  check<test::ShockGas<1>>(
      {"123", {1, -2, 0.4}, {1, 2, 0.4}, 0.15, 0.3},
      {{5.8e-2, 3.3e-2, 2.5e-2}, {3.2e-2, 2e-2, 1.25e-2}, {1.65e-2, 1.05e-2, 6.1e-3}}, 0.88);
}

// The free end of a gas is a vacuum without particles. Measured: L1(u) by mass 1.65e-2, 9.1e-3,
// 4.9e-3, L1(rho) 1.99e-2, 1.13e-2, 6.4e-3.
TEST_CASE("gas that expands into vacuum follows the exact rarefaction", "[strong]") {
  const double t = 0.1;
  const auto exact = [t](double x) { return into_vacuum(x, t); };
  const double u_bound[] = {1.75e-2, 9.8e-3, 5.3e-3};
  const double rho_bound[] = {2.1e-2, 1.2e-2, 6.8e-3};
  double u[3];
  for (int i = 0; i < 3; ++i) {
    const int n = 100 << i;
    const auto end =
        test::Tube().fill({1, 0, 1}, 0, 0.5, n / 2, true, false).after<test::ShockGas<1>>(t);
    REQUIRE(test::sound(end));
    u[i] = velocity_error(end, exact);
    double rho = 0;
    for (const Station& s : end) rho += s.volume() * std::abs(s.rho - exact(s.x).rho);
    std::cout << "into vacuum, " << n << " particles a metre: L1(u) " << u[i] << ", L1(rho) " << rho
              << ", fastest " << end.back().u << ", energy " << energy(end) << '\n';
    CAPTURE(n);
    CHECK(u[i] <= u_bound[i]);
    CHECK(rho <= rho_bound[i]);
    CHECK(energy(end) == Approx(1.25).epsilon(2e-4));
    CHECK(end.back().u < 2 * std::sqrt(1.4) / 0.4);  // the speed of escape
  }
  CHECK(std::log2(u[0] / u[2]) / 2 >= 0.85);
}

// Particles of equal mass: the thin gas is as coarse as its density says. Measured: L1(u) by mass
// 2.37e-2, 1.42e-2, 1.38e-2 with the thin gas's spacing of up to 10 m.
TEST_CASE("gas expands into gas of a millionth of its pressure", "[strong]") {
  const Primitive dense{1, 0, 1};
  const Primitive thin{1e-3, 0, 1e-6};
  const double t = 0.1;
  const riemann::ExactSolution solution(dense, thin, 1.4);
  const auto exact = [&](double x) { return solution.at((x - 0.5) / t); };
  const double bound[] = {2.6e-2, 1.6e-2, 1.55e-2};
  for (int i = 0; i < 3; ++i) {
    const int n = 100 << i;
    const auto end = test::Tube()
                         .fill(dense, 0, 0.5, n / 2, true, false)
                         .fill(thin, 0.5, 20.5, std::lround(20e-3 * n), false, true)
                         .after<test::ShockGas<1>>(t);
    REQUIRE(test::sound(end));
    const double u = velocity_error(end, exact);
    std::cout << "into gas of 1e-6 the pressure, " << n << " particles a metre: L1(u) " << u
              << ", energy " << energy(end) << '\n';
    CAPTURE(n);
    CHECK(u <= bound[i]);
  }
}

// On a lattice of equal spacing the masses differ as the densities, a thousandfold here. Pairs
// across the contact are not reconstructed, and the density of a light particle is not drawn to its
// heavy neighbours'; without either, energies were negative within five steps.
TEST_CASE("gas expands into gas of a millionth of its pressure, equal spacing", "[strong]") {
  const Primitive dense{1, 0, 1};
  const Primitive thin{1e-3, 0, 1e-6};
  const double t = 0.1;
  const riemann::ExactSolution solution(dense, thin, 1.4);
  const double bound[] = {2.1e-2, 1.1e-2, 6e-3};
  for (int i = 0; i < 3; ++i) {
    const int n = 100 << i;
    const auto end = test::Tube()
                         .fill(dense, 0, 0.5, n / 2, true, false)
                         .fill(thin, 0.5, 1, n / 2, false, true)
                         .after<test::ShockGas<1>>(t);
    REQUIRE(test::sound(end));
    const double u = velocity_error(end, [&](double x) { return solution.at((x - 0.5) / t); });
    std::cout << "into gas of 1e-6 the pressure, equal spacing, " << n
              << " particles a metre: L1(u) " << u << ", energy " << energy(end) << '\n';
    CHECK(u <= bound[i]);
    CHECK(energy(end) == Approx(1.25).epsilon(2e-4));
  }
}
