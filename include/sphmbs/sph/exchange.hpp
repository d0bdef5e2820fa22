// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/archive.hpp>
#include <sphmbs/sph/survey.hpp>

namespace sphmbs::sph {

/// What the gas has received from outside since time 0, summed with the weights of the integrator,
/// so that it balances the gas's own sums to the integrator's accuracy.
template <int Dim>
class Exchange {
 public:
  /// From virtual particles, particles of openings and the body force [kg m/s]. With what passes
  /// openings it equals the change of the gas's momentum to rounding.
  const Vec<Dim>& impulse() const { return impulse_; }
  /// Work of moving virtual particles and of particles of openings on the gas, -int sum f.v dt with
  /// f the force of the gas on them [J].
  double wall_work() const { return wall_work_; }
  /// Work of whatever drives the virtual particles: on the gas, and against the other virtual
  /// particles. With the body force's it equals the change of the energy of gas and virtual
  /// particles (plus the background pressure times the gas's volume), to the integrator's accuracy.
  /// For wall models with surfaces it is what passes to the gas at the surface: as the work of the
  /// virtual particles, but without the share that goes into their own stretching, and with the
  /// heat of isothermal walls [J].
  double driving_work() const { return wall_work_ + layer_work_; }
  /// Work of the body force [J].
  double body_work() const { return body_work_; }

  /// Rates were evaluated with the weight `keep` for the earlier ones.
  void evaluated(const Survey<Dim>& survey, double gas_mass, const Vec<Dim>& g, double keep) {
    force_ = keep * force_ + gas_mass * g - survey.wall_force;
    wall_power_ = keep * wall_power_ - survey.wall_power;
    layer_power_ = keep * layer_power_ - survey.layer_power;
    body_power_ = keep * body_power_ + dot(g, survey.momentum);
  }

  /// A step was committed.
  void committed(double scale) {
    impulse_ += scale * force_;
    wall_work_ += scale * wall_power_;
    layer_work_ += scale * layer_power_;
    body_work_ += scale * body_power_;
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("impulse", impulse_);
    archive("wall_work", wall_work_);
    archive("layer_work", layer_work_);
    archive("body_work", body_work_);
  }

 private:
  Vec<Dim> impulse_ = {};
  double wall_work_ = 0;
  double layer_work_ = 0;
  double body_work_ = 0;
  Vec<Dim> force_ = {};
  double wall_power_ = 0;
  double layer_power_ = 0;
  double body_power_ = 0;
};

}  // namespace sphmbs::sph
