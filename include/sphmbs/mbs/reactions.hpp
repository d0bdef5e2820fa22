// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/QR>

#include <sphmbs/mbs/equations.hpp>

namespace sphmbs::mbs {

/// Multipliers with the same reaction force Phi_q^T lambda and the smallest norm: where redundant
/// conditions share a load, they share it evenly. Dense in the conditions: for up to some hundreds.
template <class System>
VectorXd minimum_norm_multipliers(System& equations, const State& state) {
  equations.evaluate(state);
  const MatrixXd Bt = MatrixXd(equations.jacobian()).transpose();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> cod;
  cod.setThreshold(1e-9);
  cod.compute(Bt);
  return cod.solve(Bt * state.lambda);
}

}  // namespace sphmbs::mbs
