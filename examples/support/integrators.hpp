// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/generalized_alpha.hpp>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// Generalized-alpha with the spectral radius and the Newton's method that the settings want, for
/// steps that something else chooses.
inline mbs::GeneralizedAlpha step_solver_of(const Settings& settings) {
  return {.spectral_radius = settings.spectral_radius,
          .newton = {.tolerance = settings.newton_tolerance,
                     .max_iterations = settings.newton_iterations}};
}

/// The same with the accuracy that the settings want, unless they fix the step.
inline mbs::GeneralizedAlpha integrator_of(const Settings& settings) {
  mbs::GeneralizedAlpha integrator = step_solver_of(settings);
  if (!settings.step) integrator.accuracy = settings.accuracy;
  return integrator;
}

}  // namespace sphmbs::examples
