// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/gas_spring.hpp"
#include "support/coupled_session.hpp"

namespace sphmbs::examples {

/// Times at which a quantity of the history crosses zero, by lines between its rows.
inline std::vector<double> zero_crossings(const History& history, const std::string& name) {
  const std::vector<double>&t = history.time(), &x = history.of(name);
  std::vector<double> times;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (x[i - 1] * x[i] < 0)
      times.push_back(t[i - 1] + (t[i] - t[i - 1]) * x[i - 1] / (x[i - 1] - x[i]));
  return times;
}

/// Period over all whole swings, drift of the energy, and the curve of the way.
template <class System>
void compare_with_exact(Session<System>& session, const GasSpring& exact) {
  const History& history = session.history();
  const std::vector<double> crossings = zero_crossings(history, "way");
  if (crossings.size() >= 3) {
    const std::size_t swings = (crossings.size() - 1) / 2;
    const double period = (crossings[2 * swings] - crossings[0]) / static_cast<double>(swings);
    session.result("period", period, exact.period(), "s");
  }
  const std::vector<double>& energy = history.of("total_energy");
  double drift = 0;
  for (const double e : energy) drift = std::max(drift, std::abs(e / energy.front() - 1));
  session.result("largest_change_of_energy", drift, std::nullopt, "-");
  report_interface(session);
  session.curves("history", session.title(),
                 {{.title = "piston",
                   .x_label = "t [s]",
                   .y_label = "way [m]",
                   .curves = {history.curve("way", "")}},
                  {.title = "gas on the piston",
                   .x_label = "t [s]",
                   .y_label = "force [N/m^2]",
                   .curves = {history.curve("force", "")}}},
                 1);
}

}  // namespace sphmbs::examples
