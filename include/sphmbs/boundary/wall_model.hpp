// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/riemann/riemann_solver.hpp>

/// Walls and bodies as gas sees them: virtual particles, sect. 3.2.
namespace sphmbs::boundary {

/// What gas meets at a virtual particle: the far side of their Riemann problem. `stored` is the
/// virtual particle's own state, its u the velocity of the wall. `evolves` says whether virtual
/// particles carry a density and an energy that follow eqs. (20) and (22). `facing` must also
/// accept States of packs.
template <class W>
concept WallModel = std::is_trivially_copyable_v<W> &&
    requires(const W wall, riemann::State<double> gas, riemann::State<double> stored) {
  { W::evolves } -> std::convertible_to<bool>;
  { wall.facing(gas, stored) } -> std::same_as<riemann::State<double>>;
};

}  // namespace sphmbs::boundary
