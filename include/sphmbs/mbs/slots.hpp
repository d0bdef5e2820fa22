// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/state.hpp>
#include <sphmbs/mbs/structure.hpp>

namespace sphmbs::mbs {

/// Place of one component's contribution to eq. (25): n coordinates and m conditions, a residual of
/// n + m numbers, and matrix blocks A (n x n), B = Phi_q (m x n) and, with friction, L (n x m);
/// C (n x n) is scratch.
struct Slot {
  int n = 0;                ///< coordinates
  int m = 0;                ///< conditions
  int first_condition = 0;  ///< of its conditions among all
  std::size_t index = 0;    ///< of its list of n coordinates
  std::size_t vector = 0;   ///< of its residual
  std::size_t matrix = 0;   ///< of its blocks A, B, L
  bool has_A = true;        ///< whether there is a block A
  bool has_L = false;       ///< whether there is a block L
  bool has_C = false;       ///< whether there is a block C

  ///@{ Where blocks begin, and the last one ends, among all numbers.
  std::size_t at_B() const { return matrix + (has_A ? static_cast<std::size_t>(n * n) : 0); }
  std::size_t at_L() const { return at_B() + static_cast<std::size_t>(n * m); }
  std::size_t at_C() const { return at_L() + (has_L ? static_cast<std::size_t>(n * m) : 0); }
  std::size_t matrix_end() const { return at_C() + (has_C ? static_cast<std::size_t>(n * n) : 0); }
  ///@}
};

/// Size of the contribution of a component.
template <class T, class Stored>
Slot slot_of(const Stored& component) {
  Slot slot;
  if constexpr (Part<T>) {
    slot.n = T::dofs;
    if constexpr (Body<T>) slot.m = T::conditions;
  } else {
    slot.n = static_cast<int>(component.index().size());
    if constexpr (Constraint<T>) slot.m = component.conditions();
    if constexpr (LinearConstraint<T>) slot.has_A = !component.linear();
    if constexpr (FrictionalConstraint<T>) slot.has_A = slot.has_L = slot.has_C = true;
    if constexpr (Force<T>) slot.has_C = true;
  }
  return slot;
}

/// Everything a component may look at while it computes its contribution.
struct Local {
  Eigen::Map<VectorXd> q;       ///< its own coordinates
  Eigen::Map<VectorXd> v;       ///< their rates
  Eigen::Map<VectorXd> lambda;  ///< its own multipliers
  double t;                     ///< [s]
  double load_factor;           ///< share of the loads that acts
};

/// What a component contributes: r to the left of eq. (25), Phi, and where asked A = dr/dq + w
/// dr/dv with the part of Phi_q^T lambda, B = Phi_q, L = dr/dlambda beyond B^T.
struct Contribution {
  Eigen::Map<VectorXd> r;    ///< forces, length n
  Eigen::Map<VectorXd> phi;  ///< conditions, length m
  Eigen::Map<MatrixXd> A;    ///< n x n; empty where nothing is asked for
  Eigen::Map<MatrixXd> B;    ///< m x n
  Eigen::Map<MatrixXd> L;    ///< n x m; empty without friction
  Eigen::Map<MatrixXd> C;    ///< scratch, n x n
  double w;                  ///< dv/dq of the integrator [1/s]
  bool tangent;              ///< whether A and L are asked for; B always is
};

/// What an element adds.
template <Element E>
void contribute(const Placed<E>& placed, const Local& x, Contribution& out) {
  const Vector<E::dofs> q = x.q, v = x.v;
  out.r = placed.part.internal_force(q, v);
  if (out.tangent) out.A = placed.part.tangent(q, v, out.w);
}

/// What a rigid body adds.
template <Body T>
void contribute(const Placed<T>& placed, const Local& x, Contribution& out) {
  const Vector<T::dofs> q = x.q;
  const Vector<T::conditions> lambda = x.lambda;
  out.phi = placed.part.rigidity(q);
  out.B = placed.part.rigidity_jacobian(q);
  out.r.noalias() = out.B.transpose() * x.lambda;
  if (out.tangent) out.A = placed.part.rigidity_hessian(lambda);
}

/// What a joint adds.
template <Constraint T>
void contribute(const T& joint, const Local& x, Contribution& out) {
  out.phi.setZero();
  out.B.setZero();
  joint.residual(x.q, x.t, out.phi);
  joint.jacobian(x.q, x.t, out.B);
  out.r.setZero();
  if constexpr (FrictionalConstraint<T>) joint.friction(x.q, x.v, x.t, x.lambda, out.r);
  out.r.noalias() += out.B.transpose() * x.lambda;
  if (!out.tangent) return;
  if (out.A.size() > 0) {
    out.A.setZero();
    joint.add_hessian(x.q, x.t, x.lambda, out.A);
  }
  if constexpr (FrictionalConstraint<T>) {
    out.C.setZero();
    out.L.setZero();
    joint.friction_tangent(x.q, x.v, x.t, x.lambda, out.A, out.C, out.L);
    out.A += out.w * out.C;
  }
}

template <Force T>
void contribute(const T& load, const Local& x, Contribution& out) {
  double factor = 1;
  if constexpr (Load<T>) factor = x.load_factor;
  out.r.setZero();
  load.force(x.q, x.v, x.t, out.r);
  out.r *= -factor;
  if (!out.tangent) return;
  out.A.setZero();
  out.C.setZero();
  load.tangent(x.q, x.v, x.t, out.A, out.C);
  out.A = -factor * (out.A + out.w * out.C);
}

}  // namespace sphmbs::mbs
