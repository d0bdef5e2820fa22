// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

/// Explicit integrators of y' = f(y, t), written against two arrays a system keeps: the state y at
/// the beginning of the step and a weighted sum of rates k.
namespace sphmbs::time {

/// What a system offers.
///   stage(s, dt)   go to the stage y + s k at time t + dt; stage(0, 0) is the state itself
///   rates(w)       k = w k + f(stage); with w = 0 the old k is not read
///   commit(s, dt)  y = y + s k, t = t + dt
template <class S>
concept ExplicitSystem = requires(S system, double s) {
  system.stage(s, s);
  system.rates(s);
  system.commit(s, s);
};

/// A stand-in for concepts.
struct NoSystem {
  ///@{ Does nothing.
  void stage(double, double) {}
  void rates(double) {}
  void commit(double, double) {}
  ///@}
};

/// Likewise for the choice of a step.
struct OneSecond {
  /// 1 s.
  double operator()() const { return 1.0; }
};

/// What an integrator offers: one step, whose length `choose_step()` gives once the rates at the
/// beginning of the step are known; it is returned [s].
template <class I, class S = NoSystem>
concept TimeIntegrator = ExplicitSystem<S> && requires(const I integrator, S& system) {
  { integrator.step(system, OneSecond{}) } -> std::same_as<double>;
};

}  // namespace sphmbs::time
