// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/QR>
#include <Eigen/SparseQR>

#include <sphmbs/mbs/sparse_pattern.hpp>

namespace sphmbs::mbs {

/// Rows of Phi_q that depend on the others: joints that hold what others hold already. Rows are
/// compared at unit length.
/// @param nothing  length of what others do not explain, up to which a row counts as dependent
/// @return their numbers, ascending; the other rows are independent
inline std::vector<int> redundant_rows(const SparseMatrix& phi_q, double nothing = 1e-9) {
  constexpr int small = 400;  // rows up to which a dense, more reliable decomposition serves
  const int m = static_cast<int>(phi_q.rows());
  if (m == 0) return {};
  SparseMatrix columns = phi_q.transpose();
  std::vector<int> dependent;
  for (int j = 0; j < m; ++j) {
    const double length = columns.col(j).norm();
    if (length > 0) columns.col(j) /= length;
  }
  const auto collect = [&](const auto& qr) {
    for (int k = static_cast<int>(qr.rank()); k < m; ++k)
      dependent.push_back(qr.colsPermutation().indices()[k]);
  };
  if (m <= small) {
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(nothing);
    qr.compute(MatrixXd(columns));
    collect(qr);
  } else {
    Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
    qr.setPivotThreshold(nothing);
    columns.makeCompressed();
    qr.compute(columns);
    collect(qr);
  }
  std::sort(dependent.begin(), dependent.end());
  return dependent;
}

}  // namespace sphmbs::mbs
