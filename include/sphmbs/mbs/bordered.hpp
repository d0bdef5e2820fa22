// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/mbs/equations.hpp>

namespace sphmbs::mbs {

/// [A, B^T; B, 0] over the unknowns [q, lambda], with B the Phi_q of the last evaluation; rows and
/// columns of removed conditions are those of the unit matrix.
template <class System>
SparseMatrix bordered(const System& equations, const SparseMatrix& A) {
  const int n = equations.coordinates(), m = equations.conditions();
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator e(A, j); e; ++e)
      entries.emplace_back(static_cast<int>(e.row()), j, e.value());
  const SparseMatrix B = equations.jacobian();
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator e(B, j); e; ++e) {
      const auto i = static_cast<int>(e.row());
      if (equations.removed(i)) continue;
      entries.emplace_back(n + i, j, e.value());
      entries.emplace_back(j, n + i, e.value());
    }
  for (int i = 0; i < m; ++i)
    if (equations.removed(i)) entries.emplace_back(n + i, n + i, 1.0);
  SparseMatrix whole(n + m, n + m);
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

}  // namespace sphmbs::mbs
