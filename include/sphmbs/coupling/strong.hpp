// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
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

  /// Where `repeat` does not come to an end, small shares of corrections are tried as well.
  /// @throws NumericalFailure where forces and motion do not come to agree; the step can be undone.
  template <class System, class ChooseStep>
  double step(System& system, ChooseStep&& choose_step) const {
    check();
    auto& fluid = system.fluid();
    system.begin();
    system.evaluate();
    const double dt = choose_step();
    fluid.stage(dt / 2, dt / 2, slack * system.surface().smoothing_length());
    fluid.follow(dt / 2);
    system.read();
    const auto start = system.surface().forces();
    std::vector<double> course;  // of the change of forces
    if (agree(system, dt, start, repeat, course)) return dt;
    system.repetition() = {};
    if (agree(system, dt, start, Relaxation{.share = careful}, course)) return dt;
    std::ostringstream text;
    text << "t = " << system.time() << " s: forces and motion do not agree after " << most
         << " repetitions, and after as many with a share of " << careful << ", in a step of " << dt
         << " s; the change of the forces, as a share of them, was";
    constexpr std::size_t shown = 8;
    for (std::size_t k = course.size() < shown ? 0 : course.size() - shown; k < course.size(); ++k)
      text << " " << course[k];
    text << "\n  likely: a body much lighter than the gas around it, or a tolerance below rounding"
            "\n  try: a smaller --cfl, a larger tolerance, or more repetitions";
    throw NumericalFailure(text.str(), "E340");
  }

 private:
  static constexpr double careful = 0.2;

  // Repeats until forces and motion agree, and then takes the step.
  template <class System, class Rule, class Forces>
  bool agree(System& system, double dt, Forces x, const Rule& rule,
             std::vector<double>& course) const {
    auto& fluid = system.fluid();
    auto& body = system.bodies();
    const mbs::State old = body.state();
    const double middle = system.time() + dt / 2;
    system.repetition().begin();
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
                                   std::to_string(dt) + " s; try a smaller --cfl\n" +
                                   next.course.table(),
                               "E341");
      const mbs::VectorXd way = next.state.q - old.q;
      // Of coordinates: then forces cannot agree better either.
      const double rounding =
          8 * std::numeric_limits<double>::epsilon() * std::max(1.0, old.q.cwiseAbs().maxCoeff());
      const bool rests = last_way.size() > 0 && (way - last_way).cwiseAbs().maxCoeff() <= rounding;
      last_way = way;
      system.depart(old.q, old.v, (2 / dt) * (way / dt - old.v));
      try {
        fluid.follow(dt / 2);
      } catch (const NumericalFailure&) {  // a repetition that diverges takes bodies too far
        course.push_back(std::numeric_limits<double>::infinity());
        return false;
      }
      system.read();
      const Forces& now = system.surface().forces();
      const double off = (flat(now) - flat(x)).norm(), size = flat(now).norm();
      if (rests || off <= tolerance * size) {
        fluid.rates(0);
        fluid.admit(dt, dt);
        body.accept(std::move(next.state), std::move(next.algorithmic));
        system.mean_load().accept(std::move(end), dt);
        system.gas_acted(dt, middle);
        system.bodies_went(Q, way);
        system.depart(body.state().q, body.state().v, body.state().vdot);
        fluid.commit(dt, dt);
        system.stepped();
        return true;
      }
      course.push_back(off / size);
      if (k >= most || !std::isfinite(off)) return false;
      flat(x) = rule.next(flat(x), flat(now), system.repetition());
      guess = std::move(next.state);
    }
  }

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
