// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/clamped.hpp>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance, test::exactly, test::thin_bar, test::violation;

namespace {

using Cable = ancf::Cable<2>;
using Mechanism = Structure<Cable, ncf::Bar, joints::Joint<2>>;
using System = test::SingleThreaded<Mechanism>;

Mechanism rigid_mechanism() { return test::double_pendulum<Mechanism>(); }

/// A bar of 0.5 m, pinned at the origin, with a cable of 1 m hinged to its end, all along +x.
Mechanism flexible_mechanism() {
  Mechanism mechanism;
  mechanism.gravity = {0, -9.81};
  const auto bar = mechanism.add(thin_bar({0, 0}, {0.5, 0}));
  const auto line = ancf::line(
      mechanism,
      {.from = {0.5, 0},
       .to = {1.5, 0},
       .elements = 2,
       .prototype = Cable{.axial_stiffness = 200, .bending_stiffness = 0.5, .mass_per_length = 1}});
  mechanism.add(joints::pinned(bar.start(), mechanism.q(), "root"));
  mechanism.add(joints::revolute(bar.end(), line.start(), "knee"));
  return mechanism;
}

/// Angles of the double pendulum from the downward vertical and their rates, by Lagrange's
/// equations of the minimal coordinates.
std::array<double, 4> reference_angles(double until) {
  const double g = 9.81;
  return test::runge_kutta(std::array<double, 4>{std::acos(0.0), 0, 0, 0}, until, 20000,
                           [=](double, const std::array<double, 4>& y) {
                             const double c = std::cos(y[0] - y[1]), s = std::sin(y[0] - y[1]);
                             // [4/3, c/2; c/2, 1/3] (a1, a2) = (f1, f2)
                             const double f1 = -0.5 * s * y[3] * y[3] - 1.5 * g * std::sin(y[0]);
                             const double f2 = 0.5 * s * y[2] * y[2] - 0.5 * g * std::sin(y[1]);
                             const double det = 4.0 / 9 - c * c / 4;
                             return std::array<double, 4>{y[2], y[3], (f1 / 3 - c / 2 * f2) / det,
                                                          (4.0 / 3 * f2 - c / 2 * f1) / det};
                           });
}

/// The state of the double pendulum at a time, from its angles; multipliers follow from the exact
/// state through the equations of motion.
State reference_state(double until) {
  const auto [a, b, wa, wb] = reference_angles(until);
  Mechanism exact = rigid_mechanism();
  VectorXd q(8), v(8);
  q << 0, 0, std::sin(a), -std::cos(a), std::sin(a), -std::cos(a), std::sin(a) + std::sin(b),
      -std::cos(a) - std::cos(b);
  v << 0, 0, std::cos(a) * wa, std::sin(a) * wa, std::cos(a) * wa, std::sin(a) * wa,
      std::cos(a) * wa + std::cos(b) * wb, std::sin(a) * wa + std::sin(b) * wb;
  exact.start_from(q, v);
  return System(exact).state();
}

State state_at(Mechanism mechanism, double until, double spectral_radius, double step) {
  System system(mechanism);
  advance(system, {.spectral_radius = spectral_radius, .newton = exactly}, until, step);
  return system.state();
}

struct Errors {
  double q, v, lambda;  // the last one relative
};

Errors errors(const State& state, const State& reference) {
  return {(state.q - reference.q).norm(), (state.v - reference.v).norm(),
          (state.lambda - reference.lambda).norm() / reference.lambda.norm()};
}

void expect_second_order(const Errors& coarse, const Errors& fine) {
  CHECK(std::log2(coarse.q / fine.q) == Approx(2).margin(0.15));
  CHECK(std::log2(coarse.v / fine.v) == Approx(2).margin(0.15));
  CHECK(std::log2(coarse.lambda / fine.lambda) == Approx(2).margin(0.25));
}

/// A step of generalized-alpha for y'' = -omega^2 y, on (y, h y', h^2 a), from its formulas.
Matrix<3, 3> amplification(double rho, double omega_h) {
  const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
  const double gamma = 0.5 + alpha_f - alpha_m, beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
  const double x = omega_h * omega_h;
  Matrix<3, 3> after, before;
  after << 1, 0, -beta, 0, 1, -gamma, (1 - alpha_f) * x, 0, 1 - alpha_m;
  before << 1, 1, 0.5 - beta, 0, 1, 1 - gamma, -alpha_f * x, 0, -alpha_m;
  return after.inverse() * before;
}

/// A clamped rod of one element, of unit length and mass, and the slower of its two axial modes.
struct AxialMode {
  Mechanism rod;
  double omega = 0;
  VectorXd shape = VectorXd::Zero(8);

  AxialMode() {
    const double EA = 1e4;
    const auto line = ancf::line(
        rod,
        {.to = {1, 0},
         .elements = 1,
         .prototype = Cable{.axial_stiffness = EA, .bending_stiffness = 1, .mass_per_length = 1}});
    rod.add(joints::clamped(line.start(), std::vector{line.gradient(0)}, rod.q(), "wall"));
    // m = 1/420 [156, -22; -22, 4], k = EA/30 [36, -3; -3, 4] of x and x' at the free end.
    const double m11 = 156.0 / 420, m12 = -22.0 / 420, m22 = 4.0 / 420;
    const double k11 = EA * 36 / 30, k12 = -EA * 3 / 30, k22 = EA * 4 / 30;
    const double a = m11 * m22 - m12 * m12, b = k11 * m22 + k22 * m11 - 2 * k12 * m12,
                 c = k11 * k22 - k12 * k12;
    const double square = (b - std::sqrt(b * b - 4 * a * c)) / (2 * a);
    omega = std::sqrt(square);
    shape[4] = 1;
    shape[6] = -(k11 - square * m11) / (k12 - square * m12);
  }

  /// The modal coordinate over its initial value, step by step.
  std::vector<double> motion(double rho, double omega_h, int steps) const {
    const double amplitude = 1e-7;  // at which Green's strain is linear
    Mechanism moved = rod;
    const VectorXd rest = rod.q();
    moved.start_from(rest + amplitude * shape);
    System system(moved);
    const VectorXd momentum = system.equations().mass() * shape;
    std::vector<double> y{1};
    for (int k = 0; k < steps; ++k) {
      GeneralizedAlpha{.spectral_radius = rho, .newton = {.tolerance = 1e-15}}.step(
          system, [&] { return omega_h / omega; });
      y.push_back((system.state().q - rest).dot(momentum) / (amplitude * shape.dot(momentum)));
    }
    return y;
  }
};

}  // namespace

TEST_CASE("generalized-alpha is of second order in q, v and lambda on rigid bodies", "[mbs]") {
  const double until = 0.5;
  const State reference = reference_state(until);
  for (const double rho : {1.0, 0.8, 0.5, 0.0}) {
    const double h = 2.5e-3;
    const Errors coarse = errors(state_at(rigid_mechanism(), until, rho, h), reference),
                 fine = errors(state_at(rigid_mechanism(), until, rho, h / 2), reference);
    CAPTURE(rho, fine.q, fine.v, fine.lambda);
    expect_second_order(coarse, fine);
    CHECK(fine.q < 1e-3);
  }
}

TEST_CASE("generalized-alpha is of second order in q, v and lambda on a cable with joints",
          "[mbs]") {
  const double until = 0.4;
  const State reference = state_at(flexible_mechanism(), until, 0.8, 1.5625e-5);
  for (const double rho : {1.0, 0.8, 0.5, 0.0}) {
    const double h = 5e-4;
    const Errors coarse = errors(state_at(flexible_mechanism(), until, rho, h), reference),
                 fine = errors(state_at(flexible_mechanism(), until, rho, h / 2), reference);
    CAPTURE(rho, coarse.q, coarse.v, coarse.lambda, fine.q, fine.v, fine.lambda);
    expect_second_order(coarse, fine);
  }
}

TEST_CASE("a stiff mode is damped as the spectral radius says", "[mbs]") {
  const AxialMode mode;
  for (const double rho : {1.0, 0.8, 0.5, 0.0})
    for (const double omega_h : {0.1, 1.0, 10.0, 100.0}) {
      const Matrix<3, 3> A = amplification(rho, omega_h);
      Vector<3> theory(1, 0, -omega_h * omega_h);
      double largest = 0;
      for (const double y : mode.motion(rho, omega_h, 40)) {
        largest = std::max(largest, std::abs(y - theory[0]));
        theory = A * theory;
      }
      Matrix<3, 3> power = A;
      for (int k = 0; k < 9; ++k) power *= power;
      const double radius = std::pow(power.norm(), 1.0 / 512);
      CAPTURE(rho, omega_h, largest, radius);
      CHECK(largest < 1e-6);
      if (omega_h == 0.1) CHECK(radius == Approx(1).margin(0.01));
      if (omega_h == 100) CHECK(radius == Approx(rho).margin(0.06));
    }
}

TEST_CASE("conditions hold to 1e-9 of the size after every step", "[mbs]") {
  for (Mechanism mechanism : {rigid_mechanism(), flexible_mechanism()})
    for (const double rho : {1.0, 0.8, 0.0}) {
      System system(mechanism);
      double largest = 0;
      advance(system, {.spectral_radius = rho}, 2, 2e-3,
              [&](System& s) { largest = std::max(largest, violation(s)); });
      CAPTURE(mechanism.coordinates(), rho, largest);
      CHECK(largest < 1e-9 * system.size());
    }
}

TEST_CASE("a pendulum without numerical damping keeps its energy over ten seconds", "[mbs]") {
  Mechanism mechanism;
  mechanism.gravity = {0, -9.81};
  const auto bar = mechanism.add(thin_bar({0, 0}, {1, 0}));
  mechanism.add(joints::pinned(bar.start(), mechanism.q(), "root"));
  System system(mechanism);
  const double start = system.energies().total();
  const double turnover = 9.81 / 2;  // of potential to kinetic energy [J]
  double largest = 0;
  advance(system, {.spectral_radius = 1, .newton = exactly}, 10, 2e-4,
          [&](System& s) { largest = std::max(largest, std::abs(s.energies().total() - start)); });
  CHECK(largest / turnover < 1e-6);
}

TEST_CASE("with an accuracy, steps follow the motion and the error falls with it", "[mbs]") {
  const double until = 1;
  const State reference = state_at(flexible_mechanism(), until, 0.8, 2.5e-5);
  double coarse_error = 0, coarse_steps = 0;
  for (const double accuracy : {1e-6, 1e-8}) {
    Mechanism mechanism = flexible_mechanism();
    System system(mechanism);
    double shortest = until, longest = 0, last = 0;
    sphmbs::run(system, GeneralizedAlpha{.accuracy = accuracy}, {.until = until},
                [&](const System& s, const sphmbs::sph::StepLimit&) {
                  if (last > 0) shortest = std::min(shortest, s.time() - last);
                  longest = std::max(longest, s.time() - last);
                  last = s.time();
                });
    const double error = (system.state().q - reference.q).norm();
    const double steps = static_cast<double>(system.statistics().steps);
    CAPTURE(accuracy, error, steps, shortest, longest, system.statistics().rejected);
    CHECK(longest > 4 * shortest);
    CHECK(static_cast<double>(system.statistics().rejected) < 0.05 * steps);
    if (coarse_steps > 0) {
      // Of a step h^3, in all h^2.
      CHECK(steps / coarse_steps == Approx(std::cbrt(100)).epsilon(0.1));
      CHECK(coarse_error / error == Approx(std::pow(100, 2.0 / 3)).epsilon(0.25));
    }
    coarse_error = error;
    coarse_steps = steps;
  }
}

TEST_CASE("a spinning bar never gains energy, however far it turns in a step", "[mbs]") {
  const double rate = 10;
  for (const double rho : {1.0, 0.95, 0.9, 0.8, 0.5, 0.0})
    for (const double turn : {0.02, 0.05, 0.1, 0.2, 0.4}) {
      Mechanism mechanism;
      ncf::Bar bar = thin_bar({0, 0}, {1, 0});
      bar.angular_velocity = rate;
      const auto placed = mechanism.add(bar);
      mechanism.add(joints::pinned(placed.start(), mechanism.q(), "root"));
      System system(mechanism);
      const double start = system.energies().total();
      double highest = 0;
      const GeneralizedAlpha integrator{.spectral_radius = rho};
      for (int k = 0; k < 2000; ++k) {
        integrator.step(system, [&] { return turn / rate; });
        highest = std::max(highest, system.energies().total() / start);
      }
      const double kept = system.energies().total() / start;
      CAPTURE(rho, turn, kept, highest);
      CHECK(highest < 1 + 1e-6);
      if (rho >= 0.8 && turn <= 0.1) CHECK(kept > 0.998);
    }
}

TEST_CASE("steps that change keep the order in q, v and lambda", "[mbs]") {
  const double until = 0.5;
  const State reference = reference_state(until);
  for (const double rho : {1.0, 0.8, 0.5}) {
    std::array<std::array<double, 3>, 2> error{};
    for (std::size_t level = 0; level < 2; ++level) {
      const double h = level == 0 ? 4e-3 : 2e-3;
      Mechanism mechanism = rigid_mechanism();
      System system(mechanism);
      const GeneralizedAlpha integrator{.spectral_radius = rho, .newton = exactly};
      for (int k = 0; system.time() < until - 1e-12; ++k)
        integrator.step(system,
                        [&] { return std::min(k % 2 == 0 ? h : h / 4, until - system.time()); });
      const State& state = system.state();
      error[level] = {(state.q - reference.q).norm(), (state.v - reference.v).norm(),
                      (state.lambda - reference.lambda).norm()};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double order = std::log2(error[0][k] / error[1][k]);
      CAPTURE(rho, k, error[0][k], error[1][k]);
      CHECK(order == Approx(2).margin(0.25));
    }
    CHECK(error[1][2] < 1e-2 * reference.lambda.norm());
  }
}

TEST_CASE("a cable that has come to rest stays there in whole steps, wherever it is", "[mbs]") {
  for (const double x : {0.0, 100.0}) {
    Mechanism mechanism;
    mechanism.gravity = {0, -9.81};
    const auto line = ancf::line(mechanism, {.from = {x, 0},
                                             .to = {x + 1, 0},
                                             .elements = 4,
                                             .prototype = Cable{.axial_stiffness = 1e7,
                                                                .bending_stiffness = 1,
                                                                .mass_per_length = 0.1,
                                                                .damping = 1e-2}});
    mechanism.add(joints::pinned(line.start(), mechanism.q(), "left"));
    mechanism.add(joints::pinned(line.end(), mechanism.q(), "right"));
    System system(mechanism);
    advance(system, {}, 2, 1e-3);
    CAPTURE(x, system.statistics().factorisations);
    CHECK(system.state().v.cwiseAbs().maxCoeff() < 1e-8);
    CHECK(system.statistics().halvings == 0);
    CHECK(system.statistics().factorisations < 100);
  }
}
