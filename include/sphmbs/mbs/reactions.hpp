// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseLU>

#include <sphmbs/mbs/bordered.hpp>

namespace sphmbs::mbs {

/// Multipliers with the same reaction force Phi_q^T lambda and the smallest norm: where redundant
/// conditions share a load, they share it evenly. Each removed row of Phi_q is a combination of the
/// kept ones; lambda is made orthogonal to these dependences.
/// @param removed  the redundant conditions, without which Phi_q has full rank
template <class System>
VectorXd minimum_norm_multipliers(System& equations, const State& state,
                                  const std::vector<int>& removed) {
  const int n = equations.coordinates(), m = equations.conditions();
  equations.evaluate(state);
  const SparseMatrix columns = equations.jacobian().transpose();
  // [1, B^T; B, 0] [x; w] = [b, 0] with the kept rows B gives B^T w = b for a removed row b.
  SparseMatrix unit(n, n);
  unit.setIdentity();
  const Eigen::SparseLU<SparseMatrix> lu(bordered(equations, unit));
  VectorXd lambda = state.lambda;
  std::vector<VectorXd> dependences;
  for (const int i : removed) {
    VectorXd b = VectorXd::Zero(n + m);
    b.head(n) = columns.col(i);
    VectorXd z = VectorXd(lu.solve(b)).tail(m);
    z[i] = -1;
    for (const VectorXd& other : dependences) z -= other.dot(z) * other;
    z.normalize();
    lambda -= z.dot(lambda) * z;
    dependences.push_back(std::move(z));
  }
  return lambda;
}

}  // namespace sphmbs::mbs
