// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>

#include <sphmbs/sph/presets.hpp>

#include "support/parameters.hpp"

namespace sphmbs::examples {

/// Adds --scheme to the parameters: the paper's equations or the best that the library has.
inline void add_scheme(Parameters& parameters, std::string& scheme) {
  parameters.add_choice("run.scheme", scheme, {"paper", "best"},
                        "the paper's equations, or the library's best for this case", "--scheme");
}

/// Calls run.operator()<Gas>() with the scheme that --scheme names.
template <class Paper, class Best, class Run>
void with_scheme(const std::string& scheme, Run&& run) {
  if (scheme == "paper")
    run.template operator()<Paper>();
  else
    run.template operator()<Best>();
}

/// The choices of a scheme in words, for banners.
template <class Gas>
std::string describe() {
  std::string text = "quintic spline";
  if constexpr (std::is_same_v<typename Gas::Riemann, riemann::Acoustic>)
    text += ", acoustic Riemann solver";
  if constexpr (std::is_same_v<typename Gas::Riemann, riemann::Hllc>) text += ", HLLC";
  if constexpr (Gas::Reconstruction::slopes) text += ", MUSCL";
  if constexpr (Gas::Density::relaxes) text += ", relaxed density";
  if constexpr (Gas::Smoothing::acts) text += ", XSPH 0.5";
  if constexpr (Gas::Smoothing::shifts) text += ", shifting";
  if constexpr (Gas::Wall::surfaces)
    text += ", walls extrapolated";
  else
    text += ", walls evolved";
  return text;
}

}  // namespace sphmbs::examples
