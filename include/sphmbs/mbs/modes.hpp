// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/equations.hpp>

namespace sphmbs::mbs {

/// Small vibrations about a state.
struct Modes {
  VectorXd squares;  ///< omega^2, ascending; near zero: free motion; negative: unstable [rad^2/s^2]
  MatrixXd shapes;   ///< one column a mode, over all coordinates, of unit modal mass

  /// omega of the k-th mode; 0 where its square is not positive [rad/s]
  double frequency(int k) const { return std::sqrt(std::max(0.0, squares[k])); }
};

namespace detail {

/// Of K x = omega^2 M x where B x = 0. A template, so that programs without modes do not compile
/// it.
template <class Dense>
Modes constrained_modes(const Dense& K, const SparseMatrix& M, const Dense& B) {
  const auto n = K.rows();
  Dense Z = Dense::Identity(n, n);
  if (B.rows() > 0) {
    Dense Bt = B.transpose();
    Bt.colwise().normalize();
    Eigen::ColPivHouseholderQR<Dense> qr;
    qr.setThreshold(1e-9);
    qr.compute(Bt);
    const Dense Q = qr.householderQ();
    Z = Q.rightCols(n - qr.rank());
  }
  const Dense Kz = Z.transpose() * (0.5 * (K + K.transpose())) * Z;
  const Dense Mz = Z.transpose() * (M * Z);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Dense> solver(Kz, Mz);
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite())
    throw NumericalFailure("Eigenmodes: a motion that the conditions leave has no mass.", "E337");
  return {solver.eigenvalues(), Z * solver.eigenvectors()};
}

}  // namespace detail

/// Eigenfrequencies of eq. (25) linearised about a state at rest, on the motions that conditions
/// leave: Z^T (K + d(Phi_q^T lambda)/dq) Z x = omega^2 Z^T M Z x with Phi_q Z = 0. Damping does not
/// enter; of an unsymmetric stiffness the symmetric half is taken. Dense: memory grows with the
/// square and time with the cube of the coordinates, seconds for 1000, minutes for 4000.
/// @param state  with the multipliers of an equilibrium, such as that of equilibrium()
/// @throws InvalidInput beyond 6000 coordinates, and for a state of another structure;
///         NumericalFailure where a motion has no mass.
template <class Policy = execution::Default, class Structure>
Modes eigenmodes(Structure& structure, const State& state) {
  constexpr int most = 6000;
  const int n = structure.coordinates();
  expects(n <= most, "number of coordinates", n, "at most 6000 for the dense eigenvalue problem");
  expects(state.q.size() == n && state.v.size() == n, "state: number of coordinates",
          state.q.size(), std::to_string(n) + ", with as many rates");
  Equations<Structure, Policy> equations(structure);
  expects(state.lambda.size() == equations.conditions(), "state: number of multipliers",
          state.lambda.size(), std::to_string(equations.conditions()));
  equations.relocate(state.q);
  const MatrixWeights weights{0, 0};
  equations.evaluate(state, &weights);
  SparseMatrix A;
  equations.matrix(weights, A);
  const MatrixXd K = MatrixXd(A).topLeftCorner(n, n);
  return detail::constrained_modes<MatrixXd>(K, equations.mass(), equations.jacobian());
}

/// The same about the coordinates at t = 0 of a structure that is free of stress there.
template <class Policy = execution::Default, class Structure>
Modes eigenmodes(Structure& structure) {
  const VectorXd still = VectorXd::Zero(structure.coordinates());
  State state{.t = 0, .q = structure.q(), .v = still, .vdot = still, .lambda = {}};
  state.lambda = VectorXd::Zero(Equations<Structure, Policy>(structure).conditions());
  return eigenmodes<Policy>(structure, state);
}

}  // namespace sphmbs::mbs
