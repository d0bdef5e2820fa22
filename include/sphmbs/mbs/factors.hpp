// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/equations.hpp>
#include <sphmbs/mbs/equilibrate.hpp>
#include <sphmbs/mbs/solvers/linear_solver.hpp>

namespace sphmbs::mbs {

/// Factors of the iteration matrix, kept for as long as they serve.
template <solvers::LinearSolver Solver>
class Factors {
 public:
  /// Whether there are factors for this pattern and these weights, from whatever state.
  bool serve(int topology, const MatrixWeights& weights) const {
    constexpr double rounding = 1e-9;  // of steps that are meant to be equal
    return regular_ && topology_ == topology &&
           std::abs(weights_.mass - weights.mass) <= rounding * std::abs(weights.mass) &&
           std::abs(weights_.rate - weights.rate) <= rounding * std::abs(weights.rate);
  }

  /// Factorises the matrix of the last evaluation with weights.
  /// @return whether it is regular
  template <class System>
  bool compute(const System& equations, const MatrixWeights& weights) {
    equations.matrix(weights, A_);
    scale_ = equilibrate(A_, equations.roles());
    if (topology_ != equations.topology()) {
      solver_.analyse(A_, equations.roles());
      topology_ = equations.topology();
    }
    weights_ = weights;
    ++count_;
    return regular_ = solver_.factorise(A_);
  }

  /// x with A x = -residual. @return whether it is finite
  bool correct(const VectorXd& residual, VectorXd& x) const {
    work_ = -scale_.cwiseProduct(residual);
    solver_.solve(work_, x);
    x = scale_.cwiseProduct(x);
    return x.allFinite();
  }

  /// The matrix, from which the factors come anew with the same bits.
  /// @param equations  that it belongs to
  template <Archive A, class System>
  void visit_state(A& archive, const System& equations) {
    bool serve = regular_ && topology_ == equations.topology();
    archive("factors/serve", serve);
    archive("factors/count", count_);
    if constexpr (A::restores) {
      regular_ = false;
      topology_ = 0;
    }
    if (!serve) return;
    archive("factors/mass_weight", weights_.mass);
    archive("factors/rate_weight", weights_.rate);
    archive("factors/scale", scale_);
    if constexpr (A::restores) A_ = equations.pattern();
    std::vector<double> entries(A_.valuePtr(), A_.valuePtr() + A_.nonZeros());
    archive("factors/entries", entries);
    if constexpr (A::restores) {
      if (static_cast<Eigen::Index>(entries.size()) != A_.nonZeros() || scale_.size() != A_.rows())
        throw RefusedCheckpoint("the matrix of the checkpoint is that of another structure",
                                "E405");
      std::copy(entries.begin(), entries.end(), A_.valuePtr());
      solver_.analyse(A_, equations.roles());
      topology_ = equations.topology();
      regular_ = solver_.factorise(A_);
    }
  }

  /// The next solution factorises anew.
  void forget() { regular_ = false; }
  /// How often the matrix was factorised.
  long count() const { return count_; }
  /// The matrix as it was factorised last, rows and columns scaled.
  const SparseMatrix& scaled_matrix() const { return A_; }

 private:
  Solver solver_;
  SparseMatrix A_;
  VectorXd scale_;
  mutable VectorXd work_;
  MatrixWeights weights_{};
  int topology_ = 0;  // of the last analysis; those of equations begin at 1
  bool regular_ = false;
  long count_ = 0;
};

}  // namespace sphmbs::mbs
