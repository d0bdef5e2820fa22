// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/time/integrator.hpp>

namespace sphmbs::time {

/// Heun's method of second order, which preserves strong stability (Shu and Osher 1988): an Euler
/// step, then the mean of the rates at both ends.
struct Heun {
  /// Takes a step of length choose_step() [s], which it returns.
  template <ExplicitSystem S, class ChooseStep>
  double step(S& y, ChooseStep&& choose_step) const {
    y.stage(0, 0);
    y.rates(0);
    const double dt = choose_step();
    y.stage(dt, dt);
    y.rates(1);
    y.commit(dt / 2, dt);
    return dt;
  }
};

static_assert(TimeIntegrator<Heun>);

}  // namespace sphmbs::time
