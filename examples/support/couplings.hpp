// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <sphmbs/coupling/staggered.hpp>
#include <sphmbs/coupling/strong.hpp>

#include "support/integrators.hpp"
#include "support/parameters.hpp"

namespace sphmbs::examples {

/// Adds --coupling to the parameters.
inline void add_coupling(Parameters& parameters, std::string& coupling) {
  parameters.add_choice("run.coupling", coupling, {"staggered", "strong"},
                        "gas and bodies in turn, or until they agree in each step", "--coupling");
}

/// Calls run(scheme) with the coupling that --coupling names.
template <class Run>
void with_coupling(const std::string& coupling, const Settings& settings, Run&& run) {
  const mbs::GeneralizedAlpha integrator = step_solver_of(settings);
  if (coupling == "strong")
    run(coupling::Strong<>{.structure = integrator});
  else
    run(coupling::Staggered<>{.structure = integrator});
}

}  // namespace sphmbs::examples
