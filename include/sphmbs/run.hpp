// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/sph/pace.hpp>
#include <sphmbs/sph/survey.hpp>
#include <sphmbs/time/integrator.hpp>

namespace sphmbs {

/// How long to run and how long a step may be.
struct Schedule {
  double until;      ///< end time [s]
  double cfl = 0.4;  ///< share of the stability limits, where `step` is not given [-]
  std::optional<double> step = {};  ///< fixed step [s]
  /// Steps below this, 20 in a row, end the run; where it is not given, a millionth of the first
  /// step [s].
  std::optional<double> floor = {};

  /// @throws InvalidInput for numbers that are not positive and finite, or a cfl above 1.
  void check() const {
    expects(std::isfinite(until) && until > 0, "until", until, "positive [s]");
    expects(cfl > 0 && cfl <= 1, "cfl", cfl, "above 0 and at most 1");
    if (step) expects(std::isfinite(*step) && *step > 0, "step", *step, "positive [s]");
    if (floor) expects(std::isfinite(*floor) && *floor >= 0, "floor", *floor, "0 or positive [s]");
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

/// A system whose step can be undone until it is committed.
template <class System>
concept Undoable = requires(System system) {
  system.undo();
};

namespace detail {

/// @throws NumericalFailure for steps too short to lead anywhere, with what limits them.
template <class System>
[[noreturn]] void collapse(System& system, const sph::StepLimit& limit, const std::string& what,
                           const char* advice) {
  std::ostringstream text;
  text << what << " at t = " << system.time() << " s (dt = " << limit.dt << " s), limited by "
       << limit.reason;
  std::vector<std::uint32_t> culprits;
  if constexpr (requires { system.fluid().describe(limit.id); })
    text << "\n  " << system.fluid().describe(limit.id);
  else if constexpr (requires { system.describe(limit.id); })
    text << "\n  " << system.describe(limit.id);
  if constexpr (requires { system.limited_by(); })
    text << "\n  " << system.limited_by();
  else
    culprits.push_back(limit.id);
  text << advice;
  throw NumericalFailure(text.str(), "E310", culprits);
}

/// A fixed step of this length, in equal parts where a try of all of it failed or it is beyond what
/// the stability limits allow at a cfl of 1.
template <class System>
sph::StepLimit fixed_step(System& system, double length, int steps, double longest) {
  sph::StepLimit limit{length, "fixed", 0};
  sph::StepLimit stable{longest, "a step that failed", 0};
  if constexpr (requires { system.survey(); }) {
    sph::StepLimit bare = sph::step_limit(system.survey(), 1);
    bare.dt *= steps;
    if (!(bare.dt >= stable.dt)) stable = bare;
  }
  if (length <= stable.dt) return limit;
  const double parts = std::ceil(length / stable.dt - 1e-9);
  if (!(parts <= sph::Pace::most_parts))
    collapse(system, stable,
             "a fixed step is " + std::to_string(length / stable.dt) +
                 " times as long as the longest that is stable,",
             "\n  likely: the step was chosen for a coarser gas, or slower sound\n  try: a smaller "
             "step (--step), or --cfl instead");
  stable.dt = length / parts;
  return stable;
}

}  // namespace detail

/// Steps a system until the end of its schedule. Observers see it at the beginning of a step, when
/// state, rates and forces belong to the same time, and once more at the end. Steps that follow
/// from stability or accuracy are shortened to meet exact observers; fixed steps are not.
///
/// A step of a system that can be undone, and that fails, is tried again half as long, up to 8
/// times. A fixed step then goes on in such parts to its end, and so does one that is longer than
/// what is stable at a cfl of 1, in up to 256; observers do not see the ends of parts.
/// @param pace    what was learnt of the steps so far, which a checkpoint keeps
/// @param report  called as report(system, StepLimit) before every step is taken
/// @return whether the end was reached: false where BetweenSteps ended the run before
/// @throws InvalidInput for a bad schedule; NumericalFailure from the system, and where steps
///         collapse.
template <class System, class Integrator, class Report, class... Observers>
bool run(System& system, const Integrator& integrator, const Schedule& schedule, sph::Pace& pace,
         Report&& report, Observers&&... observers) {
  schedule.check();
  if constexpr (requires { integrator.accuracy; })
    expects(schedule.step || integrator.accuracy, "step", "none",
            "given [s], or the integrator has an accuracy");
  const auto observe = [&]([[maybe_unused]] bool last) { (observers.observe(system, last), ...); };
  [[maybe_unused]] const auto may_go_on = [&](auto& observer) {
    if constexpr (requires { observer.between_steps(system); })
      return observer.between_steps(system);
    else
      return true;
  };
  const double close = 1e-12 * schedule.until;
  if (schedule.floor) pace.set_floor(*schedule.floor);
  double due = system.time();  // end of the fixed step [s]
  bool whole = true;           // nothing of it is done yet
  double tried = 0;            // length [s]; 0 before it is chosen
  const auto choose_step = [&] {
    const int steps = limited_steps(integrator);
    const double now = system.time();
    if (whole && !pace.retrying()) observe(false);
    const double left = schedule.until - now;
    sph::StepLimit limit{};
    if (schedule.step) {
      const double length = whole ? std::min(*schedule.step, left) : due - now;
      if (whole) due = now + length;
      limit = detail::fixed_step(system, length, steps, pace.longest());
    } else {
      limit = step_limit_of(system, schedule.cfl);
      limit.dt = std::min(limit.dt * steps, pace.longest());
    }
    if (pace.collapsed(limit.dt))
      detail::collapse(
          system, limit, "steps have become too short",
          "\n  likely: something small, stiff or fast has come about: two particles at "
          "one place, a shock in a corner, a stiff part\n  try: look at what is named; "
          "a finer or smoother initial state; a softer part, or a larger accuracy");
    if (!schedule.step) {
      double wait = left;
      ((wait = std::min(wait, observers.barrier() - now)), ...);
      // Whole steps of equal length up to the next observation, instead of a short last one.
      limit.dt = wait / std::max(1.0, std::ceil(wait / limit.dt - 1e-9));
    }
    if (!pace.retrying()) report(system, limit);
    tried = limit.dt;
    return limit.dt;
  };
  while (system.time() < schedule.until - close) {
    if (whole && !pace.retrying() && !(may_go_on(observers) && ...)) return false;
    const double begin = system.time();
    tried = 0;
    if constexpr (Undoable<System>) {
      try {
        integrator.step(system, choose_step);
      } catch (const BeyondModel&) {
        if (tried > 0 && system.time() == begin) system.undo();
        throw;
      } catch (const NumericalFailure& failure) {
        // Of the state itself, or of what a step has led to.
        if (!(tried > 0) || system.time() != begin) throw;
        system.undo();
        if (pace.exhausted() || pace.too_small(tried / 2, due - begin, schedule.step.has_value()))
          throw sph::after_retries(failure);
        pace.failed(tried);
        continue;
      }
    } else {
      integrator.step(system, choose_step);
    }
    whole = !Undoable<System> || !schedule.step || system.time() >= due - close;
    pace.went(whole);
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

/// The same from the beginning, or for runs that are not saved.
template <class System, class Integrator, class Report, class... Observers>
requires(!std::same_as<std::remove_cvref_t<Report>, sph::Pace>) bool run(
    System& system, const Integrator& integrator, const Schedule& schedule, Report&& report,
    Observers&&... observers) {
  sph::Pace pace;
  return run(system, integrator, schedule, pace, std::forward<Report>(report),
             std::forward<Observers>(observers)...);
}

}  // namespace sphmbs
