// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/coupling/repetition.hpp>
#include <sphmbs/coupling/watch.hpp>
#include <sphmbs/coupling/wetted_surface.hpp>
#include <sphmbs/mbs/mean_load.hpp>
#include <sphmbs/sph/survey.hpp>

namespace sphmbs::coupling {

/// What has passed from the gas to the bodies since time 0.
template <int Dim>
struct Exchanged {
  Vec<Dim> impulse = {};      ///< on the wetted particles [kg m/s]
  double work_of_gas = 0;     ///< of the gas's forces at the velocities that it met [J]
  double work_on_bodies = 0;  ///< of the same as a generalized force on the way of the bodies [J]

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("impulse", impulse);
    archive("work_of_gas", work_of_gas);
    archive("work_on_bodies", work_on_bodies);
  }
};

/// A gas and the bodies in it, in both directions: coupling::Staggered and coupling::Strong move
/// it, observers read its parts. Keeps references to all three.
///
///   coupling::Immersed system(fluid, dynamics, surface);
///   run(system, coupling::Staggered{}, {.until = 1}, no_report);
template <class Fluid, class Bodies, class Surface>
class Immersed {
 public:
  static constexpr int dim = Fluid::dim;  ///< dimension of space

  /// The bodies start with the accelerations that they have under the gas's forces.
  /// @throws InvalidInput where gas and bodies are at different times, for a surface whose lever
  ///         does not fit the walls, for bodies under another external force, and for bodies that
  ///         overlap or have gas in them; as the first evaluation of the gas does.
  Immersed(Fluid& fluid, Bodies& bodies, Surface& surface)
      : fluid_(fluid), bodies_(bodies), surface_(surface) {
    using Wall = typename Fluid::SchemeType::Wall;
    expects(surface.lever() == (Wall::surfaces && !Wall::slips), "lever of the wetted surface",
            surface.lever(), "true where gas sticks to walls, else false");
    expects(bodies.equations().external_force().isZero(), "external force of the bodies", "given",
            "none: the gas's takes its place");
    expects(fluid.time() == bodies.time(), "time of the bodies", bodies.time(),
            "that of the gas [s]");
    evaluate();
    const mbs::VectorXd load = load_at(time());
    bodies_.start_under(load);
    mean_load_ = mbs::MeanLoad(load);
    watch_.begin(fluid, surface);
    remember();
  }

  double time() const { return fluid_.time(); }  ///< [s]
  /// The gas.
  Fluid& fluid() { return fluid_; }
  Bodies& bodies() { return bodies_; }  ///< mbs::Dynamics
  /// What of the bodies the gas touches.
  Surface& surface() { return surface_; }
  /// Of the bodies: coordinates and rates, the structure, multipliers as mbs::Dynamics gives them.
  const mbs::State& state() const { return bodies_.state(); }
  /// The bodies.
  const auto& structure() const { return bodies_.structure(); }
  /// As Dynamics::multipliers.
  template <class T>
  mbs::VectorXd multipliers(int number) {
    return bodies_.template multipliers<T>(number);
  }
  /// What was learnt of the gas at the last evaluation of its rates.
  const sph::Survey<dim>& survey() const { return fluid_.survey(); }
  /// What has passed between gas and bodies since the start.
  const Exchanged<dim>& exchanged() const { return exchanged_; }
  /// Gaps between bodies that became narrow, and bodies that went through periodic sides.
  const std::vector<Incident>& incidents() const { return watch_.incidents(); }

  /// Gas and virtual particles at this time, and the rates and forces that belong to it.
  void evaluate() {
    const mbs::State& s = bodies_.state();
    depart(s.q, s.v, s.vdot);
    fluid_.stage(0, 0);
    fluid_.rates(0);
    read();
  }

  /// Between steps, of gas and bodies too.
  template <Archive A>
  void visit_state(A& archive) {
    archive("fluid", fluid_);
    archive("bodies", bodies_);
    archive("mean_load", mean_load_);
    archive("repetition", repetition_);
    archive("exchanged", exchanged_);
    archive("watch", watch_);
    if constexpr (A::restores) {
      depart(state().q, state().v, state().vdot);
      remember();
    }
  }

  /// Back to the beginning of the step, as long as the gas has not been moved; before the first
  /// step, to the start or to the checkpoint that was restored.
  void undo() {
    fluid_.undo();
    bodies_.recall(before_.bodies);
    mean_load_ = before_.mean_load;
    exchanged_ = before_.exchanged;
    repetition_ = {};
  }

  /// @name For coupling schemes
  /// @{
  /// A step begins, which can be undone.
  /// @throws NumericalFailure for a state of the bodies that is not finite.
  void begin() {
    bodies_.require_finite();
    remember();
  }
  /// Sends the wetted particles on their way from such coordinates, rates and accelerations.
  /// Virtual particles are to follow bodies that start from q with v and a.
  void depart(const mbs::VectorXd& q, const mbs::VectorXd& v, const mbs::VectorXd& a) {
    surface_.depart(bodies_.state().t, q, v, a);
    fluid_.motion() = surface_.motion();
  }
  /// Reads the forces of the gas on the virtual particles.
  void read() { surface_.read(fluid_); }
  /// Generalized force of the forces that were read, or of others, where particles are at a time.
  /// Generalized load at time t [s] of forces on the virtual particles [N].
  mbs::VectorXd load_at(double t) const { return load_at(t, surface_.forces()); }
  /// Generalized load at time t [s] of forces on the virtual particles [N].
  mbs::VectorXd load_at(double t, const std::vector<Vec<dim>>& forces) const {
    return surface_.load(forces, t, static_cast<int>(bodies_.state().q.size()));
  }
  /// The load of the gas over a step.
  mbs::MeanLoad& mean_load() { return mean_load_; }
  /// What the repetitions of steps have shown so far.
  Repetition& repetition() { return repetition_; }

  /// The forces that were read have acted for dt, in the middle of which, at time t, they were
  /// read.
  void gas_acted(double dt, double t) {
    for (const Vec<dim>& f : surface_.forces()) exchanged_.impulse += dt * f;
    exchanged_.work_of_gas += dt * surface_.power(t);
  }
  /// The bodies went by `way` under a mean generalized force.
  void bodies_went(const mbs::VectorXd& mean, const mbs::VectorXd& way) {
    exchanged_.work_on_bodies += mean.dot(way);
  }
  /// Gas and bodies are at the end of a step.
  /// @throws BeyondModel for a body that touches a wall or another body.
  void stepped() { watch_.look(fluid_, surface_); }
  /// @}

 private:
  void remember() { before_ = {bodies_.memory(), mean_load_, exchanged_}; }

  Fluid& fluid_;
  Bodies& bodies_;
  Surface& surface_;
  mbs::MeanLoad mean_load_;
  Repetition repetition_;
  Exchanged<dim> exchanged_;
  Watch<dim> watch_;
  struct Before {
    typename Bodies::Memory bodies;
    mbs::MeanLoad mean_load;
    Exchanged<dim> exchanged;
  };
  Before before_;  // this step
};

}  // namespace sphmbs::coupling
