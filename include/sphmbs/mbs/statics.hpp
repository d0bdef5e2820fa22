// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/dynamics.hpp>

namespace sphmbs::mbs {

/// How loads are raised in statics.
struct StaticsOptions {
  double first_step = 1;        ///< share of the loads that is tried first [-]
  double smallest_step = 1e-6;  ///< share of the loads below which it is given up [-]
  int relaxations = 60;         ///< at most, a load step, where Newton's method fails
  double t = 0;                 ///< time at which loads and drives are taken [s]
  /// How each load step is solved.
  Newton newton = {.max_iterations = 30, .refactor = Refactor::every_iteration};
  StartOptions start = {};  ///< how conditions are met before loads are raised

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(first_step > 0 && first_step <= 1, "first_step", first_step, "above 0 and at most 1");
    expects(smallest_step > 0 && smallest_step <= first_step, "smallest_step", smallest_step,
            "above 0 and at most first_step");
    expects(relaxations >= 0, "relaxations", relaxations, "at least 0");
    expects(std::isfinite(t), "t", t, "finite [s]");
    newton.check();
  }
};

/// Equilibrium: a state with v = vdot = 0, and how it was found.
struct Equilibrium {
  State state;          ///< at rest, with the multipliers of the reactions
  int load_steps = 0;   ///< taken
  int iterations = 0;   ///< of Newton's method
  int halvings = 0;     ///< of load steps that failed
  int relaxations = 0;  ///< steps of pseudo-transient continuation
};

namespace detail {

/// Statics at one share of the loads.
template <class Equations, class Factors>
class EquilibriumSearch {
 public:
  EquilibriumSearch(Equations& equations, const StaticsOptions& options, double size,
                    Equilibrium& found)
      : equations_(equations), options_(options), size_(size), found_(found) {}

  /// Newton's method. @return whether it has moved the state to an equilibrium
  bool solve(State& state) {
    course_ = step(state, 0, options_.newton);
    return course_.converged;
  }

  /// Implicit Euler steps of the time tau from rest, M (q - q_before)/tau^2 + r(q) = 0, tau ever
  /// longer (pseudo-transient continuation: Kelley and Keyes 1998, SIAM Journal on Numerical
  /// Analysis 35). They lead a structure that is slack, or far from its equilibrium, down the slope
  /// of its energy to where Newton's method finds the way. @return as solve()
  /// @throws NumericalFailure for a part that moves ever further.
  bool relax(State& state) {
    constexpr double longer = 10, shorter = 0.25;  // of 1/tau^2
    constexpr double late = 1e-3;                  // 1/tau^2, of the first, for Newton's method
    Newton rough = options_.newton;
    rough.tolerance = std::max(rough.tolerance, 1e-6);
    rough.acceleration_tolerance = 1;
    State moved = state;
    const double first = first_weight(state);
    double weight = first;
    for (int k = 0; k < options_.relaxations && first > 0; ++k) {
      ++found_.relaxations;
      const bool done = step(moved, weight, rough).converged;
      weight /= done ? longer : shorter;
      refuse_free_motion(state.q, moved.q);
      if (done && weight < late * first && solve(moved)) {
        state = std::move(moved);
        return true;
      }
    }
    return false;
  }

  /// Why the last solve() has failed.
  std::string complaint() {
    std::ostringstream text;
    if (course_.singular)
      text << "; the tangent stiffness is singular: can " << softest() << " move freely?";
    else if (!course_.failure.empty())
      text << "; " << course_.failure;
    else if (!course_.iterations.empty())
      text << "; the largest residual, " << course_.iterations.back().residual << ", is in "
           << equations_.name_of(course_.iterations.back().worst) << ", and the part held least is "
           << softest() << ": can it move freely?";
    text << " Try a smaller first_step, or a start nearer to the equilibrium.\n" << course_.table();
    return text.str();
  }

 private:
  NewtonCourse step(State& state, double mass, const Newton& newton) {
    State next = state;
    factors_.forget();
    NewtonCourse course =
        newton_solve(equations_, factors_, next, MatrixWeights{mass, 0}, newton, size_);
    found_.iterations += static_cast<int>(course.iterations.size());
    if (course.converged) {
      next.v.setZero();
      next.vdot.setZero();
      state = std::move(next);
    }
    return course;
  }

  // 1/tau^2 with which no coordinate goes further than a tenth of the structure's size, if free.
  double first_weight(const State& state) {
    constexpr double share = 0.1;
    equations_.relocate(state.q);
    equations_.evaluate(state);
    VectorXd residual;
    equations_.residual(state.vdot, residual);
    const VectorXd mass = equations_.mass().diagonal();
    double largest = 0;
    for (int k = 0; k < equations_.coordinates(); ++k)
      if (mass[k] > 0) largest = std::max(largest, std::abs(residual[k]) / mass[k]);
    return largest / (share * size_);
  }

  void refuse_free_motion(const VectorXd& before, const VectorXd& now) const {
    constexpr double far = 20;  // sizes that only free motion goes
    int furthest = 0;
    const double distance = (now - before).cwiseAbs().maxCoeff(&furthest);
    if (distance <= far * std::max(size_, before.cwiseAbs().maxCoeff())) return;
    throw NumericalFailure("Statics: nothing holds " + equations_.name_of(furthest) +
                               " against the loads: is a joint missing?",
                           "E336");
  }

  // Part that a slight support leaves the most room to.
  std::string softest() {
    constexpr double slight = 1e-9;  // stiffness of the support, over the largest one or 1 N/m
    const MatrixWeights none{0, 0};
    SparseMatrix A;
    equations_.evaluate(found_.state, &none);
    equations_.matrix(none, A);
    const SparseMatrix& M = equations_.mass();
    const MatrixWeights support{
        slight * std::max(1.0, A.diagonal().head(M.rows()).cwiseAbs().maxCoeff()) /
            M.diagonal().maxCoeff(),
        0};
    VectorXd x;
    int k = 0;
    equations_.evaluate(found_.state, &support);
    if (!factors_.compute(equations_, support) ||
        !factors_.correct(VectorXd::Ones(equations_.unknowns()), x))
      return "a part";
    x.head(M.rows()).cwiseAbs().maxCoeff(&k);
    return equations_.name_of(k);
  }

  Equations& equations_;
  const StaticsOptions& options_;
  double size_;
  Equilibrium& found_;
  Factors factors_;
  NewtonCourse course_;
};

}  // namespace detail

/// Finds F(q) + Phi_q^T lambda = Q, Phi = 0 near the initial coordinates. Gravity and loads
/// (concept Load) are raised from nothing, in steps that shrink where no equilibrium is found and
/// grow where one is. Where Newton's method fails, as for a slack chain, relaxation finds the
/// equilibrium down the slope of the energy. What Newton's method finds need not be stable:
/// eigenmodes() shows.
///
///   const auto sagged = mbs::equilibrium(structure);
///   structure.start_from(sagged.state.q);
///
/// @throws InvalidInput for bad options and inconsistent positions; NumericalFailure where the
///         structure can move freely, or the smallest load step fails
template <solvers::LinearSolver Solver = solvers::SparseLU, class Policy = execution::Default,
          class Structure>
Equilibrium equilibrium(Structure& structure, const StaticsOptions& options = {}) {
  options.check();
  Equations<Structure, Policy> equations(structure);
  Equilibrium found;
  State& state = found.state;
  state.t = options.t;
  state.q = structure.q();
  state.v = VectorXd::Zero(state.q.size());
  const double size = extent<Structure::dim>(equations.translation(), state.q);
  ConsistentStart(equations, state, size, options.start).place();
  state.vdot = VectorXd::Zero(state.q.size());

  detail::EquilibriumSearch<Equations<Structure, Policy>, Factors<Solver>> search(
      equations, options, size, found);
  double done = 0, step = options.first_step;
  while (done < 1) {
    const double target = std::min(1.0, done + step);
    equations.set_load_factor(target);
    if (search.solve(state) || search.relax(state)) {
      done = target;
      step *= 2;
      ++found.load_steps;
      continue;
    }
    step = 0.4 * (target - done);
    ++found.halvings;
    if (step >= options.smallest_step) continue;
    std::ostringstream text;
    text << "Statics: Newton's method does not converge at " << 100 * target << " % of the loads";
    throw NumericalFailure(text.str() + search.complaint(), "E335");
  }
  return found;
}

}  // namespace sphmbs::mbs
