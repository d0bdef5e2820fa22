// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/riemann/riemann_solver.hpp>

namespace sphmbs::riemann {

/// Acoustic solver: both waves taken as weak, eqs. (16) and (19) (Parshikov and Medin 2002).
///
///   p* = (Z_r p_l + Z_l p_r - Z_l Z_r (u_r - u_l)) / (Z_l + Z_r),   Z = rho c
///   u* = (Z_l u_l + Z_r u_r + p_l - p_r) / (Z_l + Z_r)
///
/// Exact to first order in the jump. The paper prints rho_b rho_a c_a as the first term of (16),
/// which is no pressure; this is the solution of the acoustic problem.
struct Acoustic {
  /// p* and u*, eqs. (16) and (19).
  template <class Eos, class N>
  SPHMBS_INLINE Star<N> star(const Eos&, const State<N>& left, const State<N>& right) const {
    const N Zl = detail::impedance(left);
    const N Zr = detail::impedance(right);
    const N share = N(1) / (Zl + Zr);
    return {.p = (Zr * left.p + Zl * right.p - Zl * Zr * (right.u - left.u)) * share,
            .u = (Zl * left.u + Zr * right.u + left.p - right.p) * share};
  }

  /// Does nothing: no parameter can be out of range.
  void check() const {}
};

static_assert(RiemannSolver<Acoustic>);

}  // namespace sphmbs::riemann
