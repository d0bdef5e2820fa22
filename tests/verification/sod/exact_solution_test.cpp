// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <sphmbs/riemann/exact_solution.hpp>

#include "support/catch.hpp"

namespace {

using sphmbs::riemann::ExactSolution;
using sphmbs::riemann::Primitive;

constexpr double heat_ratio = 1.4;

/// The five test problems of Toro (2009), tables 4.1 to 4.3: what lies left and right, and between
/// the outer waves pressure, velocity and the densities on both sides of the contact, as printed.
struct Problem {
  const char* name;
  Primitive left;
  Primitive right;
  double p, u, rho_left, rho_right;
};

constexpr Problem problems[] = {
    {"1", {1, 0, 1}, {0.125, 0, 0.1}, 0.30313, 0.92745, 0.42632, 0.26557},
    {"2", {1, -2, 0.4}, {1, 2, 0.4}, 0.00189, 0, 0.02185, 0.02185},
    {"3", {1, 0, 1000}, {1, 0, 0.01}, 460.894, 19.5975, 0.57506, 5.99924},
    {"4", {1, 0, 0.01}, {1, 0, 100}, 46.0950, -6.19633, 5.99242, 0.57511},
    {"5",
     {5.99924, 19.5975, 460.894},
     {5.99242, -6.19633, 46.0950},
     1691.64,
     8.68975,
     14.2823,
     31.0426}};

ExactSolution solve(const Problem& problem) { return {problem.left, problem.right, heat_ratio}; }

double sound(const Primitive& s) { return std::sqrt(heat_ratio * s.p / s.rho); }

/// Half a unit of the sixth digit, or of the fifth decimal, whichever is more: what print leaves.
double printed(double value) { return std::max(0.6e-5, 0.6e-5 * std::abs(value)); }

/// Fluxes of mass, momentum and energy through a front that moves with speed s.
struct Flux {
  double mass, momentum, energy;
};

Flux flux(const Primitive& q, double s) {
  const double w = q.u - s;
  const double enthalpy = heat_ratio / (heat_ratio - 1) * q.p / q.rho;
  return {q.rho * w, q.rho * w * w + q.p, q.rho * w * (enthalpy + w * w / 2)};
}

/// Where along xi, between two speeds with different flows, the density jumps by bisection.
double front(const ExactSolution& flow, double inside, double outside) {
  const double rho = flow.at(outside).rho;
  for (int i = 0; i < 200; ++i) {
    const double middle = (inside + outside) / 2;
    (flow.at(middle).rho == rho ? outside : inside) = middle;
  }
  return outside;
}

}  // namespace

TEST_CASE("the exact Riemann solution meets the published star states", "[riemann]") {
  for (const Problem& problem : problems) {
    CAPTURE(problem.name);
    const ExactSolution flow = solve(problem);
    const auto star = flow.star();
    CHECK(star.p == Approx(problem.p).margin(printed(problem.p)).epsilon(0));
    CHECK(star.u == Approx(problem.u).margin(printed(problem.u)).epsilon(0));
    const double beside = 1e-9 * (1 + std::abs(star.u));
    CHECK(flow.at(star.u - beside).rho ==
          Approx(problem.rho_left).margin(printed(problem.rho_left)).epsilon(0));
    CHECK(flow.at(star.u + beside).rho ==
          Approx(problem.rho_right).margin(printed(problem.rho_right)).epsilon(0));
  }
}

TEST_CASE("mass, momentum and energy pass the exact solution's shocks", "[riemann]") {
  int shocks = 0;
  for (const Problem& problem : problems) {
    const ExactSolution flow = solve(problem);
    for (const double side : {-1.0, 1.0}) {
      const Primitive& ahead = side < 0 ? problem.left : problem.right;
      if (flow.star().p <= ahead.p) continue;
      ++shocks;
      CAPTURE(problem.name, side);
      const double inside = flow.star().u + side * 1e-6;
      const double speed = front(flow, inside, ahead.u + side * 1e3 * sound(ahead));
      const Flux before = flux(flow.at(speed + side * 1e-6), speed);
      const Flux after = flux(flow.at(speed - side * 1e-6), speed);
      // The speed is known to rounding; the jump itself is algebra.
      CHECK(after.mass == Approx(before.mass).epsilon(1e-10));
      CHECK(after.momentum == Approx(before.momentum).epsilon(1e-10));
      CHECK(after.energy == Approx(before.energy).epsilon(1e-10));
      // Gas is compressed, and slower than sound behind the front.
      CHECK(flow.at(speed - side * 1e-6).rho > ahead.rho);
      CHECK(std::abs(before.mass) / ahead.rho > sound(ahead));
    }
  }
  CHECK(shocks == 5);  // one each in 1, 3 and 4, two in 5
}

TEST_CASE("the exact solution's fans are continuous, isentropic and characteristic", "[riemann]") {
  int fans = 0;
  for (const Problem& problem : problems) {
    const ExactSolution flow = solve(problem);
    for (const double side : {-1.0, 1.0}) {
      const Primitive& ahead = side < 0 ? problem.left : problem.right;
      if (flow.star().p > ahead.p) continue;
      ++fans;
      CAPTURE(problem.name, side);
      const Primitive behind = flow.at(flow.star().u + side * 1e-9);
      const double head = ahead.u + side * sound(ahead);
      const double tail = behind.u + side * sound(behind);
      const double entropy = ahead.p / std::pow(ahead.rho, heat_ratio);
      const double invariant = ahead.u - side * 2 * sound(ahead) / (heat_ratio - 1);
      const double scale = std::abs(invariant) + sound(ahead);
      for (int i = 0; i <= 10; ++i) {
        const double xi = tail + (head - tail) * (0.001 + 0.998 * i / 10);
        const Primitive q = flow.at(xi);
        CHECK(q.p / std::pow(q.rho, heat_ratio) == Approx(entropy).epsilon(1e-10));
        CHECK(std::abs(q.u - side * 2 * sound(q) / (heat_ratio - 1) - invariant) < 1e-12 * scale);
        CHECK(std::abs(q.u + side * sound(q) - xi) < 1e-12 * scale);
      }
      // Both ends: the flow changes by no more than its slope times the distance.
      for (const double edge : {head, tail}) {
        const double beside = 1e-9 * scale;
        const Primitive a = flow.at(edge - beside);
        const Primitive b = flow.at(edge + beside);
        CHECK(std::abs(a.u - b.u) < 4 * beside);
        CHECK(std::abs(a.rho - b.rho) < 1e-7 * ahead.rho);
        CHECK(std::abs(a.p - b.p) < 1e-7 * ahead.p);
      }
    }
  }
  CHECK(fans == 5);  // one each in 1, 3 and 4, two in 2
}

TEST_CASE("the exact solution holds what flows in", "[riemann]") {
  // What lies between -X t and X t is what lay there at first and what came in through both ends.
  // Midpoint rule: jumps cost a cell each.
  for (const Problem& problem : problems) {
    CAPTURE(problem.name);
    const ExactSolution flow = solve(problem);
    const double X = 50;  // [m/s], beyond all waves
    const int cells = 200000;
    double mass = 0, momentum = 0;
    for (int i = 0; i < cells; ++i) {
      const Primitive q = flow.at(X * (2 * (i + 0.5) / cells - 1));
      mass += q.rho * 2 * X / cells;
      momentum += q.rho * q.u * 2 * X / cells;
    }
    const Primitive& l = problem.left;
    const Primitive& r = problem.right;
    const double resolution = 4 * 2 * X / cells;
    CHECK(std::abs(mass - X * (l.rho + r.rho) - (l.rho * l.u - r.rho * r.u)) < resolution * 32);
    CHECK(std::abs(momentum - X * (l.rho * l.u + r.rho * r.u) -
                   (l.rho * l.u * l.u + l.p - r.rho * r.u * r.u - r.p)) <
          resolution * 32 * (std::abs(flow.star().u) + std::abs(l.u) + std::abs(r.u)));
  }
}

TEST_CASE("the mirror image of an exact solution is that of the mirrored problem", "[riemann]") {
  for (const Problem& problem : problems) {
    CAPTURE(problem.name);
    const auto mirror = [](const Primitive& q) { return Primitive{q.rho, -q.u, q.p}; };
    const ExactSolution flow = solve(problem);
    const ExactSolution image(mirror(problem.right), mirror(problem.left), heat_ratio);
    for (double xi = -40; xi <= 40; xi += 0.37) {
      const Primitive a = flow.at(xi);
      const Primitive b = image.at(-xi);
      CHECK(a.rho == Approx(b.rho).epsilon(1e-10));
      CHECK(a.u == Approx(-b.u).epsilon(1e-10).margin(1e-10));
      CHECK(a.p == Approx(b.p).epsilon(1e-10));
    }
  }
}
