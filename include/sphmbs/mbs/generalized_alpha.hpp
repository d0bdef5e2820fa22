// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/dynamics.hpp>

namespace sphmbs::mbs {

/// Generalized-alpha (Chung and Hulbert, J. Appl. Mech. 60, 1993) for eq. (25) as an index-3
/// system, in the form of Arnold and Bruels (Multibody Syst. Dyn. 18, 2007): second order in q, v
/// and lambda.
///
///   (1 - alpha_m) a_{n+1} + alpha_m a_n = (1 - alpha_f) vdot_{n+1} + alpha_f vdot_n
///   q_{n+1} = q_n + h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1})
///   v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
///
/// with vdot, lambda and Phi = 0 from eq. (25) at t_{n+1}. On curved conditions this alone is
/// unstable where bodies turn by more than about 1 - spectral_radius in a step: errors of
/// multipliers and of velocities across the conditions grow from step to step (without damping at
/// any step: Cardona and Geradin, Comput. Struct. 33, 1989). v and vdot are therefore projected
/// onto dPhi/dt = 0 and d2Phi/dt2 = 0 after each step that has left the first. Where the step
/// changes, a_n, which belongs to a time ahead of t_n by a share of the step, is moved there:
/// vdot_n + (h/h_old) (a_n - vdot_n).
struct GeneralizedAlpha {
  double spectral_radius = 0.8;         ///< at infinite frequency: 1 damps nothing, 0 at once [-]
  Newton newton = {};                   ///< how each step is solved
  bool project = true;                  ///< velocities and accelerations onto the conditions
  std::optional<double> accuracy = {};  ///< of a coordinate in a step [m]; without it, fixed steps

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(spectral_radius >= 0 && spectral_radius <= 1, "spectral_radius", spectral_radius,
            "between 0 and 1");
    if (accuracy)
      expects(std::isfinite(*accuracy) && *accuracy > 0, "accuracy", *accuracy, "positive [m]");
    newton.check();
  }

  /// One step of at most choose_step(). Fixed steps are taken whole, in halves of halves where
  /// Newton's method fails; with an accuracy the step is as long as the error estimate allows.
  /// @return the length of the step [s]
  /// @throws InvalidInput for a step that is not positive and finite; NumericalFailure where the
  ///         shortest step fails too, naming component, residual and iterations; the system then
  ///         still has the last good state.
  template <class System, class ChooseStep>
  double step(System& system, ChooseStep&& choose_step) const {
    check();
    const double bound = choose_step();
    if (accuracy) return adaptive_step(system, bound);
    expects(std::isfinite(bound) && bound > 0, "step", bound,
            "positive and finite [s], or an accuracy is given");
    fixed_step(system, bound, 0);
    return bound;
  }

  /// The constants of the method.
  struct Coefficients {
    double alpha_m;  ///< weight of the old auxiliary acceleration [-]
    double alpha_f;  ///< weight of the old acceleration [-]
    double gamma;    ///< weight of the new one in the velocity [-]
    double beta;     ///< weight of the new one in the position [-]
  };

  /// From the spectral radius: second order, least loss at low frequencies.
  Coefficients coefficients() const {
    const double rho = spectral_radius;
    const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
    const double gamma = 0.5 + alpha_f - alpha_m;
    return {alpha_m, alpha_f, gamma, 0.25 * (gamma + 0.5) * (gamma + 0.5)};
  }

  /// Where a step would lead, which Dynamics::accept makes the state.
  struct Attempt {
    State state;           ///< at the end of the step
    VectorXd before;       ///< a_n
    VectorXd algorithmic;  ///< a_{n+1}
    NewtonCourse course;   ///< how it was found
  };

  /// Tries a step of length h [s] and leaves the system's state as it is. Factors of an earlier
  /// state, or a guess, may mislead Newton's method: it has a second try with new ones from the
  /// state.
  /// @param guess  of accelerations and multipliers at the end of the step
  template <class System>
  Attempt attempt(System& system, double h, const State& guess) const {
    system.require_finite();
    Attempt first = attempt_once(system, h, guess);
    if (first.course.converged || first.course.singular) return first;
    system.factors().forget();
    return attempt_once(system, h, system.state());
  }
  /// From those of the last step.
  template <class System>
  Attempt attempt(System& system, double h) const {
    return attempt(system, h, system.state());
  }

 private:
  template <class System>
  Attempt attempt_once(System& system, double h, const State& guess) const {
    const auto [alpha_m, alpha_f, gamma, beta] = coefficients();
    const MatrixWeights w{(1 - alpha_m) / (h * h * beta * (1 - alpha_f)), gamma / (h * beta)};
    const State& old = system.state();
    Attempt next{old, system.algorithmic_acceleration(h), {}, {}};
    const VectorXd& a = next.before;
    next.state.vdot = guess.vdot;
    next.state.lambda = guess.lambda;
    next.algorithmic =
        (alpha_f * old.vdot - alpha_m * a + (1 - alpha_f) * guess.vdot) / (1 - alpha_m);
    next.state.t += h;
    next.state.q += h * old.v + h * h * ((0.5 - beta) * a + beta * next.algorithmic);
    next.state.v += h * ((1 - gamma) * a + gamma * next.algorithmic);
    next.course =
        newton_solve(system.equations(), system.factors(), next.state, w, newton, system.size());
    next.algorithmic += (1 - alpha_f) / (1 - alpha_m) * (next.state.vdot - guess.vdot);
    if (next.course.converged && project) project_rates(system, next, w);
    system.counts().iterations += static_cast<long>(next.course.iterations.size());
    return next;
  }

  // As they do where all conditions are linear. Phi_q is that of the last iteration.
  template <class System>
  static bool rates_hold(System& system, const State& state) {
    constexpr double negligible = 1e-11;
    auto& equations = system.equations();
    const VectorXd rate = without_removed(equations, rate_of_conditions(equations, state));
    return rate.cwiseAbs().maxCoeff() <=
           negligible * std::max(1.0, system.size()) * state.v.cwiseAbs().maxCoeff();
  }

  // In the metric of the iteration matrix at the new state: with that of an earlier one,
  // corrections across the conditions of then would have a part along those of now, and add up.
  template <class System>
  static void project_rates(System& system, Attempt& next, const MatrixWeights& w) {
    auto& equations = system.equations();
    auto& factors = system.factors();
    State& state = next.state;
    const int n = equations.coordinates(), m = equations.conditions();
    if (m == 0 || rates_hold(system, state)) return;
    equations.evaluate(state, &w);
    VectorXd residual = VectorXd::Zero(n + m), x;
    residual.tail(m) = without_removed(equations, rate_of_conditions(equations, state));
    if (!factors.compute(equations, w) || !factors.correct(residual, x)) {
      next.course.singular = true;
      next.course.converged = false;
      return;
    }
    state.v += x.head(n);
    residual.tail(m) = without_removed(equations, acceleration_of_conditions(equations, state));
    if (!factors.correct(residual, x)) {
      next.course.failure = "the acceleration of " +
                            equations.name_of_condition(first_not_finite(residual.tail(m))) +
                            " is not a number";
      next.course.converged = false;
      return;
    }
    state.vdot += x.head(n);
    next.algorithmic += x.head(n);
    state.lambda += x.tail(m) / w.mass;
  }

  template <class System>
  void fixed_step(System& system, double h, int halvings) const {
    Attempt next = attempt(system, h);
    if (next.course.converged) {
      system.accept(std::move(next.state), std::move(next.algorithmic));
      return;
    }
    if (halvings >= newton.max_halvings) fail(system, next, h);
    ++system.counts().halvings;
    fixed_step(system, h / 2, halvings + 1);
    fixed_step(system, h / 2, halvings + 1);
  }

  // Error of a step: |beta - 1/6| h^2 |a_{n+1} - a_n| (Zienkiewicz and Xie, Earthq. Eng. Struct.
  // Dyn. 20, 1991); it falls with h^3.
  template <class System>
  double adaptive_step(System& system, double bound) const {
    const double beta = coefficients().beta;
    double h = std::min(bound, system.suggested_step());
    if (!std::isfinite(system.suggested_step())) {
      const double largest = system.state().vdot.cwiseAbs().maxCoeff();
      if (largest > 0) h = std::min(h, std::sqrt(*accuracy / largest));
    }
    expects(std::isfinite(h) && h > 0, "step", h, "positive and finite [s]");
    for (int failures = 0;;) {
      Attempt next = attempt(system, h);
      double ratio = 0.5;
      if (next.course.converged) {
        double error = 0;
        int worst = -1;
        const std::vector<Role>& roles = system.equations().roles();
        for (int k = 0; k < next.before.size(); ++k)
          if (const double own = std::abs(next.algorithmic[k] - next.before[k]);
              roles[static_cast<std::size_t>(k)] == Role::massive && own > error) {
            error = own;
            worst = k;
          }
        error *= std::abs(beta - 1.0 / 6) * h * h;
        ratio = std::clamp(0.9 * std::cbrt(*accuracy / std::max(error, 1e-300)), 0.2, 2.0);
        if (error <= *accuracy) {
          // Equal steps keep factors in use.
          system.suggest_step(ratio > 0.95 && ratio < 1.2 ? h : ratio * h, worst);
          system.accept(std::move(next.state), std::move(next.algorithmic));
          return h;
        }
        ++system.counts().rejected;
      } else {
        if (++failures > newton.max_halvings) fail(system, next, h);
        ++system.counts().halvings;
      }
      h *= std::min(ratio, 0.9);
    }
  }

  // Of joints, not of bodies: -1 without joints.
  template <class Equations>
  static int most_loaded_condition(Equations& equations, const State& state) {
    int most = -1;
    equations.for_each_component(state, [&]<class T>(const auto&, const Slot& slot, const Local&) {
      if constexpr (Constraint<T>)
        for (int k = slot.first_condition; k < slot.first_condition + slot.m; ++k)
          if (most < 0 || std::abs(state.lambda[k]) > std::abs(state.lambda[most])) most = k;
    });
    return most;
  }

  template <class System>
  [[noreturn]] void fail(System& system, const Attempt& failed, double h) const {
    system.equations().relocate(system.state().q);
    std::ostringstream text;
    text << "Generalized-alpha: Newton's method does not converge at t = " << failed.state.t
         << " s with a step of " << h << " s, after " << newton.max_halvings << " halvings";
    if (failed.course.singular) text << "; the iteration matrix is singular";
    if (!failed.course.failure.empty()) text << "; " << failed.course.failure;
    if (!failed.course.iterations.empty()) {
      const NewtonIteration& last = failed.course.iterations.back();
      text << "; the largest residual, " << last.residual << ", is in "
           << system.equations().name_of(last.worst);
    }
    const int joint = most_loaded_condition(system.equations(), failed.state);
    if (joint >= 0)
      text << "; the most loaded joint is " << system.equations().name_of_condition(joint)
           << ", with a multiplier of " << failed.state.lambda[joint];
    text << ". Try a shorter step, a smaller spectral_radius, or check that joints do not lock.\n"
         << failed.course.table();
    throw NumericalFailure(text.str(), "E330");
  }
};

}  // namespace sphmbs::mbs
