// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// What a joint exerts on its part a.
template <int Dim>
struct Reaction {
  static constexpr int rotations = Dim == 2 ? 1 : 3;     ///< components of a moment
  Vector<Dim> force = Vector<Dim>::Zero();               ///< at the joint's point of a [N]
  Vector<rotations> couple = Vector<rotations>::Zero();  ///< [N m]
};

/// u x w; its one component in 2D.
template <int Dim>
Vector<Reaction<Dim>::rotations> cross(const Vector<Dim>& u, const Vector<Dim>& w) {
  if constexpr (Dim == 2) {
    return Vector<1>(u[0] * w[1] - u[1] * w[0]);
  } else {
    return u.cross(w);
  }
}

/// Force and couple of a joint on its part a, that of the joint's first argument: -Phi_q^T lambda
/// put into words. Part b receives the opposite force, at its own point, and the couple that
/// balances both. What `component` and `linear` hold is taken for points.
/// @param q all coordinates of the structure
/// @param lambda the joint's own multipliers
template <int Dim>
Reaction<Dim> reaction(const Joint<Dim>& joint, const VectorXd& q, double t,
                       const VectorXd& lambda) {
  const VectorXd own = q(joint.index());
  Reaction<Dim> sum;
  int row = 0;
  for (const Held<Dim>& h : joint.held()) {
    const Vector<Dim> push = -lambda.segment<Dim>(row);
    if (h.points) {
      sum.force += push;
    } else {
      sum.couple += cross<Dim>(value(h.a, own), push);
    }
    row += Dim;
  }
  for (const Product<Dim>& p : joint.products()) {
    for (const Term<Dim>& term : p.terms) {
      const double s = -lambda[row] * p.scale * term.f.value(t);
      const Vector<Dim> u = value(term.u.marker, own), w = value(term.w.marker, own);
      if (term.u.role == Role::gap) sum.force += s * w;
      if (term.w.role == Role::gap) sum.force += s * u;
      if (term.u.role == Role::vector_of_a) sum.couple += s * cross<Dim>(u, w);
      if (term.w.role == Role::vector_of_a) sum.couple += s * cross<Dim>(w, u);
    }
    ++row;
  }
  return sum;
}

}  // namespace sphmbs::mbs::joints
