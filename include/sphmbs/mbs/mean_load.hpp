// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/mbs/generalized_alpha.hpp>

namespace sphmbs::mbs {

/// A load that is known by its mean over a step, such as one that an explicit scheme evaluates in
/// the middle, as generalized-alpha needs it: at the end of the step, so that the structure
/// receives the mean times the step as momentum, to rounding. With b the load as the method's
/// filter passes it on,
///
///   (1 - gamma) b_n + gamma b_{n+1} = mean
///   (1 - alpha_m) b_{n+1} + alpha_m b_n = (1 - alpha_f) Q_{n+1} + alpha_f Q_n
///
/// Departures from this die away, for spectral radii above 1/6 as spectral_radius^n, which is
/// therefore to be below 1. A step
/// that Newton's method has to halve receives it to second order only.
class MeanLoad {
 public:
  /// The load at the end of a step, from its mean.
  struct End {
    VectorXd filtered;  ///< b_{n+1}
    VectorXd load;      ///< Q_{n+1}
  };

  MeanLoad() = default;
  /// @param start  the load at the beginning, when accelerations belong to it
  explicit MeanLoad(const VectorXd& start) : last_{start, start} {}

  /// The load at the end of a step of length h [s] that makes the integrator's mean `mean`.
  End at_end(const GeneralizedAlpha& integrator, const VectorXd& mean, double h) const {
    const auto [alpha_m, alpha_f, gamma, beta] = integrator.coefficients();
    const VectorXd b = last_.load + filter_stretch(h, last_h_) * (last_.filtered - last_.load);
    End end;
    end.filtered = (mean - (1 - gamma) * b) / gamma;
    end.load = ((1 - alpha_m) * end.filtered + alpha_m * b - alpha_f * last_.load) / (1 - alpha_f);
    return end;
  }

  /// The step of length h [s] was taken under that load.
  void accept(End end, double h) {
    last_ = std::move(end);
    last_h_ = h;
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("filtered", last_.filtered);
    archive("load", last_.load);
    archive("step", last_h_);
  }

 private:
  End last_;
  double last_h_ = 0;
};

}  // namespace sphmbs::mbs
