// SPDX-License-Identifier: MIT
// Solves a chain of springs by the policies that SuiteSparse brings.
#include <cstdio>

#include <sphmbs/mbs/solvers/suitesparse.hpp>

using namespace sphmbs::mbs;

template <class Solver>
bool solves() {
  constexpr int n = 50;
  SparseMatrix A(n, n);
  for (int i = 0; i < n; ++i) {
    A.insert(i, i) = 2;
    if (i > 0) A.insert(i, i - 1) = A.insert(i - 1, i) = -1;
  }
  A.makeCompressed();
  const VectorXd b = VectorXd::Ones(n);
  VectorXd x(n);
  Solver solver;
  solver.analyse(A, {});
  const bool good = solver.factorise(A);
  solver.solve(b, x);
  const double error = (A * x - b).norm();
  std::printf("%s: residual %.1e\n", Solver::name.data(), error);
  return good && error < 1e-10;
}

int main() { return solves<solvers::KLU>() && solves<solvers::UMFPACK>() ? 0 : 1; }
