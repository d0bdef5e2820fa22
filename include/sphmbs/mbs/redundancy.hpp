// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <sphmbs/mbs/sparse_pattern.hpp>

namespace sphmbs::mbs {

namespace detail {

/// Dependent columns of a dense matrix: in turns the longest is taken, and those left are made
/// orthogonal to it, until none is longer than `nothing`. Columns of `first` are taken as
/// independent where there is a choice.
inline std::vector<int> dependent_by_length(MatrixXd columns,
                                            const std::vector<unsigned char>& first,
                                            double nothing) {
  // Eigen's QR with pivoting does the same, and costs programs four seconds to compile.
  constexpr double ahead = 1e3;  // longer columns are taken first
  const auto n = static_cast<int>(columns.cols());
  std::vector<int> left(static_cast<std::size_t>(n));
  std::iota(left.begin(), left.end(), 0);
  VectorXd length(n);
  for (int j = 0; j < n; ++j) {
    if (first[static_cast<std::size_t>(j)] != 0) columns.col(j) *= ahead;
    length[j] = columns.col(j).norm();
  }
  for (auto begin = left.begin(); begin != left.end(); begin = left.erase(begin)) {
    const auto shorter = [&](int a, int b) { return length[a] < length[b]; };
    std::iter_swap(begin, std::max_element(begin, left.end(), shorter));
    if (length[*begin] <= nothing) break;
    const VectorXd unit = columns.col(*begin) / length[*begin];
    for (auto other = begin + 1; other != left.end(); ++other) {
      columns.col(*other) -= unit.dot(columns.col(*other)) * unit;
      length[*other] = columns.col(*other).norm();
    }
  }
  return left;
}

/// Columns of `first` in their order, then the others such that elimination fills in little: which
/// column is at each place.
inline std::vector<int> elimination_order(const SparseMatrix& gram,
                                          const std::vector<unsigned char>& first) {
  const auto n = static_cast<int>(gram.cols());
  const auto wanted = [&](int j) { return first[static_cast<std::size_t>(j)] != 0; };
  std::vector<int> order(static_cast<std::size_t>(n)), place(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  const auto head = std::stable_partition(order.begin(), order.end(), wanted) - order.begin();
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k) - static_cast<int>(head);

  // Which of the others meet, by themselves or once those of `first` are eliminated.
  std::vector<Eigen::Triplet<double>> meetings;
  for (int j = 0; j < n; ++j) {
    std::vector<int> others;
    for (SparseMatrix::InnerIterator e(gram, j); e; ++e)
      if (const auto i = static_cast<int>(e.row()); !wanted(i))
        others.push_back(place[static_cast<std::size_t>(i)]);
    const int own = place[static_cast<std::size_t>(j)];
    for (const int a : others)
      if (!wanted(j))
        meetings.emplace_back(a, own, 1.0);
      else
        for (const int b : others) meetings.emplace_back(a, b, 1.0);
  }
  SparseMatrix graph(n - head, n - head);
  graph.setFromTriplets(meetings.begin(), meetings.end());
  Eigen::AMDOrdering<int>::PermutationType little;
  Eigen::AMDOrdering<int>()(graph, little);
  const std::vector<int> others(order.begin() + head, order.end());
  for (std::size_t k = 0; k < others.size(); ++k)
    order[static_cast<std::size_t>(head) + k] =
        others[static_cast<std::size_t>(little.indices()[static_cast<int>(k)])];
  return order;
}

inline SparseMatrix columns_in_order(const SparseMatrix& columns, const std::vector<int>& order) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (SparseMatrix::InnerIterator e(columns, order[k]); e; ++e)
      entries.emplace_back(static_cast<int>(e.row()), static_cast<int>(k), e.value());
  SparseMatrix ordered(columns.rows(), columns.cols());
  ordered.setFromTriplets(entries.begin(), entries.end());
  return ordered;
}

inline SparseMatrix gram_matrix(const SparseMatrix& columns) {
  const SparseMatrix rows = columns.transpose();
  return rows * columns;
}

/// As dependent_by_length, of unit columns, by the pivots of their Gram matrix: squares of lengths
/// that columns before do not explain. Columns with small pivots are then compared with all others
/// by least squares. Cost grows with the number of columns where each shares rows with few others.
inline std::vector<int> dependent_by_pivots(SparseMatrix columns,
                                            const std::vector<unsigned char>& first,
                                            double nothing) {
  constexpr double small = 1e-6;  // pivot of a column to look at: smaller ones may be rounding
  constexpr double lift = 1e-15;  // pivots of dependent columns are not exactly zero
  const std::vector<int> order = elimination_order(gram_matrix(columns), first);
  columns = columns_in_order(columns, order);
  SparseMatrix gram = gram_matrix(columns);
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
  for (const int j : candidates)
    for (SparseMatrix::InnerIterator e(kept, j); e; ++e) e.valueRef() = 0;
  std::vector<int> dependent, doubtful;
  std::vector<VectorXd> unexplained;
  for (const int j : candidates) {
    constexpr int refinements = 4;
    VectorXd rest = VectorXd::Zero(columns.rows());
    for (SparseMatrix::InnerIterator e(columns, j); e; ++e) rest[e.row()] = e.value();
    for (int k = 0; k < refinements && rest.norm() > nothing; ++k) {
      const VectorXd shares = kept.transpose() * rest, explained = ldlt.solve(shares);
      rest -= kept * explained;
    }
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
    const std::vector<unsigned char> none(doubtful.size());
    for (const int k : dependent_by_length(rest, none, nothing))
      dependent.push_back(doubtful[static_cast<std::size_t>(k)]);
  }
  for (int& j : dependent) j = order[static_cast<std::size_t>(j)];
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
    double square = 0;
    for (SparseMatrix::InnerIterator e(columns, j); e; ++e) square += e.value() * e.value();
    if (square == 0) continue;
    for (SparseMatrix::InnerIterator e(columns, j); e; ++e) e.valueRef() /= std::sqrt(square);
  }
  std::vector<int> dependent = m <= few
                                   ? detail::dependent_by_length(MatrixXd(columns), first, nothing)
                                   : detail::dependent_by_pivots(columns, first, nothing);
  std::sort(dependent.begin(), dependent.end());
  return dependent;
}

}  // namespace sphmbs::mbs
