// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/dynamics.hpp>

namespace sphmbs::mbs {

/// How loads are raised in statics.
struct StaticsOptions {
  double first_step = 1;  // share of the loads that is tried first [-]
  double smallest_step = 1e-6;
  double t = 0;  // time at which loads and drives are taken [s]
  Newton newton = {.max_iterations = 30, .refactor = Refactor::every_iteration};
  StartOptions start = {};

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(first_step > 0 && first_step <= 1, "first_step", first_step, "above 0 and at most 1");
    expects(smallest_step > 0 && smallest_step <= first_step, "smallest_step", smallest_step,
            "above 0 and at most first_step");
    newton.check();
  }
};

/// Equilibrium: a state with v = vdot = 0, and how it was found.
struct Equilibrium {
  State state;
  int load_steps = 0, iterations = 0, halvings = 0;
};

/// Finds F(q) + Phi_q^T lambda = Q, Phi = 0 near the initial coordinates. Gravity and loads
/// (concept Load) are raised from nothing, in steps that shrink where Newton's method fails and
/// grow where it does not.
///
///   const auto sagged = mbs::equilibrium(structure);
///   structure.start_from(sagged.state.q);
///
/// @throws InvalidInput for bad options and inconsistent positions; NumericalFailure where the
///         structure can move freely, or the smallest load step fails
template <solvers::LinearSolver Solver = solvers::SparseLU, class Policy = execution::OpenMP,
          class Structure>
Equilibrium equilibrium(Structure& structure, const StaticsOptions& options = {}) {
  options.check();
  Equations<Structure, Policy> equations(structure);
  Factors<Solver> factors;
  Equilibrium found;
  State& state = found.state;
  state.t = options.t;
  state.q = structure.q();
  state.v = VectorXd::Zero(state.q.size());
  const double size = extent<Structure::dim>(equations.translation(), state.q);
  ConsistentStart(equations, state, size, options.start).place();
  state.vdot = VectorXd::Zero(state.q.size());

  double done = 0, step = options.first_step;
  while (done < 1) {
    State next = state;
    const double target = std::min(1.0, done + step);
    equations.set_load_factor(target);
    factors.forget();
    const NewtonCourse course =
        newton_solve(equations, factors, next, MatrixWeights{0, 0}, options.newton, size);
    found.iterations += static_cast<int>(course.iterations.size());
    if (course.converged) {
      next.v.setZero();
      next.vdot.setZero();
      state = std::move(next);
      done = target;
      step *= 2;
      ++found.load_steps;
    } else {
      step = 0.4 * (target - done);
      ++found.halvings;
      if (step < options.smallest_step) {
        std::ostringstream text;
        text << "Statics: Newton's method does not converge at " << 100 * target
             << " % of the loads";
        if (course.singular || course.iterations.empty())
          text << "; the tangent stiffness is singular: can the structure move freely?";
        else
          text << "; the largest residual, " << course.iterations.back().residual << ", is in "
               << equations.name_of(course.iterations.back().worst) << ".";
        text << " Try a smaller first_step, or a start nearer to the equilibrium.\n"
             << course.table();
        throw NumericalFailure(text.str());
      }
    }
  }
  return found;
}

}  // namespace sphmbs::mbs
