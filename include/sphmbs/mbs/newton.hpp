// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/factors.hpp>

namespace sphmbs::mbs {

/// When Newton's method computes and factorises its matrix anew.
enum class Refactor {
  every_iteration,  ///< full Newton
  every_step,       ///< once, at the first iteration of a step
  when_slow         ///< when convergence with the old factors, of any earlier step, is slow
};

/// Newton's method for the equations of one step.
struct Newton {
  /// Bound on the estimated error of a coordinate, over the structure's size [-].
  double tolerance = 1e-10;
  /// Bound on that of an acceleration, over the largest or gravity.
  double acceleration_tolerance = 1e-6;
  int max_iterations = 20;                  ///< after which the method has failed
  Refactor refactor = Refactor::when_slow;  ///< when the matrix is factorised
  double slow_rate = 0.25;  ///< ratio of successive corrections that asks for new factors [-]
  int max_halvings = 10;    ///< of the step, where Newton's method fails

  /// @throws InvalidInput for numbers out of range.
  void check() const {
    expects(tolerance > 0 && tolerance < 1e-3, "newton.tolerance", tolerance,
            "above 0 and below 1e-3");
    expects(acceleration_tolerance > 0 && acceleration_tolerance <= 1,
            "newton.acceleration_tolerance", acceleration_tolerance, "above 0 and at most 1");
    expects(max_iterations >= 1, "newton.max_iterations", max_iterations, "at least 1");
    expects(slow_rate > 0 && slow_rate < 1, "newton.slow_rate", slow_rate, "between 0 and 1");
    expects(max_halvings >= 0, "newton.max_halvings", max_halvings, "at least 0");
  }
};

/// What one iteration did.
struct NewtonIteration {
  double correction = 0;    ///< largest |dq| over the structure's size
  double residual = 0;      ///< largest |r| or |Phi|
  int worst = 0;            ///< unknown with the largest residual
  bool refactored = false;  ///< whether the matrix was factorised in it
};

/// Course of Newton's method in one step, for messages and statistics.
struct NewtonCourse {
  std::vector<NewtonIteration> iterations;  ///< in order
  bool converged = false;                   ///< whether corrections fell below the tolerance
  bool singular = false;                    ///< whether the matrix was
  std::string failure = {};  ///< what a component complained of, if that is why it ended

  /// Ratio of the last two corrections; 1 where there are not two.
  double rate() const {
    const std::size_t n = iterations.size();
    return n < 2 ? 1 : iterations[n - 1].correction / iterations[n - 2].correction;
  }

  /// The iterations as a table of text.
  std::string table() const {
    std::ostringstream text;
    text << "  iteration  largest correction  largest residual  new factors\n" << std::scientific;
    for (std::size_t k = 0; k < iterations.size(); ++k)
      text << std::setw(11) << k << std::setw(20) << std::setprecision(3)
           << iterations[k].correction << std::setw(18) << iterations[k].residual
           << (iterations[k].refactored ? "  yes\n" : "  no\n");
    return text.str();
  }
};

/// Number of the first entry that is not finite.
inline int first_not_finite(const VectorXd& x) {
  int k = 0;
  while (k + 1 < x.size() && std::isfinite(x[k])) ++k;
  return k;
}

/// Solves r = 0, Phi = 0 from the state given, where dv = w.rate dq and dvdot = w.mass dq. Joints
/// are relocated in every iteration. The error left is estimated from the rate of convergence.
/// @param size  of the structure, that tolerances refer to [m]
/// @return the course; where it has not converged, the state is not to be used
template <class System, class Factors>
NewtonCourse newton_solve(System& equations, Factors& factors, State& state, const MatrixWeights& w,
                          const Newton& options, double size) {
  NewtonCourse course;
  const int n = equations.coordinates();
  bool anew = options.refactor != Refactor::when_slow;
  VectorXd residual, x;
  const double furthest = std::max(size, state.q.cwiseAbs().maxCoeff()) / size;
  const double far = 10 * furthest;  // leads nowhere
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * furthest;
  double largest = 0;
  for (int k = 0; k < options.max_iterations; ++k) {
    equations.relocate(state.q);
    const bool refactor = anew || !factors.serve(equations.topology(), w);
    try {
      equations.evaluate(state, refactor ? &w : nullptr);
    } catch (const NumericalFailure& e) {
      course.failure = e.what();
      break;
    }
    equations.residual(state.vdot, residual);
    NewtonIteration now{.refactored = refactor};
    now.residual = residual.cwiseAbs().maxCoeff(&now.worst);
    if (refactor && !factors.compute(equations, w)) course.singular = true;
    if (!residual.allFinite()) {
      now.worst = first_not_finite(residual);
      course.failure = "the residual of " + equations.name_of(now.worst) + " is not a number";
    }
    if (course.singular || !course.failure.empty() || !factors.correct(residual, x)) {
      course.iterations.push_back(now);
      break;
    }
    state.q += x.head(n);
    state.v += w.rate * x.head(n);
    state.vdot += w.mass * x.head(n);
    state.lambda += x.tail(equations.conditions());
    now.correction = x.head(n).cwiseAbs().maxCoeff() / size;
    course.iterations.push_back(now);

    const double rate = course.rate();
    const double error = now.correction * (k == 0 ? 1.0 : rate / std::max(1 - rate, 1e-3));
    const double largest_vdot = std::max(state.vdot.cwiseAbs().maxCoeff(), equations.weight());
    const double allowed = options.acceleration_tolerance * largest_vdot;
    if (now.correction <= rounding ||
        (error <= options.tolerance && w.mass * error * size <= allowed)) {
      course.converged = true;
      break;
    }
    // Corrections of stiff and soft directions take turns: growth alone is no sign of failure.
    largest = std::max(largest, now.correction);
    if (now.correction > far || (k > 2 && refactor && now.correction >= largest)) break;
    anew = options.refactor == Refactor::every_iteration ||
           (options.refactor == Refactor::when_slow && k > 0 && rate > options.slow_rate) ||
           (options.refactor == Refactor::every_step && k > 0 && rate > 0.9);
  }
  return course;
}

}  // namespace sphmbs::mbs
