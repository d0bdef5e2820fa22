// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/coupling/immersed.hpp>

namespace sphmbs::coupling {

/// The paper's coupling, sect. 4.3: gas and structure in turn, once a step. The gas goes by the
/// predictor-corrector of eqs. (27)-(29), with the bodies on the way that they had at the beginning
/// of the step; its forces in the middle move the structure to the end, where the wetted particles
/// follow. Of second order in time; momentum passes to rounding. The power that the gas gives
/// differs from what the bodies get by the error of that way, and a body much lighter than the gas
/// within a smoothing length of it is unstable: then take coupling::Strong.
template <class Integrator = mbs::GeneralizedAlpha>
struct Staggered {
  Integrator structure = {};  ///< integrator of the bodies
  bool accelerated = true;    ///< the way bends by the last acceleration; the paper's is straight
  int gas_steps = 1;        ///< of the gas in one of the structure, over which forces are averaged
  int structure_steps = 1;  ///< of the structure in one of the gas, under the same force

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    structure.check();
    expects(!structure.accuracy, "accuracy of the structure's integrator", *structure.accuracy,
            "none: the gas decides on the step");
    expects(structure.spectral_radius < 1, "spectral_radius", structure.spectral_radius,
            "below 1 where the load of a gas is to die away");
    expects(gas_steps >= 1, "gas_steps", gas_steps, "at least 1");
    expects(structure_steps >= 1, "structure_steps", structure_steps, "at least 1");
  }

  /// One step of the structure; the gas does as many as there are in it. Where one of the gas's
  /// fails, the step ends with the one before it.
  /// @throws NumericalFailure from gas or structure; the step can then be undone, unless the gas
  ///         has done several and the structure fails.
  template <class System, class ChooseStep>
  double step(System& system, ChooseStep&& choose_step) const {
    check();
    auto& fluid = system.fluid();
    system.begin();
    const double start = system.time();
    const mbs::State& old = system.bodies().state();
    const mbs::VectorXd q = old.q;
    mbs::VectorXd Q = mbs::VectorXd::Zero(q.size());
    system.depart(q, old.v, accelerated ? old.vdot : mbs::VectorXd::Zero(q.size()));
    double dt = 0;
    int done = 0;
    for (int k = 0; k < gas_steps && done == k; ++k) {
      const auto gas_step = [&] {
        fluid.stage(0, 0);
        fluid.rates(0);
        if (k == 0) {
          system.read();
          dt = choose_step() / gas_steps;
        }
        const double middle = start + (k + 0.5) * dt;
        fluid.stage(dt / 2, dt / 2);
        fluid.rates(0);
        fluid.admit(dt, dt);
        system.read();
        Q += system.load_at(middle) / gas_steps;
        system.gas_acted(dt, middle);
        if (k + 1 < gas_steps) fluid.commit(dt, dt);
        ++done;
      };
      try {
        gas_step();
      } catch (const BeyondModel&) {
        throw;
      } catch (const NumericalFailure&) {
        if (k == 0) throw;
        fluid.undo();
      }
    }
    Q *= static_cast<double>(gas_steps) / done;
    move(system, Q, done * dt);
    const mbs::State& now = system.bodies().state();
    system.bodies_went(Q, now.q - q);
    system.depart(now.q, now.v, now.vdot);
    if (done == gas_steps) fluid.commit(dt, dt);
    system.stepped();
    return done * dt;
  }

 private:
  template <class System>
  void move(System& system, const mbs::VectorXd& mean, double dt) const {
    const double h = dt / structure_steps;
    for (int k = 0; k < structure_steps; ++k) {
      auto end = system.mean_load().at_end(structure, mean, h);
      system.bodies().equations().external_force() = end.load;
      structure.step(system.bodies(), [&] { return h; });
      system.mean_load().accept(std::move(end), h);
    }
  }
};

}  // namespace sphmbs::coupling
