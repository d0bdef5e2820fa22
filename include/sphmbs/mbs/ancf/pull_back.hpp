// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ancf {

/// Scalar product without conjugation, so that complex numbers can carry a derivative.
template <class A, class B>
auto inner(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.cwiseProduct(b).sum();
}

/// Elements of scalar shape functions see their coordinates q, vectors q_1, q_2, ... of Dim
/// numbers, through few gradients g_i = sum_j C_ij q_j: g = (C x I) q. These functions take g from
/// q, and what the energy density says about g back to q.
template <int Dim, int Rows, int Columns, class S>
Vector<Dim * Rows, S> gradients(const Matrix<Rows, Columns>& C, const Vector<Dim * Columns, S>& q) {
  Vector<Dim * Rows, S> g = Vector<Dim * Rows, S>::Zero();
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j < Columns; ++j)
      g.template segment<Dim>(Dim * i) += C(i, j) * q.template segment<Dim>(Dim * j);
  return g;
}

/// f += (C x I)^T p.
template <int Dim, int Rows, int Columns, class S>
void add_pull_back(const Matrix<Rows, Columns>& C, const Vector<Dim * Rows, S>& p,
                   Vector<Dim * Columns, S>& f) {
  for (int i = 0; i < Rows; ++i)
    for (int j = 0; j < Columns; ++j)
      f.template segment<Dim>(Dim * j) += C(i, j) * p.template segment<Dim>(Dim * i);
}

/// K += (C x I)^T H (C x I).
template <int Dim, int Rows, int Columns>
void add_pull_back(const Matrix<Rows, Columns>& C, const Matrix<Dim * Rows, Dim * Rows>& H,
                   Matrix<Dim * Columns, Dim * Columns>& K) {
  for (int k = 0; k < Columns; ++k) {
    Matrix<Dim * Rows, Dim> HC = Matrix<Dim * Rows, Dim>::Zero();
    for (int l = 0; l < Rows; ++l) HC += C(l, k) * H.template middleCols<Dim>(Dim * l);
    for (int j = 0; j < Columns; ++j)
      for (int i = 0; i < Rows; ++i)
        K.template block<Dim, Dim>(Dim * j, Dim * k) +=
            C(i, j) * HC.template middleRows<Dim>(Dim * i);
  }
}

/// M += m x I.
template <int Dim, int n>
void add_blocks(const Matrix<n, n>& m, Matrix<Dim * n, Dim * n>& M) {
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      M.template block<Dim, Dim>(Dim * i, Dim * j).diagonal().array() += m(i, j);
}

}  // namespace sphmbs::mbs::ancf
