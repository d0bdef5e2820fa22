// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>

/// Small mechanisms that several tests share, and how they are moved and judged.
namespace test {

using PlanarMechanism =
    sphmbs::mbs::Structure<sphmbs::mbs::ncf::Bar, sphmbs::mbs::joints::Joint<2>>;

/// On one thread: fastest for small structures, and the time does not depend on what else runs.
template <class Structure, class Solver = sphmbs::mbs::solvers::SparseLDLT>
using SingleThreaded = sphmbs::mbs::Dynamics<Structure, Solver, sphmbs::execution::Serial>;

/// For errors of the time steps alone.
inline constexpr sphmbs::mbs::Newton exactly{.tolerance = 1e-13, .acceleration_tolerance = 1e-10};

/// A thin bar of 1 kg, or the mass given, and the length between two points.
inline sphmbs::mbs::ncf::Bar thin_bar(const sphmbs::mbs::Vector<2>& from,
                                      const sphmbs::mbs::Vector<2>& to, double mass = 1) {
  return {.from = from, .to = to, .density = mass / (to - from).norm(), .area = 1};
}

/// Double pendulum of two bars, pinned at the start of the upper one: by default thin ones of 1 m
/// and 1 kg, of which the upper one lies along +x from the origin and the lower one hangs.
template <class Mechanism = PlanarMechanism>
Mechanism double_pendulum(const sphmbs::mbs::ncf::Bar& upper = thin_bar({0, 0}, {1, 0}),
                          const sphmbs::mbs::ncf::Bar& lower = thin_bar({1, 0}, {1, -1})) {
  Mechanism mechanism;
  mechanism.gravity = {0, -9.81};
  const auto first = mechanism.add(upper);
  const auto second = mechanism.add(lower);
  mechanism.add(sphmbs::mbs::joints::pinned(first.start(), mechanism.q(), "root"));
  mechanism.add(sphmbs::mbs::joints::revolute(first.end(), second.start(), "knee"));
  return mechanism;
}

/// Steps a system over a time.
template <class System>
void advance(System& system, const sphmbs::mbs::GeneralizedAlpha& integrator, double until,
             double step) {
  sphmbs::run(system, integrator, {.until = until, .step = step}, sphmbs::no_report);
}

/// The same, with look(system) at t = 0 and after each step.
template <class System, class Look>
void advance(System& system, const sphmbs::mbs::GeneralizedAlpha& integrator, double until,
             double step, Look&& look) {
  sphmbs::run(system, integrator, {.until = until, .step = step}, sphmbs::no_report,
              sphmbs::Every(step, look));
}

/// Largest violation of a condition [m].
template <class System>
double violation(System& system) {
  system.equations().evaluate(system.state());
  return system.equations().conditions_residual().cwiseAbs().maxCoeff();
}

/// Solution of y' = rates(t, y) at `until` by the classical Runge-Kutta method.
template <std::size_t n, class Rates>
std::array<double, n> runge_kutta(std::array<double, n> y, double until, int steps, Rates&& rates) {
  const double h = until / steps;
  const auto moved = [&](const std::array<double, n>& k, double step) {
    std::array<double, n> z = y;
    for (std::size_t i = 0; i < n; ++i) z[i] += step * k[i];
    return z;
  };
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    const auto k1 = rates(t, y), k2 = rates(t + h / 2, moved(k1, h / 2)),
               k3 = rates(t + h / 2, moved(k2, h / 2)), k4 = rates(t + h, moved(k3, h));
    for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return y;
}

/// Whether a solver takes a matrix with a row and a column of zeros for a regular one.
template <class Solver>
bool factorises_singular_matrix() {
  sphmbs::mbs::SparseMatrix A(2, 2);
  A.insert(0, 0) = 1;
  A.insert(1, 1) = 0;
  A.makeCompressed();
  Solver solver;
  solver.analyse(A, std::vector<sphmbs::mbs::Role>(2, sphmbs::mbs::Role::massive));
  return solver.factorise(A);
}

}  // namespace test
