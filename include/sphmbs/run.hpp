// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/sph/survey.hpp>
#include <sphmbs/time/integrator.hpp>

namespace sphmbs {

/// How long to run and how long a step may be.
struct Schedule {
  double until;      ///< end time [s]
  double cfl = 0.4;  ///< share of the stability limits, where `step` is not given [-]
  std::optional<double> step = {};  ///< fixed step [s]

  /// @throws InvalidInput for numbers that are not positive and finite, or a cfl above 1.
  void check() const {
    expects(std::isfinite(until) && until > 0, "until", until, "positive [s]");
    expects(cfl > 0 && cfl <= 1, "cfl", cfl, "above 0 and at most 1");
    if (step) expects(std::isfinite(*step) && *step > 0, "step", *step, "positive [s]");
  }
};

/// Whether steps are shortened so that an observer sees exactly the times it asks for.
enum class Timing { exact, next_step };

/// A report of steps to nobody.
inline constexpr auto no_report = [](const auto& /*system*/, const auto& /*limit*/) {};

/// Calls an action at time 0, at every multiple of an interval (or at the first step after it), and
/// at the end.
template <class Action>
class Every {
 public:
  /// @throws InvalidInput unless the interval is positive.
  Every(double interval, Action action, Timing timing = Timing::exact)
      : interval_(interval), action_(std::move(action)), timing_(timing) {
    expects(std::isfinite(interval) && interval > 0, "interval", interval,
            "positive and finite [s]");
  }

  /// The next time that a step may not pass [s].
  double barrier() const {
    return timing_ == Timing::exact ? due() : std::numeric_limits<double>::infinity();
  }

  /// Acts if the time has come; `last` makes it act in any case, once.
  template <class System>
  void observe(System& system, bool last) {
    const double t = system.time();
    const bool now = t >= due() - 1e-9 * interval_;
    if (now) count_ = next_after(t);
    if (now || (last && t > acted_)) {
      action_(system);
      acted_ = t;
    }
  }

  /// When it acted last; it may go on at another interval.
  template <Archive A>
  void visit_state(A& archive) {
    archive("acted", acted_);
    if constexpr (A::restores) count_ = acted_ < 0 ? 0 : next_after(acted_);
  }

 private:
  double due() const { return static_cast<double>(count_) * interval_; }
  long next_after(double t) const {
    return static_cast<long>(std::floor(t / interval_ + 1e-9)) + 1;
  }

  double interval_;
  Action action_;
  Timing timing_;
  long count_ = 0;
  double acted_ = -1;
};

/// Calls an action between steps, when nothing is half done: to save the state, or to end the run
/// by returning false.
template <class Action>
class BetweenSteps {
 public:
  /// @param action  called as action(system), returns whether the run goes on.
  explicit BetweenSteps(Action action) : action_(std::move(action)) {}

  /// Steps are not shortened.
  double barrier() const { return std::numeric_limits<double>::infinity(); }
  /// Nothing is done while a step is under way.
  template <class System>
  void observe(System&, bool) const {}
  /// Calls the action; false ends the run.
  template <class System>
  bool between_steps(System& system) {
    return action_(system);
  }

 private:
  Action action_;
};

/// What limits the next step where the schedule does not fix it: stability in a gas, the accuracy
/// that an implicit integrator is given in a structure.
template <class System>
sph::StepLimit step_limit_of(System& system, double cfl) {
  if constexpr (requires { system.survey(); })
    return sph::step_limit(system.survey(), cfl);
  else
    return {system.suggested_step(), "accuracy", 0};
}

/// How many steps, each as long as its limit, an integrator takes in one of its own: several where
/// it sub-cycles.
template <class Integrator>
int limited_steps([[maybe_unused]] const Integrator& integrator) {
  if constexpr (requires { integrator.gas_steps; })
    return integrator.gas_steps;
  else
    return 1;
}

/// Steps a system until the end of its schedule. Observers see it at the beginning of a step, when
/// state, rates and forces belong to the same time, and once more at the end. Steps that follow
/// from stability or accuracy are shortened to meet exact observers; fixed steps are not.
/// @param report  called as report(system, StepLimit) before every step is taken
/// @return whether the end was reached: false where BetweenSteps ended the run before
/// @throws InvalidInput for a bad schedule; NumericalFailure from the system.
template <class System, class Integrator, class Report, class... Observers>
bool run(System& system, const Integrator& integrator, const Schedule& schedule, Report&& report,
         Observers&&... observers) {
  schedule.check();
  if constexpr (requires { integrator.accuracy; })
    expects(schedule.step || integrator.accuracy, "step", "none",
            "given [s], or the integrator has an accuracy");
  const auto observe = [&]([[maybe_unused]] bool last) { (observers.observe(system, last), ...); };
  const auto may_go_on = [&](auto& observer) {
    if constexpr (requires { observer.between_steps(system); })
      return observer.between_steps(system);
    else
      return true;
  };
  const double close = 1e-12 * schedule.until;
  while (system.time() < schedule.until - close) {
    if (!(may_go_on(observers) && ...)) return false;
    integrator.step(system, [&] {
      observe(false);
      const double left = schedule.until - system.time();
      sph::StepLimit limit = schedule.step ? sph::StepLimit{*schedule.step, "fixed", 0}
                                           : step_limit_of(system, schedule.cfl);
      if (!schedule.step) limit.dt *= limited_steps(integrator);
      double wait = left;
      if (!schedule.step) ((wait = std::min(wait, observers.barrier() - system.time())), ...);
      // Whole steps of equal length up to the next observation, instead of a short last one.
      const double whole = wait / std::max(1.0, std::ceil(wait / limit.dt - 1e-9));
      if (schedule.step)
        limit.dt = std::min(limit.dt, left);
      else
        limit.dt = whole;
      report(system, limit);
      return limit.dt;
    });
  }
  if constexpr (time::ExplicitSystem<System>) {
    system.stage(0, 0);
    system.rates(0);
  } else if constexpr (requires { system.evaluate(); }) {
    system.evaluate();
  }
  observe(true);
  return true;
}

}  // namespace sphmbs
