// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <Eigen/SparseLU>

#include <sphmbs/mbs/solvers/linear_solver.hpp>

namespace sphmbs::mbs::solvers {

/// Supernodal LU with partial pivoting (Eigen), for any regular matrix: the default.
class SparseLU {
 public:
  static constexpr std::string_view name = "Eigen SparseLU";  ///< name in reports

  ///@{ As `LinearSolver` asks.
  void analyse(const SparseMatrix& A, const std::vector<Role>&) {
    lu_ = std::make_unique<Eigen::SparseLU<SparseMatrix>>();
    lu_->analyzePattern(A);
  }

  bool factorise(const SparseMatrix& A) {
    lu_->factorize(A);
    return lu_->info() == Eigen::Success;
  }

  void solve(const VectorXd& b, VectorXd& x) const { x = lu_->solve(b); }
  ///@}

 private:
  std::unique_ptr<Eigen::SparseLU<SparseMatrix>> lu_;  // Eigen's cannot be moved
};

static_assert(LinearSolver<SparseLU>);

}  // namespace sphmbs::mbs::solvers
