// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string_view>

#include <sphmbs/mbs/sparse_pattern.hpp>
#include <sphmbs/mbs/state.hpp>

namespace sphmbs::mbs::solvers {

/// Solves A x = b with the sparse iteration matrix of eq. (25).
///   analyse(A, roles)  once for each pattern; roles says what each unknown is
///   factorise(A)       @return whether the matrix is regular; its pattern is that of analyse()
///   solve(b, x)        with the last factors
template <class S>
concept LinearSolver = std::default_initializable<S> &&
    requires(S solver, const SparseMatrix& A, const std::vector<Role>& roles, const VectorXd& b,
             VectorXd& x) {
  { S::name } -> std::convertible_to<std::string_view>;
  solver.analyse(A, roles);
  { solver.factorise(A) } -> std::same_as<bool>;
  solver.solve(b, x);
};

}  // namespace sphmbs::mbs::solvers
