// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/pendulum_on_cable.hpp"
#include "support/structure_pictures.hpp"

namespace sphmbs::examples {

/// The independent solution with a measure of strain.
inline std::span<const PendulumReference> pendulum_reference(const std::string& measure) {
  if (measure == "green") return pendulum_green;
  return pendulum_engineering;
}

/// Results and pictures of pendulum_on_cable against the independent solution.
template <class System>
void compare_with_reference(Session<System>& session, const std::string& measure) {
  const std::span<const PendulumReference> rows = pendulum_reference(measure);
  const double until = session.settings().until;
  const History& traces = session.traces();
  Panel path{.title = "paths of A and C", .x_label = "x [m]", .y_label = "y [m]"};
  Panel place{.title = "places of A and C", .x_label = "t [s]", .y_label = "[m]"};
  Panel difference{.title = "difference from the reference", .x_label = "t [s]", .y_label = "[m]"};
  const auto compare = [&](const std::string& name, double PendulumReference::*member) {
    const ReferenceCurve reference = reference_curve(rows, member);
    Curve dots = reference.curve(place.curves.empty() ? "reference" : "", until);
    place.curves.push_back(traces.curve(name, name));
    place.curves.push_back(dots);
    difference.curves.push_back(reference.difference(traces, name, name));
    for (const double t : {0.5, 1.0})
      if (t < until + 1e-9)
        session.result(name + "_" + format_exact(t) + "s", traces.at(name, t), reference.at(t),
                       "m");
    return dots;
  };
  for (const auto& [name, x, y] :
       {std::tuple("A", &PendulumReference::A_x, &PendulumReference::A_y),
        std::tuple("C", &PendulumReference::C_x, &PendulumReference::C_y)}) {
    const std::string point = name;
    Curve dots = compare(point + "_x", x);
    dots.x = dots.y;
    dots.y = compare(point + "_y", y).y;
    dots.label = path.curves.empty() ? "reference" : "";
    path.curves.push_back(
        {.label = point, .x = traces.of(point + "_x"), .y = traces.of(point + "_y")});
    path.curves.push_back(dots);
  }
  report_difference(session, difference, {0.4, 0.6, 1.0, 1.5});
  const std::string strain = measure == "green" ? "Green's strain" : "engineering strain";
  session.curves("trajectories", session.title() + ", without air, " + strain,
                 {path, place, difference, energy_panel(session)}, 2);
  draw_motion(session, "motion.png", view_xy, {}, some_frames(session, 11),
              paths_of(traces, {"A", "C"}));
  draw_frames(session, "frames.png", view_xy, {.width = 1600}, some_frames(session, 6), 3);
}

}  // namespace sphmbs::examples
