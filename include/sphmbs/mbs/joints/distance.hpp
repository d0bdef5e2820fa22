// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// Two points keep a distance L, constant or given in time [m]: 1 condition,
/// Phi = (|r_a - r_b|^2 - L(t)^2) / (2 L(0)), to first order the change of distance.
/// @throws InvalidInput unless L(0) is positive: `coincident` holds points together.
template <int Dim>
Joint<Dim> distance(const Marker<Dim>& a, const Marker<Dim>& b, const TimeFunction& length,
                    std::string_view name = "") {
  const std::string title = titled("distance", name);
  const double L = length.value(0);
  expects(L > 0 && std::isfinite(L), title + ": length", L, "positive [m]");
  const Factor<Dim> gap{a - b, Role::gap};
  return {
      title,
      {},
      {Product<Dim>{
          .terms = {{gap, gap}}, .c = squared(length), .scale = 1 / (2 * L), .label = "distance"}}};
}

}  // namespace sphmbs::mbs::joints
