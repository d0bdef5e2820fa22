// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// Motion of a structure at one instant: eq. (25) relates its members.
struct State {
  double t = 0;     // [s]
  VectorXd q;       // coordinates
  VectorXd v;       // dq/dt
  VectorXd vdot;    // d2q/dt2
  VectorXd lambda;  // Lagrange multipliers, one a condition; -Phi_q^T lambda is what joints exert
};

/// What the unknown at a place of [q, lambda] is; solvers that do not pivot order by it.
enum class Role : unsigned char { massive, massless, multiplier };

}  // namespace sphmbs::mbs
