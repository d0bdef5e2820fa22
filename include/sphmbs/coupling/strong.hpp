// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/coupling/immersed.hpp>

namespace sphmbs::coupling {

/// Aitken's relaxation of a repetition x -> F(x): a share of the correction that follows from the
/// last two (Kuettler and Wall, Comput. Mech. 43, 2008).
struct Aitken {
  double first = 1;  // share of the first correction of a step [-]
  double most = 1.5;

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(first > 0 && first <= 1, "first share", first, "above 0 and at most 1");
    expects(most >= 1, "largest share", most, "at least 1");
  }

  double share(double last, double change_by_residual, double change_by_change) const {
    const double share = -last * change_by_residual / change_by_change;
    return std::isfinite(share) && share > 0 ? std::min(share, most) : first;
  }
};

/// A fixed share of each correction.
struct Relaxation {
  double first = 0.5;  // [-]

  /// @throws InvalidInput for a share out of range.
  void check() const { expects(first > 0 && first <= 1, "share", first, "above 0 and at most 1"); }
  double share(double, double, double) const { return first; }
};

/// Forces and motion agree within each step: the bodies' way and the gas's forces in its middle are
/// repeated until the forces no longer change. On its way a wetted particle has in the middle of
/// the step the velocity (r_{n+1} - r_n) / dt, so that the power that the gas gives is what the
/// bodies get, to the tolerance (of particles off their material point to second order). Of second
/// order; for bodies as light as the gas around them. A repetition costs a solution of the
/// structure and the forces on the wetted particles.
template <class Relax = Aitken, class Integrator = mbs::GeneralizedAlpha>
struct Strong {
  Integrator structure = {};
  Relax relax = {};
  double tolerance = 1e-11;  // of the forces, relative [-]
  int most = 50;             // repetitions
  double slack = 0.03;       // of a smoothing length, for bodies to change their way by [-]

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    structure.check();
    relax.check();
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
    using Forces = std::vector<Vec<System::dim>>;
    Forces x = system.surface().forces(), last;
    double share = relax.first;
    mbs::VectorXd last_way;
    for (int k = 0;; ++k) {
      const mbs::VectorXd Q = system.load_at(middle, x);
      auto end = system.mean_load().at_end(structure, Q, dt);
      body.equations().external_force() = end.load;
      auto next = structure.attempt(body, dt);
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
      double norm = 0, size = 0, by_residual = 0, by_change = 0;
      Forces residual(now.size());
      for (std::size_t i = 0; i < now.size(); ++i) {
        residual[i] = now[i] - x[i];
        norm += norm2(residual[i]);
        size += norm2(now[i]);
        if (last.empty()) continue;
        const Vec<System::dim> change = residual[i] - last[i];
        by_residual += dot(last[i], change);
        by_change += norm2(change);
      }
      if (rests || norm <= tolerance * tolerance * size) {
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
            std::to_string(std::sqrt(norm / size)) +
            " of them; try a smaller --cfl, a smaller first share or a larger tolerance");
      if (!last.empty()) share = relax.share(share, by_residual, by_change);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * residual[i];
      last = std::move(residual);
    }
  }
};

}  // namespace sphmbs::coupling
