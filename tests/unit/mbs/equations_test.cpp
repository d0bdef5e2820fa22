// SPDX-License-Identifier: MIT
#include <omp.h>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"
#include "support/random.hpp"

#include <sphmbs/execution/serial.hpp>

using namespace sphmbs::mbs;
using test::double_pendulum;
using test::PlanarMechanism;
using test::thin_bar;

namespace {

/// A chain of bars hinged to each other and to the ground.
PlanarMechanism chain(int bars) {
  PlanarMechanism mechanism;
  mechanism.gravity = {0, -9.81};
  for (int k = 0; k < bars; ++k) {
    const auto bar = mechanism.add(thin_bar({k, 0}, {k + 1, 0}));
    const auto& all = mechanism.all<ncf::Bar>();
    mechanism.add(k == 0
                      ? joints::pinned(bar.start(), mechanism.q())
                      : joints::revolute(all[static_cast<std::size_t>(k) - 1].end(), bar.start()));
  }
  return mechanism;
}

template <class System>
State random_state(const System& equations, unsigned seed) {
  State state;
  const auto random = [&](int n, unsigned own) {
    std::srand(own);
    return VectorXd(VectorXd::Random(n));
  };
  state.q = random(equations.coordinates(), seed);
  state.v = random(equations.coordinates(), seed + 1);
  state.vdot = random(equations.coordinates(), seed + 2);
  state.lambda = random(equations.conditions(), seed + 3);
  return state;
}

}  // namespace

TEST_CASE("the iteration matrix is the derivative of the residual", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  Equations<PlanarMechanism> equations(mechanism);
  State state = random_state(equations, 7);
  const MatrixWeights w{3.5, 0.7};
  equations.evaluate(state, &w);
  SparseMatrix A;
  equations.matrix(w, A);
  const MatrixXd exact(A);
  const int n = equations.coordinates();
  // The residual is quadratic in q and lambda, so that central differences are exact.
  for (int k = 0; k < equations.unknowns(); ++k) {
    VectorXd side[2];
    for (const int s : {0, 1}) {
      State moved = state;
      const double step = s == 0 ? -0.5 : 0.5;
      if (k < n) {
        moved.q[k] += step;
        moved.v[k] += w.rate * step;
        moved.vdot[k] += w.mass * step;
      } else {
        moved.lambda[k - n] += step;
      }
      equations.evaluate(moved);
      equations.residual(moved.vdot, side[s]);
    }
    CHECK((side[1] - side[0] - exact.col(k)).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("residual and matrix have the same bits for any number of threads", "[mbs]") {
  PlanarMechanism mechanism = chain(200);
  const int before = omp_get_max_threads();
  const auto assemble = [&]<class Policy>(Policy) {
    Equations<PlanarMechanism, Policy> equations(mechanism);
    const State state = random_state(equations, 3);
    const MatrixWeights w{1e4, 1e2};
    equations.evaluate(state, &w);
    VectorXd r;
    equations.residual(state.vdot, r);
    SparseMatrix A;
    equations.matrix(w, A);
    return std::pair{r, VectorXd(VectorXd::Map(A.valuePtr(), A.nonZeros()))};
  };
  const auto serial = assemble(sphmbs::execution::Serial{});
  for (const int threads : {1, 2, 3, 7}) {
    omp_set_num_threads(threads);
    const auto parallel = assemble(sphmbs::execution::OpenMP{});
    CHECK(parallel.first == serial.first);
    CHECK(parallel.second == serial.second);
  }
  omp_set_num_threads(before);
}

TEST_CASE("gravity is the mass matrix times a uniform acceleration", "[mbs]") {
  PlanarMechanism mechanism = chain(5);
  Equations<PlanarMechanism> equations(mechanism);
  const auto& T = equations.translation();
  const Matrix<2, 2> mass = T.transpose() * equations.mass() * T;
  CHECK((mass - 5 * Matrix<2, 2>::Identity()).norm() < 1e-13);
  State state = random_state(equations, 1);
  state.q = mechanism.q();
  state.v.setZero();
  state.lambda.setZero();
  equations.evaluate(state);
  VectorXd r;
  equations.residual(T * mechanism.gravity, r);  // free fall
  CHECK(r.head(equations.coordinates()).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("an unknown is named after the joint or part it belongs to", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  Equations<PlanarMechanism> equations(mechanism);
  CHECK(equations.name_of(0) == "bar 0 (nodes 0, 1)");
  CHECK(equations.name_of(7) == "bar 1 (nodes 2, 3)");
  CHECK(equations.name_of_condition(1) == "bar 1 (nodes 2, 3)");  // its rigidity
  CHECK(equations.name_of_condition(2) == "pinned 'root'");
  CHECK(equations.name_of_condition(5) == "revolute 'knee'");
}

TEST_CASE("the scaled iteration matrix keeps its condition for short steps", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  Equations<PlanarMechanism> equations(mechanism);
  State state = random_state(equations, 5);
  state.q = mechanism.q();
  const auto condition = [&](double h) {
    const MatrixWeights w{4 / (h * h), 2 / h};
    equations.evaluate(state, &w);
    SparseMatrix A;
    equations.matrix(w, A);
    equilibrate(A, equations.roles());
    const Eigen::JacobiSVD<MatrixXd> svd{MatrixXd(A)};
    return svd.singularValues().maxCoeff() / svd.singularValues().minCoeff();
  };
  const double at_one = condition(1e-3);
  CHECK(at_one < 100);
  for (const double h : {1e-4, 1e-6, 1e-8}) CHECK(condition(h) < 1.1 * at_one);
}
