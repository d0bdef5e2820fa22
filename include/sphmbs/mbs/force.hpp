// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// Generalized force Q(q, v, t) on the n coordinates that index() lists; q and v are those n, in
/// that order. Outputs come zeroed.
///   name()                        what messages call it
///   force(q, v, t, f)             Q, on the right of eq. (25)
///   tangent(q, v, t, k, c)        k += dQ/dq, c += dQ/dv, n x n
///   potential(q, t)               energy stored [J]; 0 for a force without potential
///   dissipation(q, v, t)          power taken out of the motion [W]; 0 for a force without damping
///   check()                       @throws InvalidInput for parameters out of range
template <class F>
concept Force = std::copyable<F> &&
    requires(const F load, VectorIn q, double t, VectorOut f, MatrixOut k) {
  { load.name() } -> std::convertible_to<std::string>;
  { load.index() } -> std::convertible_to<const Index&>;
  load.check();
  load.force(q, q, t, f);
  load.tangent(q, q, t, k, k);
  { load.potential(q, t) } -> std::convertible_to<double>;
  { load.dissipation(q, q, t) } -> std::convertible_to<double>;
};

/// Force that statics raises step by step from nothing: `static constexpr bool is_load = true`.
template <class F>
concept Load = Force<F> && F::is_load;

/// Whether all power of a force but its damping comes out of its potential, Q.v = -dU/dt -
/// dissipation: forces may say so by conservative(), so that no quadrature of their power enters
/// the work done from outside.
template <Force F>
bool is_conservative(const F& load) {
  if constexpr (requires {
                  { load.conservative() } -> std::convertible_to<bool>;
                })
    return load.conservative();
  else
    return false;
}

}  // namespace sphmbs::mbs
