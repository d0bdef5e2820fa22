// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <tuple>

#include "reference/flexible_pendulum.hpp"
#include "support/structure_pictures.hpp"

namespace sphmbs::examples {

/// The independent solution with 12 elements, or with 40 for any other number.
inline std::span<const FlexiblePendulumReference> flexible_pendulum_reference(int elements) {
  if (elements == 12) return flexible_pendulum_12;
  return flexible_pendulum_40;
}

/// Results and pictures of flexible_pendulum against the independent solution.
template <class System>
void compare_with_reference(Session<System>& session, int elements) {
  using Row = FlexiblePendulumReference;
  const auto rows = flexible_pendulum_reference(elements);
  const double until = session.settings().until;
  const History& traces = session.traces();
  Panel place{.title = "places of tip and middle", .x_label = "t [s]", .y_label = "[m]"};
  Panel difference{.title = "difference from the reference", .x_label = "t [s]", .y_label = "[m]"};
  for (const auto& [name, member] :
       {std::tuple("tip_x", &Row::tip_x), std::tuple("tip_y", &Row::tip_y),
        std::tuple("middle_x", &Row::middle_x), std::tuple("middle_y", &Row::middle_y)}) {
    const ReferenceCurve reference = reference_curve(rows, member);
    place.curves.push_back(traces.curve(name, name));
    place.curves.push_back(reference.curve(place.curves.size() == 1 ? "reference" : "", until));
    difference.curves.push_back(reference.difference(traces, name, name));
    for (const double t : {0.4, 0.6, 1.0})
      if (t < until + 1e-9)
        session.result(std::string(name) + "_" + format_exact(t) + "s", traces.at(name, t),
                       reference.at(t), "m");
  }
  report_difference(session, difference, {0.4, 0.6, 1.0});
  session.curves("trajectories", session.title(), {place, difference, energy_panel(session)}, 3);
  draw_motion(session, "motion.png", view_xy, {}, some_frames(session, 11),
              paths_of(traces, {"tip"}));
}

}  // namespace sphmbs::examples
