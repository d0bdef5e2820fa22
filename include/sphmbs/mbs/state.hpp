// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/archive.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// Motion of a structure at one instant: eq. (25) relates its members.
struct State {
  double t = 0;     ///< [s]
  VectorXd q;       ///< coordinates
  VectorXd v;       ///< dq/dt
  VectorXd vdot;    ///< d2q/dt2
  VectorXd lambda;  ///< Lagrange multipliers, one a condition; -Phi_q^T lambda is what joints exert

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("t", t);
    archive("q", q);
    archive("v", v);
    archive("vdot", vdot);
    archive("lambda", lambda);
  }
};

/// Weights of the iteration matrix: mass * M + d/dq + rate * d/dv.
struct MatrixWeights {
  double mass;  ///< dvdot/dq of the integrator [1/s^2]
  double rate;  ///< dv/dq [1/s]
};

/// What the unknown at a place of [q, lambda] is; solvers that do not pivot order by it.
enum class Role : unsigned char { massive, massless, multiplier };

}  // namespace sphmbs::mbs
