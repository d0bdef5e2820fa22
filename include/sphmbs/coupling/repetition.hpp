// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <deque>
#include <utility>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::coupling {

/// What the repetition x -> F(x) of coupling::Strong has shown so far.
struct Repetition {
  /// What one repetition has shown.
  struct Pair {
    mbs::VectorXd residual;  ///< F(x) - x
    mbs::VectorXd result;    ///< F(x)

    /// What a checkpoint keeps of it, see `Archive`.
    template <Archive A>
    void visit_state(A& archive) {
      archive("residual", residual);
      archive("result", result);
    }
  };

  /// A step begins; changes seen in earlier ones stay known.
  void begin() { last = {}; }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("last", last);
    archive("share", share);
    archive("changes", changes);
  }

  Pair last;                 ///< of this step; empty before its first
  double share = 1;          ///< of the last correction that was taken [-]
  std::deque<Pair> changes;  ///< from one repetition of a step to the next, newest first
};

/// How the next x of a repetition follows from F(x).
///   check()          @throws InvalidInput for numbers out of range
///   next(x, Fx, so_far)  the next x; remembers in so_far what it needs
template <class R>
concept RepetitionPolicy = requires(const R policy, const mbs::VectorXd x, Repetition so_far) {
  policy.check();
  { policy.next(x, x, so_far) } -> std::same_as<mbs::VectorXd>;
};

/// A fixed share of each correction.
struct Relaxation {
  double share = 0.5;  ///< [-]

  /// @throws InvalidInput for numbers out of range.
  void check() const { expects(share > 0 && share <= 1, "share", share, "above 0 and at most 1"); }

  /// The x to go on with after F(x) = result.
  mbs::VectorXd next(const mbs::VectorXd& x, const mbs::VectorXd& result, Repetition&) const {
    return x + share * (result - x);
  }
};

/// A share of each correction that follows from the last two (Kuettler and Wall, Comput. Mech. 43,
/// 2008).
struct Aitken {
  double first = 1;   ///< share of the first correction of a step [-]
  double most = 1.5;  ///< largest share [-]

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(first > 0 && first <= 1, "first share", first, "above 0 and at most 1");
    expects(most >= 1, "largest share", most, "at least 1");
  }

  /// The x to go on with after F(x) = result.
  mbs::VectorXd next(const mbs::VectorXd& x, const mbs::VectorXd& result,
                     Repetition& so_far) const {
    const mbs::VectorXd residual = result - x;
    if (so_far.last.residual.size() == 0) {
      so_far.share = first;
    } else {
      const mbs::VectorXd change = residual - so_far.last.residual;
      const double share = -so_far.share * so_far.last.residual.dot(change) / change.squaredNorm();
      so_far.share = std::isfinite(share) && share > 0 ? std::min(share, most) : first;
    }
    so_far.last = {residual, result};
    return x + so_far.share * residual;
  }
};

/// Newton's method with the inverse Jacobian that fits the last changes best (IQN-ILS, Degroote,
/// Bathe and Vierendeels, Comput. Struct. 87, 2009), of this step and of those before.
struct QuasiNewton {
  int most = 10;              ///< changes that are known [-]
  double independent = 1e-2;  ///< share of a change that newer ones must leave of it [-]

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(most >= 1, "number of changes", most, "at least 1");
    expects(independent > 0 && independent < 1, "independent share", independent,
            "above 0 and below 1");
  }

  /// The x to go on with after F(x) = result.
  mbs::VectorXd next(const mbs::VectorXd& x, const mbs::VectorXd& result,
                     Repetition& so_far) const {
    const mbs::VectorXd residual = result - x;
    auto& [last, share, changes] = so_far;
    if (last.residual.size() > 0) {
      changes.push_front({residual - last.residual, result - last.result});
      if (changes.size() > static_cast<std::size_t>(most)) changes.pop_back();
    }
    last = {residual, result};
    // The changes of residuals are made orthonormal, those of results follow.
    std::vector<Repetition::Pair> basis;
    mbs::VectorXd next = result;
    for (Repetition::Pair change : changes) {
      const double size = change.residual.norm();
      for (const Repetition::Pair& b : basis) {
        const double along = b.residual.dot(change.residual);
        change.residual -= along * b.residual;
        change.result -= along * b.result;
      }
      const double left = change.residual.norm();
      if (!(left > independent * size)) continue;
      change.residual /= left;
      change.result /= left;
      next -= change.residual.dot(residual) * change.result;
      basis.push_back(std::move(change));
    }
    return next;
  }
};

}  // namespace sphmbs::coupling
