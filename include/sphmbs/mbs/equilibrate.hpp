// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/mbs/sparse_pattern.hpp>
#include <sphmbs/mbs/state.hpp>

namespace sphmbs::mbs {

/// Scales A to D A D such that massive coordinates have a diagonal of one and conditions rows of
/// length one. The index-3 matrix [M/(beta h^2) + ..., Phi_q^T; Phi_q, 0] thereby becomes
/// independent of the step h as h goes to nothing, and so does its condition (Bottasso, Dopico and
/// Trainelli, Multibody Syst. Dyn. 19, 2008, scale by beta h^2 to this end).
/// @return the diagonal of D: x of A x = b is D y with (D A D) y = D b
inline VectorXd equilibrate(SparseMatrix& A, const std::vector<Role>& roles) {
  const int n = static_cast<int>(A.rows());
  const auto role = [&](int k) { return roles[static_cast<std::size_t>(k)]; };
  VectorXd D = VectorXd::Ones(n), length = VectorXd::Zero(n);
  for (int j = 0; j < n; ++j) {
    if (role(j) != Role::massive) continue;
    const double diagonal = std::abs(A.coeff(j, j));
    if (diagonal > 0) D[j] = 1 / std::sqrt(diagonal);
    for (SparseMatrix::InnerIterator e(A, j); e; ++e)
      if (role(static_cast<int>(e.row())) == Role::multiplier)
        length[e.row()] += e.value() * e.value() * D[j] * D[j];
  }
  for (int i = 0; i < n; ++i)
    if (role(i) == Role::multiplier && length[i] > 0) D[i] = 1 / std::sqrt(length[i]);
  for (int j = 0; j < n; ++j) {
    if (role(j) != Role::massless) continue;
    double largest = 0;
    for (SparseMatrix::InnerIterator e(A, j); e; ++e)
      if (role(static_cast<int>(e.row())) == Role::multiplier)
        largest = std::max(largest, std::abs(e.value() * D[e.row()]));
    if (largest > 0) D[j] = 1 / largest;
  }
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator e(A, j); e; ++e) e.valueRef() *= D[e.row()] * D[j];
  return D;
}

}  // namespace sphmbs::mbs
