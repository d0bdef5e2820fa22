// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/time/integrator.hpp>

namespace sphmbs::time {

/// Shu and Osher's three-stage method of third order, which preserves strong stability (1988).
struct ShuOsher {
  /// Takes a step of length choose_step() [s], which it returns.
  template <ExplicitSystem S, class ChooseStep>
  double step(S& y, ChooseStep&& choose_step) const {
    y.stage(0, 0);
    y.rates(0);
    const double dt = choose_step();
    y.stage(dt, dt);
    y.rates(1);
    y.stage(dt / 4, dt / 2);
    y.rates(0.25);
    y.commit(2 * dt / 3, dt);
    return dt;
  }
};

static_assert(TimeIntegrator<ShuOsher>);

}  // namespace sphmbs::time
