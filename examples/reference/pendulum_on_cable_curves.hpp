// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/pendulum_on_cable.hpp"
#include "support/coupled_session.hpp"
#include "support/structure_pictures.hpp"

namespace sphmbs::examples {

/// The independent solution with a measure of strain.
inline std::span<const PendulumReference> pendulum_reference(const std::string& measure) {
  if (measure == "green") return pendulum_green;
  return pendulum_engineering;
}

/// A and C beside the independent solution without air.
struct PendulumPanels {
  Panel path{.title = "paths of A and C", .x_label = "x [m]", .y_label = "y [m]"};
  Panel place{.title = "places of A and C", .x_label = "t [s]", .y_label = "[m]"};
  Panel difference{.title = "difference from the reference", .x_label = "t [s]", .y_label = "[m]"};
};

/// Draws the panels and calls report(name, t, value, reference) for each coordinate at 0.5 s and 1
/// s.
/// @param label  of the independent solution
template <class System, class Report>
PendulumPanels beside_reference(Session<System>& session, const std::string& measure,
                                const std::string& label, const Report& report) {
  const std::span<const PendulumReference> rows = pendulum_reference(measure);
  const double until = session.settings().until;
  const History& traces = session.traces();
  PendulumPanels panels;
  const auto compare = [&](const std::string& name, double PendulumReference::*member) {
    const ReferenceCurve reference = reference_curve(rows, member);
    Curve dots = reference.curve(panels.place.curves.empty() ? label : "", until);
    panels.place.curves.push_back(traces.curve(name, name));
    panels.place.curves.push_back(dots);
    panels.difference.curves.push_back(reference.difference(traces, name, name));
    for (const double t : {0.5, 1.0})
      if (t < until + 1e-9) report(name, t, traces.at(name, t), reference.at(t));
    return dots;
  };
  for (const auto& [name, x, y] :
       {std::tuple("A", &PendulumReference::A_x, &PendulumReference::A_y),
        std::tuple("C", &PendulumReference::C_x, &PendulumReference::C_y)}) {
    const std::string point = name;
    Curve dots = compare(point + "_x", x);
    dots.x = dots.y;
    dots.y = compare(point + "_y", y).y;
    dots.label = panels.path.curves.empty() ? label : "";
    panels.path.curves.push_back(
        {.label = point, .x = traces.of(point + "_x"), .y = traces.of(point + "_y")});
    panels.path.curves.push_back(dots);
  }
  return panels;
}

/// Results and pictures of pendulum_on_cable against the independent solution.
template <class System>
void compare_with_reference(Session<System>& session, const std::string& measure) {
  const PendulumPanels panels =
      beside_reference(session, measure, "reference",
                       [&](const std::string& name, double t, double value, double reference) {
                         session.result(name + "_" + format_exact(t) + "s", value, reference, "m");
                       });
  report_difference(session, panels.difference, {0.4, 0.6, 1.0, 1.5});
  const std::string strain = measure == "green" ? "Green's strain" : "engineering strain";
  session.curves("trajectories", session.title() + ", without air, " + strain,
                 {panels.path, panels.place, panels.difference, energy_panel(session)}, 2);
  draw_motion(session, "motion.png", view_xy, {}, some_frames(session, 11),
              paths_of(session.traces(), {"A", "C"}));
  draw_frames(session, "frames.png", view_xy, {.width = 1600}, some_frames(session, 6), 3);
}

/// What the air changes: A and C beside the independent solution without it, and its forces.
template <class System>
void compare_with_motion_without_air(Session<System>& session, const std::string& measure) {
  PendulumPanels panels =
      beside_reference(session, measure, "without air",
                       [&](const std::string& name, double t, double value, double reference) {
                         session.result("shift_" + name + "_" + format_exact(t) + "s",
                                        value - reference, std::nullopt, "m");
                       });
  panels.difference.title = "shift by the air";
  Panel force{.title = "force of the air", .x_label = "t [s]", .y_label = "[N]"};
  for (const char* bar : {"AB_x", "AB_y", "BC_x", "BC_y"})
    force.curves.push_back(session.history().curve(std::string("gas_force_") + bar, bar));
  report_interface(session);
  for (const char* bar : {"AB", "BC"}) report_noise(session, bar);
  session.curves("trajectories", session.title(),
                 {panels.path, panels.place, panels.difference, force}, 2);
}

}  // namespace sphmbs::examples
