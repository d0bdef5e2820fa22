// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// Condition Phi(q, t) = 0 on the n coordinates that index() lists; q and v are those n, in that
/// order. Outputs come zeroed.
///   name()                          what messages call it
///   conditions()                    m, the length of Phi
///   residual(q, t, phi)             Phi, positions in [m], directions without unit
///   jacobian(q, t, phi_q)           Phi_q, m x n
///   add_hessian(q, t, lambda, h)    h += d(Phi_q^T lambda)/dq, n x n
///   rate(q, t, phi_t)               partial derivative of Phi in t
///   acceleration(q, v, t, gamma)    2 Phi_qt v + Phi_tt
///   check()                         @throws InvalidInput for parameters out of range
template <class C>
concept Constraint = std::copyable<C> &&
    requires(const C joint, VectorIn q, double t, VectorOut phi, MatrixOut phi_q) {
  { joint.name() } -> std::convertible_to<std::string>;
  { joint.index() } -> std::convertible_to<const Index&>;
  { joint.conditions() } -> std::convertible_to<int>;
  joint.check();
  joint.residual(q, t, phi);
  joint.jacobian(q, t, phi_q);
  joint.add_hessian(q, t, q, phi_q);
  joint.rate(q, t, phi);
  joint.acceleration(q, q, t, phi);
};

/// Constraint that is linear in q for all q: nothing is kept for its Hessian.
template <class C>
concept LinearConstraint = Constraint<C> && requires(const C joint) {
  { joint.linear() } -> std::same_as<bool>;
};

/// Constraint that looks at every accepted state, with all coordinates of the structure.
///   accept(q, t)   @throws BeyondModel for an event that ends the run
template <class C>
concept WatchingConstraint = Constraint<C> && requires(C joint, const VectorXd& q, double t) {
  joint.accept(q, t);
};

/// Constraint whose index() changes with the motion: relocate(q), with all coordinates q of the
/// structure, moves it to where q says and returns whether index() has changed.
template <class C>
concept MovingConstraint = Constraint<C> && requires(C joint, const VectorXd& q) {
  { joint.relocate(q) } -> std::same_as<bool>;
};

/// Constraint with a force of its own that depends on the reaction, such as friction. The force r
/// stands on the left of eq. (25).
///   friction(q, v, t, lambda, r)                 r, length n
///   friction_tangent(q, v, t, lambda, k, c, l)   k += dr/dq, c += dr/dv, l += dr/dlambda (n x m)
///   dissipation(q, v, t, lambda)                 power taken [W]
template <class C>
concept FrictionalConstraint = Constraint<C> &&
    requires(const C joint, VectorIn q, double t, VectorOut r, MatrixOut k) {
  joint.friction(q, q, t, q, r);
  joint.friction_tangent(q, q, t, q, k, k, k);
  { joint.dissipation(q, q, t, q) } -> std::convertible_to<double>;
};

/// Constraint that stores energy, such as that of end stops: potential(q, t) [J].
template <class C>
concept StoringConstraint = Constraint<C> && requires(const C joint, VectorIn q, double t) {
  { joint.potential(q, t) } -> std::convertible_to<double>;
};

}  // namespace sphmbs::mbs
