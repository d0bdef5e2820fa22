// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/sph/balance.hpp>
#include <sphmbs/sph/statistics.hpp>

#include "support/report.hpp"
#include "support/settings.hpp"

namespace sphmbs::examples {

/// Keeps the accounts of the gas of a run: what cannot be accounted for is a warning, and where
/// nothing comes in or goes out, much of it ends the run.
template <class Fluid>
class GasWatch {
 public:
  /// The start is now.
  explicit GasWatch(Fluid& fluid) : fluid_(fluid), balance_(fluid) {}

  /// What is to be done.
  void guard(const Guards& guards) {
    constexpr double anything = std::numeric_limits<double>::infinity();
    on_ = guards.balance != "off";
    sph::BalanceLimits limits;
    limits.stop.energy = guards.energy;
    limits.warn.energy = std::min(limits.warn.energy, guards.energy);
    if (sizeof(typename Fluid::NumberType) < sizeof(double)) {
      limits.warn.mass = 1e-6;
      limits.warn.momentum = 1e-3;
      limits.stop.mass = 1e-4;
    }
    if (guards.balance == "warn" || !fluid_.traffic().empty())
      limits.stop = {.mass = anything, .momentum = anything, .energy = anything};
    balance_.limit(limits);
  }

  /// @throws BeyondModel for accounts that are beyond the limits.
  void look(Report& report) {
    if (!on_) return;
    balance_.check();
    const auto& all = balance_.warnings();
    for (; told_ < all.size(); ++told_) report.warn("balance of the gas", "W320 " + all[told_]);
  }

  /// Adds what is not accounted for, and what the gas met.
  void summarise(Summary& s) const {
    const sph::Drift drift = balance_.drift();
    const sph::Statistics& done = fluid_.statistics();
    s.conservation = {.mass = drift.mass, .momentum = drift.momentum, .energy = drift.energy};
    s.incidents.lost = static_cast<std::int64_t>(fluid_.escaped().particles);
    s.incidents.retries = static_cast<std::int64_t>(done.retries);
    s.incidents.refused = static_cast<std::int64_t>(done.falls);
  }

  /// A run that goes on tells again what it has told.
  template <Archive A>
  void visit_state(A& archive) {
    archive("balance", balance_);
  }

 private:
  Fluid& fluid_;
  sph::Balance<Fluid> balance_;
  bool on_ = true;
  std::size_t told_ = 0;  // warnings
};

}  // namespace sphmbs::examples
