// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/neighbours/neighbour_search.hpp>

namespace sphmbs::sph {

/// Decides when neighbour lists must be made anew and how wide a skin they get. It reckons with
/// bounds only (the speed at which any two particles can close in), so no positions are kept.
class ListSchedule {
 public:
  /// True where a stage at time + dt could miss a neighbour. At the beginning of a step the stages
  /// ahead are reckoned with too, so that one step uses one set of lists.
  bool outdated(double dt) const {
    const double way = drift_ + surplus_ + speed_ * std::max(dt, dt > 0 ? 0 : lookahead_);
    return !built_ || !(way <= reach_.skin);
  }

  /// Particles are no longer the same.
  void forget() { built_ = false; }

  /// A step is undone that began with the schedule `before`. Lists that it made may be narrower
  /// than that says.
  void undo(const ListSchedule& before) {
    *this = before;
    forget();
  }

  /// Rates were evaluated: pairs close in, and reaches grow, by `speed` together at most [m/s].
  void moving(double speed) { speed_ = speed; }

  /// A step of length dt [s] was taken, in which prescribed motion went `surplus` [m] further than
  /// its velocity at the beginning said.
  void stepped(double dt, double surplus) {
    drift_ += speed_ * dt + surplus;
    surplus_ = 0;
    step_ = dt;
    lookahead_ = stage_;
    stage_ = 0;
  }

  /// The reach for lists made now, during a stage at time + dt. A wider skin lists more pairs that
  /// are out of reach, a narrower one is used up sooner: for lists that cost `listing` evaluations
  /// of the rates and d dimensions, sqrt(listing R / (2 d s)) steps of s metres are best.
  neighbours::Reach plan(int dim, double support, double h_max, double dt) {
    constexpr double listing = 0.6;
    const double widest = 0.13 / dim;  // of the reach: bounds the memory that lists take
    const double R = support * h_max;
    const double s = speed_ * step_;
    const double needed = 1.05 * (speed_ * std::max(dt, lookahead_) + surplus_);
    double more = 0;  // steps beyond this one
    if (s > 0) {
      const double best = std::round(std::sqrt(listing * R / (2 * dim * s))) - 1;
      more = std::max(0.0, std::min(best, std::floor((widest * R - needed) / s)));
    }
    const double skin = needed + 1.05 * more * s;
    reach_ = {.support = support, .skin = skin, .h_max = h_max};
    drift_ = 0;
    built_ = true;
    return reach_;
  }

  /// A stage at time + dt is evaluated; prescribed motion goes `surplus` [m] further until then
  /// than its velocity says.
  void staged(double dt, double surplus) {
    stage_ = std::max(stage_, dt);
    surplus_ = surplus;
  }

  /// How far the present lists reach.
  const neighbours::Reach& reach() const { return reach_; }
  /// What the last stage allowed prescribed motion beyond its velocity [m].
  double surplus() const { return surplus_; }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("support", reach_.support);
    archive("skin", reach_.skin);
    archive("h_max", reach_.h_max);
    archive("built", built_);
    archive("surplus", surplus_);
    archive("drift", drift_);
    archive("speed", speed_);
    archive("step", step_);
    archive("stage", stage_);
    archive("lookahead", lookahead_);
  }

 private:
  neighbours::Reach reach_{};
  bool built_ = false;
  double surplus_ = 0;    // of prescribed motion at this stage [m]
  double drift_ = 0;      // how far pairs may have closed in since the lists were made [m]
  double speed_ = 0;      // [m/s]
  double step_ = 0;       // last step [s]
  double stage_ = 0;      // latest stage of this step [s]
  double lookahead_ = 0;  // latest stage of the last step [s]
};

}  // namespace sphmbs::sph
