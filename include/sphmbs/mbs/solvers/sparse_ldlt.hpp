// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <sphmbs/mbs/solvers/linear_solver.hpp>

namespace sphmbs::mbs::solvers {

/// L D L^T without pivoting (Eigen), several times faster than LU where the matrix is symmetric and
/// its massive block positive definite, as it is for steps that resolve the motion. An order that
/// makes pivots nonzero replaces pivoting: a multiplier comes after all massive coordinates of its
/// condition, a massless coordinate after all its multipliers. Of an unsymmetric matrix (friction,
/// follower loads) only the lower half is used: Newton then converges more slowly, or not at all.
class SparseLDLT {
 public:
  static constexpr std::string_view name = "Eigen LDLT, multipliers last";  ///< name in reports

  ///@{ As `LinearSolver` asks.
  void analyse(const SparseMatrix& A, const std::vector<Role>& roles) {
    order(A, roles);
    const auto n = static_cast<std::size_t>(A.rows());
    struct Entry {
      int row, column, from;
    };
    std::vector<Entry> lower;
    for (int j = 0; j < A.outerSize(); ++j)
      for (int k = A.outerIndexPtr()[j]; k < A.outerIndexPtr()[j + 1]; ++k) {
        const int row = place_[at(A.innerIndexPtr()[k])], column = place_[at(j)];
        if (row >= column) lower.push_back({row, column, k});
      }
    std::sort(lower.begin(), lower.end(), [](const Entry& a, const Entry& b) {
      return a.column != b.column ? a.column < b.column : a.row < b.row;
    });
    from_.clear();
    std::vector<Eigen::Triplet<double>> entries;
    for (const Entry& e : lower) {
      from_.push_back(e.from);
      entries.emplace_back(e.row, e.column, 1.0);
    }
    permuted_.resize(static_cast<int>(n), static_cast<int>(n));
    permuted_.setFromTriplets(entries.begin(), entries.end());
    ldlt_ = std::make_unique<Factor>();
    ldlt_->analyzePattern(permuted_);
  }

  bool factorise(const SparseMatrix& A) {
    for (std::size_t k = 0; k < from_.size(); ++k) permuted_.valuePtr()[k] = A.valuePtr()[from_[k]];
    ldlt_->factorize(permuted_);
    return ldlt_->info() == Eigen::Success && ldlt_->vectorD().allFinite() &&
           ldlt_->vectorD().cwiseAbs().minCoeff() > 0;
  }

  void solve(const VectorXd& b, VectorXd& x) const {
    work_.resize(b.size());
    for (int k = 0; k < b.size(); ++k) work_[place_[at(k)]] = b[k];
    work_ = ldlt_->solve(work_);
    x.resize(b.size());
    for (int k = 0; k < b.size(); ++k) x[k] = work_[place_[at(k)]];
  }
  ///@}

 private:
  using Factor = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  // Least fill of the massive block with its conditions eliminated, then the others put in.
  void order(const SparseMatrix& A, const std::vector<Role>& roles) {
    const int n = static_cast<int>(A.rows());
    std::vector<int> massive_number(at(n), -1), massive;
    for (int k = 0; k < n; ++k)
      if (roles[at(k)] == Role::massive) {
        massive_number[at(k)] = static_cast<int>(massive.size());
        massive.push_back(k);
      }
    std::vector<Eigen::Triplet<double>> entries;
    const auto neighbours = [&](int k, Role role) {
      std::vector<int> found;
      for (SparseMatrix::InnerIterator e(A, k); e; ++e)
        if (e.row() != k && roles[at(static_cast<int>(e.row()))] == role)
          found.push_back(static_cast<int>(e.row()));
      return found;
    };
    for (int k = 0; k < n; ++k) {
      if (roles[at(k)] == Role::massless) continue;
      const std::vector<int> near = neighbours(k, Role::massive);
      if (roles[at(k)] == Role::massive)
        for (const int other : near)
          entries.emplace_back(massive_number[at(other)], massive_number[at(k)], 1.0);
      else
        for (const int a : near)
          for (const int b : near)
            entries.emplace_back(massive_number[at(a)], massive_number[at(b)], 1.0);
    }
    const int m = static_cast<int>(massive.size());
    for (int k = 0; k < m; ++k) entries.emplace_back(k, k, 1.0);
    SparseMatrix graph(m, m);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::AMDOrdering<int>::PermutationType permutation;
    Eigen::AMDOrdering<int>()(graph, permutation);

    place_.assign(at(n), -1);
    int next = 0;
    for (int k = 0; k < m; ++k) {
      const int unknown = massive[at(permutation.indices()[k])];
      place_[at(unknown)] = next++;
      for (const int multiplier : neighbours(unknown, Role::multiplier)) {
        const std::vector<int> needs = neighbours(multiplier, Role::massive);
        if (place_[at(multiplier)] < 0 && placed(needs)) place_[at(multiplier)] = next++;
      }
    }
    for (const Role role : {Role::multiplier, Role::massless})
      for (int k = 0; k < n; ++k)
        if (roles[at(k)] == role && place_[at(k)] < 0) place_[at(k)] = next++;
  }

  bool placed(const std::vector<int>& unknowns) const {
    return std::all_of(unknowns.begin(), unknowns.end(), [&](int k) { return place_[at(k)] >= 0; });
  }

  std::vector<int> place_;  // of each unknown in the order of elimination
  std::vector<int> from_;   // entry of A behind each entry of the lower half
  SparseMatrix permuted_;
  std::unique_ptr<Factor> ldlt_;
  mutable VectorXd work_;
};

static_assert(LinearSolver<SparseLDLT>);

}  // namespace sphmbs::mbs::solvers
