// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <sphmbs/coupling/staggered.hpp>
#include <sphmbs/coupling/strong.hpp>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// Adds --coupling to a command line.
inline void add_coupling(CommandLine& command_line, std::string& coupling) {
  command_line.add_choice("--coupling", coupling, {"staggered", "strong"},
                          "gas and bodies in turn, or until they agree in each step");
}

/// Calls run(scheme) with the coupling that --coupling names.
template <class Run>
void with_coupling(const std::string& coupling, const Settings& settings, Run&& run) {
  const mbs::GeneralizedAlpha integrator{.spectral_radius = settings.spectral_radius};
  if (coupling == "strong")
    run(coupling::Strong<>{.structure = integrator});
  else
    run(coupling::Staggered<>{.structure = integrator});
}

}  // namespace sphmbs::examples
