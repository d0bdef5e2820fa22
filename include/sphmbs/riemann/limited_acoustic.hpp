// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/riemann/riemann_solver.hpp>

namespace sphmbs::riemann {

/// The acoustic solution with its dissipation limited to compression:
///
///   p* = (Z_r p_l + Z_l p_r + beta Z_l Z_r (u_l - u_r)) / (Z_l + Z_r),   Z = rho c
///   u* = (Z_l u_l + Z_r u_r + beta (p_l - p_r)) / (Z_l + Z_r)
///   beta = min(1, strength max(u_l - u_r, 0) / c),   c the mean of both sound speeds
///
/// The velocity jump in p* acts as a viscosity and the pressure jump in u* as a diffusion of
/// density and energy. In weak flow both shrink with the jump, where gas expands they vanish, and
/// in shocks, from a closing speed of c / strength on, this is `Acoustic`. So sound, vortices and
/// boundary layers last longer; nothing but shocks smooths noise between particles either.
///
/// The idea and the strength 3 are those of Zhang, Hu and Adams, J. Comput. Phys. 335 (2017) 605,
/// who limit p* alone.
struct LimitedAcoustic {
  double strength = 3;  ///< [-]

  /// p* and u* with limited dissipation.
  template <class Eos, class N>
  SPHMBS_INLINE Star<N> star(const Eos&, const State<N>& left, const State<N>& right) const {
    using T = Scalar<N>;
    const N Zl = detail::impedance(left);
    const N Zr = detail::impedance(right);
    const N share = N(1) / (Zl + Zr);
    const N closing = left.u - right.u;
    const N c = math::max(N(T(0.5)) * (left.c + right.c), N(static_cast<T>(detail::tiny)));
    const N beta = math::min(N(static_cast<T>(strength)) * math::max(closing, N(0)) / c, N(1));
    return {.p = (Zr * left.p + Zl * right.p + beta * Zl * Zr * closing) * share,
            .u = (Zl * left.u + Zr * right.u + beta * (left.p - right.p)) * share};
  }

  /// @throws InvalidInput unless the strength is positive and finite.
  void check() const {
    expects(strength > 0 && std::isfinite(strength), "strength of the acoustic limiter", strength,
            "positive and finite");
  }
};

static_assert(RiemannSolver<LimitedAcoustic>);

}  // namespace sphmbs::riemann
