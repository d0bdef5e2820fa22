// SPDX-License-Identifier: MIT
#pragma once

/// Optional: needs SuiteSparse (target sphmbs::suitesparse; KLU is LGPL, UMFPACK is GPL).
#include <memory>

#include <Eigen/KLUSupport>
#include <Eigen/UmfPackSupport>

#include <sphmbs/mbs/solvers/linear_solver.hpp>

namespace sphmbs::mbs::solvers {

/// A direct solver with Eigen's interface, as a policy called Name::name.
template <class Direct, class Name>
class FromEigen {
 public:
  static constexpr std::string_view name = Name::text;  ///< name in reports

  ///@{ As `LinearSolver` asks.
  void analyse(const SparseMatrix& A, const std::vector<Role>&) {
    direct_ = std::make_unique<Direct>();
    direct_->analyzePattern(A);
  }

  bool factorise(const SparseMatrix& A) {
    direct_->factorize(A);
    return direct_->info() == Eigen::Success;
  }

  void solve(const VectorXd& b, VectorXd& x) const { x = direct_->solve(b); }
  ///@}

 private:
  std::unique_ptr<Direct> direct_;  // Eigen's cannot be moved
};

namespace detail {
struct KLUName {
  static constexpr std::string_view text = "SuiteSparse KLU";
};
struct UmfpackName {
  static constexpr std::string_view text = "SuiteSparse UMFPACK";
};
}  // namespace detail

/// LU for matrices that are nearly triangular, such as those of chains and cables (Davis and
/// Palamadai Natarajan, ACM Trans. Math. Softw. 37, 2010).
using KLU = FromEigen<Eigen::KLU<SparseMatrix>, detail::KLUName>;

/// Multifrontal LU (Davis, ACM Trans. Math. Softw. 30, 2004), for large plates.
using UMFPACK = FromEigen<Eigen::UmfPackLU<SparseMatrix>, detail::UmfpackName>;

static_assert(LinearSolver<KLU> && LinearSolver<UMFPACK>);

}  // namespace sphmbs::mbs::solvers
