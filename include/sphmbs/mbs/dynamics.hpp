// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include <sphmbs/mbs/energies.hpp>
#include <sphmbs/mbs/newton.hpp>
#include <sphmbs/mbs/reactions.hpp>
#include <sphmbs/mbs/solvers/sparse_lu.hpp>
#include <sphmbs/mbs/start.hpp>

namespace sphmbs::mbs {

/// Counts since the start.
struct DynamicsStatistics {
  long steps = 0;           ///< accepted
  long iterations = 0;      ///< of Newton's method
  long factorisations = 0;  ///< of the iteration matrix
  long halvings = 0;        ///< of steps in which Newton's method failed
  long rejected = 0;        ///< steps whose error estimate was too large

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("steps", steps);
    archive("iterations", iterations);
    archive("halvings", halvings);
    archive("rejected", rejected);
  }
};

/// Largest distance that the positions among coordinates q span along an axis [m].
template <int Dim>
double extent(const Matrix<Dynamic, Dim>& translation, const VectorXd& q) {
  double largest = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < q.size(); ++k)
      if (translation(k, axis) != 0) {
        low = std::min(low, q[k]);
        high = std::max(high, q[k]);
      }
    largest = std::max(largest, high - low);
  }
  return largest > 0 ? largest : 1;
}

/// By how much the filter of generalized-alpha, made for a step of length `last`, is stretched for
/// one of length h: as steps change, which keeps the order, but after one much shorter than its
/// neighbours not by all of it [-].
inline double filter_stretch(double h, double last) {
  return last > 0 ? std::min(h / last, 5.0) : 1;
}

/// A structure in motion: its equations, a consistent state, and the linear solver with its
/// factors. Integrators move it, observers read it.
///
///   mbs::Dynamics system(mechanism);
///   run(system, mbs::GeneralizedAlpha{}, {.until = 1, .step = 1e-3}, report, observers...);
template <class Structure, solvers::LinearSolver Solver = solvers::SparseLU,
          class Policy = execution::Default>
class Dynamics {
 public:
  static constexpr int dim = Structure::dim;           ///< dimension of space
  using EquationsType = Equations<Structure, Policy>;  ///< the equations of motion

  /// Makes the initial state consistent. Keeps a reference to the structure.
  /// @throws InvalidInput and NumericalFailure as ConsistentStart::run does.
  explicit Dynamics(Structure& structure, const StartOptions& options = {})
      : structure_(structure), equations_(structure) {
    state_.q = structure.q();
    state_.v = structure.v();
    size_ = extent<dim>(equations_.translation(), state_.q);
    start_ = ConsistentStart(equations_, state_, size_, options).run();
    algorithmic_ = state_.vdot;
    powers_ = powers_at(equations_, state_);
    stored_at_start_ = potential_of_forces(equations_, state_);
  }

  /// Accelerations and multipliers at the start under a force from outside, such as that of gas at
  /// rest [N per coordinate].
  void start_under(const VectorXd& external) {
    equations_.external_force() = external;
    ConsistentStart(equations_, state_, size_, {}).find_accelerations();
    algorithmic_ = state_.vdot;
    powers_ = powers_at(equations_, state_);
  }

  double time() const { return state_.t; }             ///< [s]
  const State& state() const { return state_; }        ///< q, v, vdot, lambda
  const StartReport& start() const { return start_; }  ///< how the initial state was made
  double size() const { return size_; }                ///< largest extent at t = 0 [m]
  /// The bodies, joints and forces.
  const Structure& structure() const { return structure_; }
  /// The equations of motion.
  EquationsType& equations() { return equations_; }
  /// Counts since the start.
  DynamicsStatistics statistics() const {
    DynamicsStatistics s = statistics_;
    s.factorisations = factors_.count();
    return s;
  }

  /// Energies now, and what was dissipated and done since t = 0 (trapezoidal rule).
  Energies energies() {
    Energies e = energies_at(equations_, structure_, state_);
    e.dissipated = dissipated_;
    e.work = work_ + potential_of_forces(equations_, state_) - stored_at_start_;
    return e;
  }

  /// Multipliers of a joint or body; with redundant conditions those of the smallest norm. The
  /// joint exerts -Phi_q^T lambda.
  /// @param number  what Structure::add returned, or Placed::number
  template <class T>
  VectorXd multipliers(int number) {
    const auto [first, count] = conditions_of<T>(structure_, equations_.layout(), number);
    if (start_.redundant.empty()) return state_.lambda.segment(first, count);
    return minimum_norm_multipliers(equations_, state_, start_.redundant).segment(first, count);
  }

  /// Between steps.
  template <Archive A>
  void visit_state(A& archive) {
    archive("state", state_);
    archive("algorithmic", algorithmic_);
    if constexpr (A::restores)
      for (const VectorXd* x : {&state_.q, &state_.v, &state_.vdot, &algorithmic_})
        if (x->size() != equations_.coordinates() ||
            state_.lambda.size() != equations_.conditions())
          throw RefusedCheckpoint("the state of the checkpoint is that of another structure",
                                  "E405");
    archive("statistics", statistics_);
    archive("last_step", last_step_);
    archive("suggested_step", suggested_step_);
    archive("worst", worst_);
    archive("power_dissipated", powers_.dissipated);
    archive("power_of_loads", powers_.work);
    archive("dissipated", dissipated_);
    archive("work", work_);
    archive("equations", equations_);
    factors_.visit_state(archive, equations_);
  }

  /// @name For integrators
  /// @{
  /// The iteration matrix and its factors.
  Factors<Solver>& factors() { return factors_; }
  /// Counts, to be raised.
  DynamicsStatistics& counts() { return statistics_; }
  /// The auxiliary acceleration of generalized-alpha for a step of length h [per s^2].
  VectorXd algorithmic_acceleration(double h) const {
    return state_.vdot + filter_stretch(h, last_step_) * (algorithmic_ - state_.vdot);
  }
  /// Step that an error estimate suggests [s]; infinite before the first one.
  double suggested_step() const { return suggested_step_; }
  /// Notes the step that an error estimate suggests [s].
  /// @param worst  coordinate whose error asks for it, -1 for none
  void suggest_step(double dt, int worst = -1) {
    suggested_step_ = dt;
    worst_ = worst;
  }
  /// Whose error decides on the suggested step.
  std::string limited_by() const {
    return worst_ < 0 ? "the accuracy asked for" : "the error of " + equations_.name_of(worst_);
  }

  /// @throws NumericalFailure naming a coordinate, rate or multiplier that is not finite.
  void require_finite() const {
    const auto look = [&](const VectorXd& x, const char* what, int offset) {
      if (x.allFinite()) return;
      const int k = first_not_finite(x);
      std::ostringstream text;
      text << "t = " << state_.t << " s: " << what << " of " << equations_.name_of(offset + k)
           << " is " << x[k]
           << ": not finite\n  likely: a force, a load or a start value that is not finite\n  try: "
              "look at what acts on this part";
      throw NumericalFailure(text.str(), "E331");
    };
    look(state_.q, "coordinate q", 0);
    look(state_.v, "velocity v", 0);
    look(state_.vdot, "acceleration vdot", 0);
    look(state_.lambda, "multiplier lambda", equations_.coordinates());
  }

  /// What a step changes, for steps that are undone.
  struct Memory {
    State state;            ///< coordinates, rates, multipliers
    VectorXd algorithmic;   ///< auxiliary acceleration of generalized-alpha
    Powers powers;          ///< at the state
    double last_step;       ///< [s]
    double suggested_step;  ///< [s]
    double dissipated;      ///< since time 0 [J]
    double work;            ///< since time 0 [J]
    int worst;              ///< coordinate that the suggested step is due to
  };
  /// What `recall` brings back.
  Memory memory() const {
    return {state_, algorithmic_, powers_, last_step_, suggested_step_, dissipated_, work_, worst_};
  }
  /// Undoes everything since `memory`; joints that move along go back to where they were.
  void recall(const Memory& m) {
    state_ = m.state;
    algorithmic_ = m.algorithmic;
    powers_ = m.powers;
    last_step_ = m.last_step;
    suggested_step_ = m.suggested_step;
    dissipated_ = m.dissipated;
    work_ = m.work;
    worst_ = m.worst;
    equations_.relocate(state_.q);
    factors_.forget();
  }

  /// Takes a state as the one that a step has led to.
  /// @throws BeyondModel where a joint ends the run, or a removed condition is violated.
  void accept(State state, VectorXd algorithmic) {
    const double dt = state.t - state_.t;
    structure_.for_each_type([&]<class T>(auto& components) {
      if constexpr (WatchingConstraint<T>)
        for (auto& joint : components) joint.accept(state.q, state.t);
    });
    check_removed(state);
    last_step_ = dt;
    state_ = std::move(state);
    algorithmic_ = std::move(algorithmic);
    ++statistics_.steps;
    const Powers now = powers_at(equations_, state_);
    dissipated_ += dt / 2 * (powers_.dissipated + now.dissipated);
    work_ += dt / 2 * (powers_.work + now.work);
    powers_ = now;
  }
  /// @}

 private:
  void check_removed(const State& state) {
    if (start_.redundant.empty()) return;
    equations_.evaluate(state);
    const VectorXd phi = equations_.conditions_residual();
    const double allowed = 1e-6 * size_;
    for (const int k : start_.redundant)
      if (!(std::abs(phi[k]) <= allowed)) {
        std::ostringstream text;
        text << "t = " << state.t << " s: " << equations_.name_of_condition(k)
             << ", taken for redundant at the start, is violated by " << std::abs(phi[k])
             << ": the joints contradict each other away from the initial position, or that was a "
                "singular one, such as bars in line, where they seem to hold the same; then start "
                "elsewhere.";
        throw BeyondModel(text.str(), "E333");
      }
  }

  Structure& structure_;
  EquationsType equations_;
  Factors<Solver> factors_;
  State state_;
  VectorXd algorithmic_;
  StartReport start_;
  DynamicsStatistics statistics_;
  double size_ = 1, last_step_ = 0;
  double suggested_step_ = std::numeric_limits<double>::infinity();
  int worst_ = -1;
  Powers powers_;
  double dissipated_ = 0, work_ = 0, stored_at_start_ = 0;
};

}  // namespace sphmbs::mbs
