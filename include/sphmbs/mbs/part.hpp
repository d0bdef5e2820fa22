// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string_view>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// Matter that follows generalized coordinates: r = N(X) q, N independent of q.
///   Material       material coordinates X of a point, Vector<1>, <2> or <3>
///   label          what messages call it: "cable"
///   nodes          how many nodes carry its coordinates, node_dofs coordinates each;
///                  dofs = nodes * node_dofs. Parts that share a node are joined there.
///   check()        @throws InvalidInput for parameters out of range
///   mass_matrix()  M = integral of rho N^T N dV, constant
///   shape(X)       N(X)
///   translation()  T with N(X) T = 1 for all X: the coordinates of a unit translation, so that
///                  gravity is M T g and the mass is the trace of T^T M T over dim
template <class P>
concept Part = std::copyable<P> && requires(const P part, const typename P::Material X) {
  { P::label } -> std::convertible_to<std::string_view>;
  { P::dim } -> std::convertible_to<int>;
  { P::nodes } -> std::convertible_to<int>;
  { P::node_dofs } -> std::convertible_to<int>;
  { P::dofs } -> std::convertible_to<int>;
  part.check();
  { part.mass_matrix() } -> std::same_as<Matrix<P::dofs, P::dofs>>;
  { part.shape(X) } -> std::same_as<Matrix<P::dim, P::dofs>>;
  { P::translation() } -> std::same_as<Matrix<P::dofs, P::dim>>;
};

/// Flexible part: its shape is kept by elastic forces.
///   strain_energy(q)      U [J]
///   internal_force(q, v)  F = dU/dq plus the force of internal damping, on the left of eq. (25)
///   tangent(q, v, w)      dF/dq + w dF/dv, dense and local
///   dissipation(q, v)     power that internal damping takes [W]
template <class E>
concept Element = Part<E> && requires(const E element, const Vector<E::dofs> q, double w) {
  { element.strain_energy(q) } -> std::same_as<double>;
  { element.internal_force(q, q) } -> std::same_as<Vector<E::dofs>>;
  { element.tangent(q, q, w) } -> std::same_as<Matrix<E::dofs, E::dofs>>;
  { element.dissipation(q, q) } -> std::same_as<double>;
};

/// Rigid part in natural coordinates: its shape is kept by algebraic conditions, at most quadratic
/// in q.
///   conditions                how many
///   rigidity(q)               Phi(q)
///   rigidity_jacobian(q)      Phi_q
///   rigidity_hessian(lambda)  d(Phi_q^T lambda)/dq, independent of q
///   initial_coordinates(), initial_rates()  where the body starts and how fast
template <class B>
concept Body = Part<B> &&
    requires(const B body, const Vector<B::dofs> q, const Vector<B::conditions> lambda) {
  { B::conditions } -> std::convertible_to<int>;
  { body.rigidity(q) } -> std::same_as<Vector<B::conditions>>;
  { body.rigidity_jacobian(q) } -> std::same_as<Matrix<B::conditions, B::dofs>>;
  { body.rigidity_hessian(lambda) } -> std::same_as<Matrix<B::dofs, B::dofs>>;
  { body.initial_coordinates() } -> std::same_as<Vector<B::dofs>>;
  { body.initial_rates() } -> std::same_as<Vector<B::dofs>>;
};

}  // namespace sphmbs::mbs
