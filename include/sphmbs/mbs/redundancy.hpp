// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include <sphmbs/mbs/sparse_pattern.hpp>

namespace sphmbs::mbs {

namespace detail {

/// Dependent columns of a dense matrix by QR with pivoting; columns of `first` are taken as
/// independent where there is a choice.
inline std::vector<int> dependent_by_qr(MatrixXd columns, const std::vector<unsigned char>& first,
                                        double nothing) {
  constexpr double ahead = 1e3;  // longer columns are pivoted to the front
  for (int j = 0; j < columns.cols(); ++j)
    if (first[static_cast<std::size_t>(j)] != 0) columns.col(j) *= ahead;
  const double longest = columns.colwise().norm().maxCoeff();
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(longest > 0 ? nothing / longest : 1);
  qr.compute(columns);
  std::vector<int> dependent;
  for (int k = static_cast<int>(qr.rank()); k < columns.cols(); ++k)
    dependent.push_back(qr.colsPermutation().indices()[k]);
  return dependent;
}

/// Columns of `first` in their order, then the others such that elimination fills in little.
inline Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> elimination_order(
    const SparseMatrix& gram, const std::vector<unsigned char>& first) {
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  const auto n = static_cast<int>(gram.cols());
  Permutation split(n);
  int place = 0;
  for (const bool wanted : {true, false})
    for (int j = 0; j < n; ++j)
      if ((first[static_cast<std::size_t>(j)] != 0) == wanted) split.indices()[j] = place++;
  const auto head = static_cast<int>(
      std::count_if(first.begin(), first.end(), [](unsigned char f) { return f != 0; }));
  const SparseMatrix sorted = split * gram * split.transpose();
  const SparseMatrix tail_rows = SparseMatrix(sorted.rightCols(n - head)).transpose();
  const SparseMatrix to_head = tail_rows.leftCols(head);
  const SparseMatrix left = SparseMatrix(tail_rows.rightCols(n - head)) +
                            SparseMatrix(to_head * SparseMatrix(to_head.transpose()));
  Permutation tail;
  Eigen::AMDOrdering<int>()(left.selfadjointView<Eigen::Lower>(), tail);
  Permutation order(n);
  // AMDOrdering gives the column at each place, products with Permutation need the reverse.
  const Permutation where = tail.inverse();
  for (int j = 0; j < n; ++j) {
    const int at = split.indices()[j];
    order.indices()[j] = at < head ? at : head + where.indices()[at - head];
  }
  return order;
}

/// As dependent_by_qr, of unit columns, by the pivots of their Gram matrix: squares of lengths that
/// columns before do not explain. Columns with small pivots are then compared with all others by
/// least squares. Cost grows with the number of columns where each shares rows with few others.
inline std::vector<int> dependent_by_pivots(SparseMatrix columns,
                                            const std::vector<unsigned char>& first,
                                            double nothing) {
  constexpr double small = 1e-6;  // pivot of a column to look at: smaller ones may be rounding
  constexpr double lift = 1e-15;  // pivots of dependent columns are not exactly zero
  const auto order = elimination_order(SparseMatrix(columns.transpose() * columns), first);
  columns = SparseMatrix(columns * order.transpose());
  SparseMatrix gram = columns.transpose() * columns;
  for (int j = 0; j < gram.cols(); ++j) gram.coeffRef(j, j) += lift;
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt;
  ldlt.analyzePattern(gram);
  std::vector<int> candidates;
  // A tiny pivot spoils those after it: again without the columns found.
  for (std::size_t before = 1; before != candidates.size();) {
    before = candidates.size();
    ldlt.factorize(gram);
    const VectorXd pivots = ldlt.vectorD();
    for (int j = 0; j < gram.cols(); ++j) {
      if (pivots[j] > small) continue;
      candidates.push_back(j);
      for (SparseMatrix::InnerIterator e(gram, j); e; ++e) {
        const auto i = static_cast<int>(e.row());
        gram.coeffRef(i, j) = gram.coeffRef(j, i) = i == j ? 1 : 0;
      }
    }
  }

  SparseMatrix kept = columns;
  for (const int j : candidates) kept.col(j) *= 0;
  std::vector<int> dependent, doubtful;
  std::vector<VectorXd> unexplained;
  for (const int j : candidates) {
    constexpr int refinements = 4;
    VectorXd rest = columns.col(j);
    for (int k = 0; k < refinements && rest.norm() > nothing; ++k)
      rest -= kept * ldlt.solve(kept.transpose() * rest);
    if (rest.norm() <= nothing) {
      dependent.push_back(j);
    } else {
      doubtful.push_back(j);
      unexplained.push_back(rest);
    }
  }
  if (!doubtful.empty()) {
    MatrixXd rest(columns.rows(), static_cast<int>(doubtful.size()));
    for (std::size_t k = 0; k < doubtful.size(); ++k)
      rest.col(static_cast<int>(k)) = unexplained[k];
    for (const int k : dependent_by_qr(rest, std::vector<unsigned char>(doubtful.size()), nothing))
      dependent.push_back(doubtful[static_cast<std::size_t>(k)]);
  }
  const auto original = order.inverse().eval();
  for (int& j : dependent) j = original.indices()[j];
  return dependent;
}

}  // namespace detail

/// Rows of Phi_q that depend on the others: joints that hold what others hold already. Rows are
/// compared at unit length.
/// @param first    1 for rows that are to be kept where there is a choice, those of rigid bodies
/// @param nothing  length of what others do not explain, up to which a row counts as dependent
/// @return their numbers, ascending; the other rows are independent
inline std::vector<int> redundant_rows(const SparseMatrix& phi_q,
                                       const std::vector<unsigned char>& first,
                                       double nothing = 1e-9) {
  constexpr int few = 400;  // rows up to which the dense decomposition is as fast
  const auto m = static_cast<int>(phi_q.rows());
  if (m == 0) return {};
  SparseMatrix columns = phi_q.transpose();
  for (int j = 0; j < m; ++j) {
    const double length = columns.col(j).norm();
    if (length > 0) columns.col(j) /= length;
  }
  std::vector<int> dependent = m <= few ? detail::dependent_by_qr(MatrixXd(columns), first, nothing)
                                        : detail::dependent_by_pivots(columns, first, nothing);
  std::sort(dependent.begin(), dependent.end());
  return dependent;
}

}  // namespace sphmbs::mbs
