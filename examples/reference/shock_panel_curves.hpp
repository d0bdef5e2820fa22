// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/shock_panel.hpp"
#include "support/coupled_session.hpp"

namespace sphmbs::examples {

/// Mean of a quantity over [from, to] by the trapezoidal rule, or nothing where the run has not
/// come that far.
inline std::optional<double> mean_over(const History& history, const std::string& name, double from,
                                       double to) {
  const std::vector<double>&t = history.time(), &x = history.of(name);
  if (t.back() < to - 1e-9) return std::nullopt;
  double sum = 0, span = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i - 1] < from - 1e-9 || t[i] > to + 1e-9) continue;
    sum += 0.5 * (x[i] + x[i - 1]) * (t[i] - t[i - 1]);
    span += t[i] - t[i - 1];
  }
  return sum / span;
}

/// A turning point of a quantity within [from, to]: time and value, of the parabola through the
/// sample that is highest (`sign` 1) or lowest (-1) and those beside it. Nothing where that is at
/// an end of the time or of the run.
inline std::optional<std::pair<double, double>> turning_point(const History& history,
                                                              const std::string& name, double from,
                                                              double to, double sign) {
  const std::vector<double>&t = history.time(), &x = history.of(name);
  std::size_t best = t.size();
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] >= from && t[i] <= to && (best == t.size() || sign * x[i] > sign * x[best])) best = i;
  if (best == 0 || best + 1 >= t.size() || t[best - 1] < from || t[best + 1] > to)
    return std::nullopt;
  const double left = x[best - 1] - x[best], right = x[best + 1] - x[best];
  const double bend = left + right, slope = (right - left) / 2;
  if (bend == 0) return std::nullopt;
  return std::pair(t[best] - slope / bend * (t[best + 1] - t[best]),
                   x[best] - slope * slope / (2 * bend));
}

/// Mean force, beside a value of the independent solution, its impulse, and mean pressures; the
/// last two beside those of its cells of 0.5 mm.
template <class System>
void report_force(Session<System>& session, std::optional<double> mean,
                  std::optional<double> impulse_1ms) {
  const History& history = session.history();
  if (const auto force = mean_over(history, "force_x", 0.3e-3, 1.3e-3))
    session.result("mean_force_0.3_to_1.3ms", *force, mean, "N/m");
  if (const auto force = mean_over(history, "force_x", 0, 1e-3))
    session.result("impulse_to_1ms", *force * 1e-3, impulse_1ms, "N s/m");
  for (const auto& [name, value] :
       {std::pair("p_front", 187.52e3), std::pair("p_behind", 119.95e3),
        std::pair("p_floor_front", 188.39e3), std::pair("p_floor_behind", 122.79e3),
        std::pair("p_top", 164.69e3)})
    if (const auto p = mean_over(history, name, 0.3e-3, 1.4e-3))
      session.result(std::string("mean_") + name, *p,
                     mean && session.history().has("tip_x") ? std::optional(value) : std::nullopt,
                     "Pa");
}

/// A panel of one quantity beside the reference.
template <class System>
Panel beside(Session<System>& session, const std::string& name, const std::string& title,
             const std::string& unit, std::optional<double PanelReference::*> member) {
  Panel panel{.title = title, .x_label = "t [s]", .y_label = unit};
  panel.curves.push_back(session.history().curve(name, "sphmbs"));
  if (member)
    panel.curves.push_back(
        reference_curve(panel_reference, *member).curve("reference", session.settings().until));
  return panel;
}

/// Results and pictures of a rigid panel.
/// @param known  whether the reference has this set-up
template <class System>
void compare_rigid(Session<System>& session, bool known) {
  using Member = std::optional<double PanelReference::*>;
  const auto of = [known](double PanelReference::*m) { return known ? Member(m) : Member(); };
  report_force(session, known ? std::optional(3416.0) : std::nullopt,
               known ? std::optional(3.353) : std::nullopt);
  session.curves(
      "history", session.title(),
      {beside(session, "force_x", "force on the panel", "[N/m]", of(&PanelReference::rigid_force)),
       beside(session, "p_front", "pressure at (-0.04, 0.02) m", "[Pa]",
              of(&PanelReference::rigid_p_front)),
       beside(session, "p_behind", "pressure at (0.04, 0.02) m", "[Pa]",
              of(&PanelReference::rigid_p_behind))},
      1);
}

/// Results and pictures of a flexible panel.
/// @param known  whether the reference has this set-up
template <class System>
void compare_flexible(Session<System>& session, bool known) {
  struct Turn {
    const char* name;
    double from, to, sign, time, tip;  // time and tip as the grid limit has them
  };
  for (const Turn& turn : {Turn{"first_maximum", 0.5e-3, 2.2e-3, 1, 1.457e-3, 5.465e-3},
                           Turn{"first_minimum", 2.2e-3, 3.6e-3, -1, 2.992e-3, -4.76e-3},
                           Turn{"second_maximum", 3.6e-3, 4.95e-3, 1, 4.292e-3, 4.66e-3}}) {
    const auto found = turning_point(session.history(), "tip_x", turn.from, turn.to, turn.sign);
    if (!found) continue;
    const std::string name = turn.name;
    session.result(name, found->second, known ? std::optional(turn.tip) : std::nullopt, "m");
    session.result("time_of_" + name, found->first, known ? std::optional(turn.time) : std::nullopt,
                   "s");
  }
  report_force(session, known ? std::optional(3180.0) : std::nullopt,
               known ? std::optional(3.211) : std::nullopt);
  report_interface(session);
  using Member = std::optional<double PanelReference::*>;
  const auto of = [known](double PanelReference::*m) { return known ? Member(m) : Member(); };
  session.curves(
      "history", session.title(),
      {beside(session, "tip_x", "displacement of the tip", "[m]", of(&PanelReference::tip)),
       beside(session, "force_x", "force on the panel", "[N/m]", of(&PanelReference::force)),
       beside(session, "p_front", "pressure at (-0.04, 0.02) m", "[Pa]",
              of(&PanelReference::p_front)),
       beside(session, "p_behind", "pressure at (0.04, 0.02) m", "[Pa]",
              of(&PanelReference::p_behind))},
      2);
}

}  // namespace sphmbs::examples
