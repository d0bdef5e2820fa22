// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;

TEMPLATE_TEST_CASE("a sparse solver solves the equations of a constrained mechanism", "[mbs]",
                   solvers::SparseLU, solvers::SparseLDLT) {
  test::PlanarMechanism mechanism = test::double_pendulum();
  Equations<test::PlanarMechanism> equations(mechanism);
  State state;
  state.q = mechanism.q();
  state.v = state.vdot = mechanism.v();
  state.lambda = VectorXd::LinSpaced(equations.conditions(), -1, 1);
  const MatrixWeights w{4e6, 2e3};
  equations.evaluate(state, &w);
  SparseMatrix A;
  equations.matrix(w, A);
  equilibrate(A, equations.roles());
  TestType solver;
  solver.analyse(A, equations.roles());
  const VectorXd x = VectorXd::LinSpaced(equations.unknowns(), 1, 2);
  for (int repeat = 0; repeat < 2; ++repeat) {  // the analysis serves again
    REQUIRE(solver.factorise(A));
    VectorXd found;
    solver.solve(A * x, found);
    CHECK((found - x).cwiseAbs().maxCoeff() < 1e-11);
    A *= 2;
  }
}

TEMPLATE_TEST_CASE("a singular matrix is reported", "[mbs][fault]", solvers::SparseLU,
                   solvers::SparseLDLT) {
  CHECK_FALSE(test::factorises_singular_matrix<TestType>());
}
