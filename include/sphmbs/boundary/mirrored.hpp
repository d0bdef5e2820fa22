// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/boundary/wall_model.hpp>

namespace sphmbs::boundary {

/// One-sided Riemann problem pair by pair: gas meets its own mirror image in a wall across the line
/// of the pair, so that u* is the wall's velocity and p* = p + rho c (u - u_wall) for the acoustic
/// solver. Nothing lags, the work of the wall is the gas's gain to rounding, and no surface is
/// needed; but the pressure is of first order and gas that slides along a wall is braked, since
/// most pairs are oblique.
struct Mirrored {
  /// Whether virtual particles carry a state, see `WallModel`.
  static constexpr bool evolves = false;
  static constexpr bool surfaces = false;  ///< whether the true surface is used, see `WallModel`
  static constexpr bool slips = false;     ///< whether gas slides along without friction

  /// The far side of the pair's Riemann problem: the gas, mirrored at the moving wall.
  template <class N>
  SPHMBS_INLINE riemann::State<N> facing(const riemann::State<N>& gas,
                                         const riemann::State<N>& stored) const {
    return {.rho = gas.rho, .u = N(2) * stored.u - gas.u, .p = gas.p, .c = gas.c};
  }

  /// Does nothing: no parameter can be out of range.
  void check() const {}
};

static_assert(WallModel<Mirrored>);

}  // namespace sphmbs::boundary
