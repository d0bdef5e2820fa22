// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/accelerated_cylinder.hpp"
#include "support/coupled_session.hpp"

namespace sphmbs::examples {

/// The exact values of f at the history's times, as a curve.
template <class Function>
Curve exact_curve(const History& history, const Function& f) {
  Curve curve;
  curve.label = "linear acoustics";
  curve.reference = true;
  for (const double t : history.time()) {
    curve.x.push_back(t);
    curve.y.push_back(f(t));
  }
  return curve;
}

/// Results and pictures of accelerated_cylinder against linear acoustics.
/// @param falls  under a constant acceleration, instead of after an impulse
template <class System>
void compare_with_acoustics(Session<System>& session, bool falls, double mass_ratio) {
  const History& history = session.history();
  const ImpulsiveStart start(mass_ratio);
  const auto exact = [&](double t) { return falls ? step_response(t) : start.speed(t); };
  const std::string name = falls ? "force" : "speed";
  double largest = 0;
  for (std::size_t i = 0; i < history.time().size(); ++i) {
    const double t = history.time()[i];
    if (t >= 0.5) largest = std::max(largest, std::abs(history.of(name)[i] - exact(t)));
  }
  const double end = history.time().back();
  if (falls) {
    for (const double t : {1.05, 3.15, 5.0})
      if (t <= end)
        session.result("force_at_" + format_exact(t), history.at(name, t), exact(t), "-");
  } else {
    session.result("last_speed", history.of(name).back(), exact(end), "-");
    session.result("speed_in_the_long_run", history.of(name).back(), mass_ratio / (1 + mass_ratio),
                   "-");
  }
  session.result("largest_difference_from_0.5", largest, std::nullopt, "-");
  report_interface(session);
  session.curves("history", session.title(),
                 {{.title = falls ? "force by that of the displaced mass" : "speed by the first",
                   .x_label = "t c / R [-]",
                   .y_label = "[-]",
                   .curves = {history.curve(name, "sphmbs"), exact_curve(history, exact)}}},
                 1);
}

}  // namespace sphmbs::examples
