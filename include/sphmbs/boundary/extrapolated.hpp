// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/boundary/wall_model.hpp>
#include <sphmbs/core/expects.hpp>

namespace sphmbs::boundary {

/// The gas's own linear field, continued through the true surface: pressure and sliding velocity by
/// the gas's slopes, the other components of velocity so that they meet the wall's at the surface.
/// With the way d to the virtual particle, its part d_n along the normal n, the gas's distance
/// D = d_n - depth from the surface, and phi = d_n / (2 D), the middle of the pair has
///
///   v* = v - phi (v - v_wall).n n + 1/2 (d.grad v) without its normal part    where gas slips,
///   v* = v - phi (v - v_wall)                                                 where it sticks,
///   p* = p + 1/2 d.grad p + rho c beta J,   beta = min(1, strength J / c)
///
/// where J >= 0 is the velocity, of the gas's own slope at the surface, at which gas runs into the
/// wall: a jump, which only shocks have. Linear fields next to walls are exact and the stair-steps
/// of lattice walls are not felt. phi is bounded by `steepest` for gas that all but touches the
/// wall, and the rise of pressure by 0.2 rho c^2. Convex edges of a solid are not treated.
template <bool slip>
struct Extrapolated {
  /// Whether virtual particles carry a state, see `WallModel`.
  static constexpr bool evolves = false;
  static constexpr bool surfaces = true;  ///< whether the true surface is used, see `WallModel`
  static constexpr bool slips = slip;     ///< whether gas slides along without friction

  /// Wall at the temperature of the virtual particles' own state; false: adiabatic.
  bool isothermal = false;
  double strength = 3;  ///< of the dissipation [-]
  double steepest = 4;  ///< bound of phi [-]

  /// What meets in the middle of a pair, from the gas's slopes and the distance of the surface.
  template <int Dim, class N>
  SPHMBS_INLINE Contact<Dim, N> contact(const Meeting<Dim, N>& m) const {
    const auto number = [](double x) SPHMBS_INLINE_LAMBDA { return N(static_cast<Scalar<N>>(x)); };
    const N dn = math::max(dot(m.d, m.normal), number(1e-6) * m.gas.h);
    // Gas that sticks and all but touches the wall would ask for steps shorter than diffusion's
    // own.
    const N least = slip ? N(0) : number(0.3) * m.gas.h;
    const N distance = math::max(math::max(dn - m.depth, dn * number(1 / (2 * steepest))), least);
    const N phi = dn / (N(2) * distance);
    const Vec<Dim, N> relative = m.gas.v - m.wall_velocity;
    const N closing = dot(relative, m.normal);
    Contact<Dim, N> middle;
    middle.phi = phi;
    if constexpr (slip) {
      Vec<Dim, N> change;
#pragma GCC unroll 3
      for (int k = 0; k < Dim; ++k) change[k] = number(0.5) * dot(m.slopes.v[k], m.d);
      middle.v = m.gas.v + change - (phi * closing + dot(change, m.normal)) * m.normal;
    } else {
      middle.v = m.gas.v - phi * relative;
    }
    // Slopes may overshoot where shocks meet walls: a share of rho c^2 keeps the pressure positive.
    const N most = number(0.2) * m.gas.rho * m.gas.c * m.gas.c;
    const N rise = number(0.5) * dot(m.slopes.p, m.d);
    N slope = N(0);
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) slope += m.normal[k] * dot(m.slopes.v[k], m.normal);
    const N jump = math::max(math::min(closing + distance * slope, closing), N(0));
    const N share = math::min(number(strength) * jump, m.gas.c);
    middle.p = m.gas.p + math::max(-most, math::min(rise, most)) + m.gas.rho * share * jump;
    return middle;
  }

  /// @throws InvalidInput for a negative strength, or `steepest` below 1/2.
  void check() const {
    expects(strength >= 0, "strength of a wall's dissipation", strength, "zero or positive");
    expects(steepest >= 0.5, "steepest", steepest, "at least 0.5");
  }
};

/// Gas slides along walls without friction.
using FreeSlip = Extrapolated<true>;
/// Gas sticks to walls; to be used with a viscous gas.
using NoSlip = Extrapolated<false>;

static_assert(WallModel<FreeSlip> && WallModel<NoSlip>);

}  // namespace sphmbs::boundary
