// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/time/integrator.hpp>

namespace sphmbs::time {

/// The paper's two-step predictor-corrector, eqs. (27)-(29), of second order: predict the midpoint
/// with the rates at t, then step with the rates at the midpoint. Eqs. (28) and (29) together are
/// y(t + dt) = y(t) + dt f(midpoint).
struct PredictorCorrector {
  /// Takes a step of length choose_step() [s], which it returns.
  template <ExplicitSystem S, class ChooseStep>
  double step(S& y, ChooseStep&& choose_step) const {
    y.stage(0, 0);
    y.rates(0);
    const double dt = choose_step();
    y.stage(dt / 2, dt / 2);
    y.rates(0);
    y.commit(dt, dt);
    return dt;
  }
};

static_assert(TimeIntegrator<PredictorCorrector>);

}  // namespace sphmbs::time
