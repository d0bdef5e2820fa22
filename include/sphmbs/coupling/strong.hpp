// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/coupling/immersed.hpp>
#include <sphmbs/coupling/repetition.hpp>

namespace sphmbs::coupling {

/// Forces and motion agree within each step: the bodies' way and the gas's forces in its middle are
/// repeated until the forces no longer change. On its way a wetted particle has in the middle of
/// the step the velocity (r_{n+1} - r_n) / dt, so that the power that the gas gives is what the
/// bodies get, to the tolerance (of particles off their material point to second order). Of second
/// order; for bodies as light as the gas around them. A repetition costs a solution of the
/// structure and the forces on the wetted particles.
template <RepetitionPolicy Repeat = QuasiNewton, class Integrator = mbs::GeneralizedAlpha>
struct Strong {
  Integrator structure = {};  ///< integrator of the bodies
  Repeat repeat = {};         ///< how the next repetition follows from the last
  double tolerance = 1e-11;   ///< of the forces, relative [-]
  int most = 50;              ///< repetitions
  double slack = 0.03;        ///< of a smoothing length, for bodies to change their way by [-]

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    structure.check();
    repeat.check();
    expects(!structure.accuracy, "accuracy of the structure's integrator", *structure.accuracy,
            "none: the gas decides on the step");
    expects(structure.spectral_radius < 1, "spectral_radius", structure.spectral_radius,
            "below 1 where the load of a gas is to die away");
    expects(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "above 0 and below 1");
    expects(most >= 1, "repetitions", most, "at least 1");
    expects(slack > 0 && slack < 1, "slack", slack, "above 0 and below 1");
  }

  /// @throws NumericalFailure where forces and motion do not come to agree.
  template <class System, class ChooseStep>
  double step(System& system, ChooseStep&& choose_step) const {
    check();
    auto& fluid = system.fluid();
    auto& body = system.bodies();
    const mbs::State old = body.state();
    system.evaluate();
    const double dt = choose_step(), middle = system.time() + dt / 2;
    fluid.stage(dt / 2, dt / 2, slack * system.surface().smoothing_length());
    fluid.follow(dt / 2);
    system.read();
    system.repetition().begin();
    using Forces = std::vector<Vec<System::dim>>;
    Forces x = system.surface().forces();
    mbs::State guess = old;
    mbs::VectorXd last_way;
    for (int k = 0;; ++k) {
      const mbs::VectorXd Q = system.load_at(middle, x);
      auto end = system.mean_load().at_end(structure, Q, dt);
      body.equations().external_force() = end.load;
      auto next = structure.attempt(body, dt, guess);
      if (!next.course.converged)
        throw NumericalFailure("t = " + std::to_string(system.time()) +
                               " s: Newton's method fails within a strongly coupled step of " +
                               std::to_string(dt) + " s; try a smaller --cfl");
      const mbs::VectorXd way = next.state.q - old.q;
      // Of coordinates: then forces cannot agree better either.
      const double rounding =
          8 * std::numeric_limits<double>::epsilon() * std::max(1.0, old.q.cwiseAbs().maxCoeff());
      const bool rests = last_way.size() > 0 && (way - last_way).cwiseAbs().maxCoeff() <= rounding;
      last_way = way;
      system.depart(old.q, old.v, (2 / dt) * (way / dt - old.v));
      fluid.follow(dt / 2);
      system.read();
      const Forces& now = system.surface().forces();
      const double off = (flat(now) - flat(x)).norm(), size = flat(now).norm();
      if (rests || off <= tolerance * size) {
        fluid.rates(0);
        body.accept(std::move(next.state), std::move(next.algorithmic));
        system.mean_load().accept(std::move(end), dt);
        system.gas_acted(dt, middle);
        system.bodies_went(Q, way);
        system.depart(body.state().q, body.state().v, body.state().vdot);
        fluid.commit(dt, dt);
        system.stepped();
        return dt;
      }
      if (k >= most)
        throw NumericalFailure(
            "t = " + std::to_string(system.time()) + " s: forces and motion do not agree after " +
            std::to_string(most) + " repetitions, the last change of the forces being " +
            std::to_string(off / size) + " of them; try a smaller --cfl or a larger tolerance");
      flat(x) = repeat.next(flat(x), flat(now), system.repetition());
      guess = std::move(next.state);
    }
  }

 private:
  template <int Dim>
  static auto flat(std::vector<Vec<Dim>>& forces) {
    return Eigen::Map<mbs::VectorXd>(forces[0].component, numbers(forces));
  }
  template <int Dim>
  static auto flat(const std::vector<Vec<Dim>>& forces) {
    return Eigen::Map<const mbs::VectorXd>(forces[0].component, numbers(forces));
  }
  template <int Dim>
  static Eigen::Index numbers(const std::vector<Vec<Dim>>& forces) {
    static_assert(sizeof(Vec<Dim>) == Dim * sizeof(double));
    return static_cast<Eigen::Index>(forces.size()) * Dim;
  }
};

}  // namespace sphmbs::coupling
