// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <sphmbs/mbs/ncf/readout.hpp>

#include "reference/spinning_top.hpp"
#include "support/structure_pictures.hpp"

namespace sphmbs::examples {

/// Axis, disc of the radius that its moment of inertia asks for, and a spoke that shows the spin,
/// of thirty pieces in all.
inline std::vector<mbs::Vector<3>> top_outline() {
  const double radius = 0.25;  // [m]
  std::vector<mbs::Vector<3>> points{{0, 0, 0}, {0, 1.2, 0}, {0, 1, 0}};
  for (int k = 0; k <= 27; ++k) {
    const double angle = 2 * std::numbers::pi * k / 27;
    points.push_back({radius * std::cos(angle), 1, radius * std::sin(angle)});
  }
  return points;
}

/// Angular velocity about the first and the third axis of the body in trajectories.csv.
template <class System, class Top>
void trace_top(Session<System>& session, const Top& top) {
  for (const int k : {0, 2})
    session.trace("rate_" + std::to_string(k + 1), "rad/s", [&system = session.system(), top, k] {
      return mbs::ncf::body_angular_velocity(top, system.state().q, system.state().v)[k];
    });
}

/// Results and pictures of spinning_top, against the reference where there is one.
template <class System>
void compare_with_reference(Session<System>& session, bool has_reference) {
  const double until = session.settings().until;
  const History& traces = session.traces();
  Panel place{.title = "centre of mass", .x_label = "t [s]", .y_label = "[m]"};
  Panel rates{.title = "angular velocity, body axes", .x_label = "t [s]", .y_label = "[rad/s]"};
  Panel difference{.title = "difference from the reference", .x_label = "t [s]", .y_label = "[m]"};
  for (const auto& [name, member, panel] : {std::tuple("centre_x", &TopReference::x, &place),
                                            std::tuple("centre_y", &TopReference::y, &place),
                                            std::tuple("centre_z", &TopReference::z, &place),
                                            std::tuple("rate_1", &TopReference::rate_1, &rates),
                                            std::tuple("rate_3", &TopReference::rate_3, &rates)}) {
    panel->curves.push_back(traces.curve(name, name));
    if (!has_reference) continue;
    const ReferenceCurve reference = reference_curve(top_reference, member);
    panel->curves.push_back(reference.curve(panel->curves.size() == 1 ? "reference" : "", until));
    if (panel == &place) difference.curves.push_back(reference.difference(traces, name, name));
    for (const double t : {0.5, 1.0, 2.0})
      if (t < until + 1e-9)
        session.result(std::string(name) + "_" + format_exact(t) + "s", traces.at(name, t),
                       reference.at(t), panel == &place ? "m" : "rad/s");
  }
  rates.x_range = Range{0, std::min(until, 0.4)};  // later they are too dense to see
  std::vector<Panel> panels{place, rates};
  if (has_reference) {
    report_difference(session, difference, {0.5, 1.0, 2.0});
    panels.push_back(difference);
  }
  panels.push_back(energy_panel(session));
  session.curves("trajectories", session.title(), panels, 2);
  draw_frames(session, "frames.png", oblique_view(35, 20), {.axes = false}, some_frames(session, 6),
              3);
}

}  // namespace sphmbs::examples
