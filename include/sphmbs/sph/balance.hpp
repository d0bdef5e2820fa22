// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/sph/exchange.hpp>
#include <sphmbs/sph/passage.hpp>
#include <sphmbs/sph/totals.hpp>

namespace sphmbs::sph {

/// What a gas has too much of, or limits for the sizes of that, as shares: mass of the mass,
/// momentum of sqrt(2 m E), energy of the energy [-].
struct Drift {
  double mass = 0;      ///< by the mass at the start [-]
  double momentum = 0;  ///< by sqrt(2 m E), m and E as they are now [-]
  double energy = 0;    ///< by the energy at the start [-]
};

/// How much may be unaccounted for before a balance warns, and before it ends the run.
struct BalanceLimits {
  /// Beyond these there is a warning.
  Drift warn = {.mass = 1e-10, .momentum = 1e-6, .energy = 1e-2};
  /// Beyond these the run ends.
  Drift stop = {.mass = 1e-6, .momentum = 1e-2, .energy = 0.2};
};

/// Keeps the accounts of a gas: mass, momentum and energy now are those of the start, and what came
/// in, less what went out. Particles balance exactly, mass and momentum to rounding, energy to the
/// integrator's accuracy.
///
///   sph::Balance balance(fluid);
///   run(system, integrator, schedule, report, Every(interval, [&](auto&) { balance.check(); }));
template <class Fluid>
class Balance {
 public:
  static constexpr int dim = Fluid::dim;  ///< dimension of space

  /// The start is now. @throws InvalidInput for limits that are not positive.
  explicit Balance(Fluid& fluid, const BalanceLimits& limits = {}) : fluid_(fluid), start_(now()) {
    limit(limits);
  }

  /// Sets other limits; the start stays. @throws InvalidInput for limits that are not positive.
  void limit(const BalanceLimits& limits) {
    for (const Drift& limit : {limits.warn, limits.stop})
      for (const double share : {limit.mass, limit.momentum, limit.energy})
        expects(share > 0, "limit of a balance", share, "positive [-]");
    limits_ = limits;
  }

  /// What cannot be accounted for since the start: mass and energy are negative where some is
  /// missing.
  Drift drift() const { return drift(now()); }

  /// Looks at the accounts. @throws BeyondModel beyond the limits that stop a run, and for a
  /// particle that is missing or too many.
  void check() {
    const Accounts accounts = now();
    const auto there = static_cast<double>(accounts.totals.particles);
    const auto due = static_cast<double>(fluid_.gas_accounted());
    if (there != due)
      fail("number of gas particles",
           "there are " + said(there) + ", accounted for are " + said(due));
    const Drift d = drift(accounts);
    judge("mass", d.mass, limits_.warn.mass, limits_.stop.mass);
    judge("momentum", d.momentum, limits_.warn.momentum, limits_.stop.momentum);
    judge("energy", d.energy, limits_.warn.energy, limits_.stop.energy);
  }

  /// What went beyond the limits that warn, once for each quantity.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// What a checkpoint keeps of it, see `Archive`: the start is that of the fluid it is built for.
  template <Archive A>
  void visit_state(A& archive) {
    archive("warned", warned_);
    archive("warnings", warnings_);
  }

 private:
  struct Accounts {
    Totals<dim> totals;
    Passed<dim> passed;  // into the gas
    Exchange<dim> exchange;
  };

  Accounts now() const {
    Accounts a{fluid_.totals(), {}, fluid_.exchange()};
    for (const auto& opening : fluid_.traffic()) a.passed.combine(opening.net());
    Traffic<dim> lost;
    lost.out = fluid_.escaped();
    a.passed.combine(lost.net());
    return a;
  }

  // Energy of gas and virtual particles, and the work of a background pressure, which bodies and
  // openings do not see.
  double energy(const Accounts& a) const {
    return a.totals.energy() + a.totals.virtual_internal - a.passed.energy +
           fluid_.scheme().background * (a.totals.volume - a.passed.volume) -
           a.exchange.body_work() - a.exchange.driving_work();
  }

  Drift drift(const Accounts& a) const {
    const auto mass = [](const Accounts& x) { return x.totals.mass - x.passed.mass; };
    const auto momentum = [](const Accounts& x) {
      return x.totals.momentum - x.passed.momentum - x.exchange.impulse();
    };
    const double own = start_.totals.energy() + start_.totals.virtual_internal;
    const double moving = std::sqrt(2 * a.totals.mass * a.totals.energy());
    return {.mass = (mass(a) - mass(start_)) / start_.totals.mass,
            .momentum = std::sqrt(norm2(momentum(a) - momentum(start_))) / moving,
            .energy = (energy(a) - energy(start_)) / own};
  }

  void judge(const std::string& what, double drift, double warn, double stop) {
    const double share = std::abs(drift);
    const std::string text = said(share) + " of it cannot be accounted for";
    if (!(share <= stop)) fail(what, text + ", at most " + said(stop) + " may be");
    if (share <= warn || !warned_.insert(what).second) return;
    warnings_.push_back(what + " at t = " + said(fluid_.time()) + " s: " + text);
  }

  [[noreturn]] void fail(const std::string& what, const std::string& text) const {
    throw BeyondModel(
        what + " is not conserved at t = " + said(fluid_.time()) + " s: " + text +
            "\n  likely: steps too long for the integrator, or gas that is not resolved"
            "\n  try: a smaller step (--cfl or --step), a finer gas",
        "E320");
  }

  static std::string said(double x) {
    std::ostringstream text;
    text.precision(12);
    text << x;
    return text.str();
  }

  Fluid& fluid_;
  BalanceLimits limits_;
  Accounts start_;
  std::set<std::string> warned_;
  std::vector<std::string> warnings_;
};

}  // namespace sphmbs::sph
