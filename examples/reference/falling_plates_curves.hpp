// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/falling_plates.hpp"
#include "support/coupled_session.hpp"
#include "support/structure_pictures.hpp"

namespace sphmbs::examples {

/// The line through the middle of both plates, from the mesh of all elements: plate by plate, row
/// by row, `elements` a row.
inline io::Mesh middle_of(const io::Mesh& plates, int elements) {
  const int pieces = io::Subdivision{}.surface;
  const int row = elements % 2 == 0 ? 0 : pieces / 2;  // of points in an element
  io::Mesh line;
  for (int plate = 0; plate < 2; ++plate)
    for (int column = 0; column < elements; ++column) {
      const int element = (plate * elements + elements / 2) * elements + column;
      const auto first = static_cast<std::size_t>((element * (pieces + 1) + row) * (pieces + 1));
      const auto from = plates.points.begin() + static_cast<std::ptrdiff_t>(3 * first);
      line.lines.add_row(static_cast<std::int64_t>(line.size()), pieces + 1);
      line.points.insert(line.points.end(), from, from + 3 * (pieces + 1));
    }
  return line;
}

/// P beside the independent solution without air.
struct PlatesPanels {
  Panel place{.title = "place of P", .x_label = "t [s]", .y_label = "[m]"};
  Panel velocity{.title = "velocity of P", .x_label = "t [s]", .y_label = "[m/s]"};
  Panel difference{.title = "difference from the reference", .x_label = "t [s]", .y_label = "[m]"};
};

/// Draws the panels and calls report(name, unit, t, value, reference) at 0.4 s and 0.6 s.
/// @param label  of the independent solution
template <class System, class Report>
PlatesPanels beside_reference(Session<System>& session, const std::string& label,
                              const Report& report) {
  const double until = session.settings().until;
  const History& traces = session.traces();
  PlatesPanels panels;
  const auto compare = [&](const std::string& name, double PlatesReference::*member, Panel& panel) {
    const ReferenceCurve reference = reference_curve(plates_reference, member);
    const bool place = &panel == &panels.place;
    panel.curves.push_back(traces.curve(name, name));
    panel.curves.push_back(reference.curve(panel.curves.size() == 1 ? label : "", until));
    if (place) panels.difference.curves.push_back(reference.difference(traces, name, name));
    for (const double t : {0.4, 0.6})
      if (t < until + 1e-9)
        report(name, place ? "m" : "m/s", t, traces.at(name, t), reference.at(t));
  };
  compare("P_x", &PlatesReference::P_x, panels.place);
  compare("P_z", &PlatesReference::P_z, panels.place);
  compare("P_vx", &PlatesReference::P_vx, panels.velocity);
  compare("P_vz", &PlatesReference::P_vz, panels.velocity);
  return panels;
}

/// The largest way of P out of the plane of symmetry as a result, and pictures of the motion.
template <class System>
void show_motion(Session<System>& session, int elements) {
  double aside = 0;
  for (const double y : session.history().of("P_y")) aside = std::max(aside, std::abs(y - 2.5));
  session.result("largest_asymmetry_of_P", aside, std::nullopt, "m");
  std::vector<Frame> sections = some_frames(session, 11);
  for (Frame& frame : sections) frame.mesh = middle_of(frame.mesh, elements);
  draw_motion(session, "motion.png", view_xz, {.y_name = "z"}, sections,
              paths_of(session.traces(), {"P"}, "xz"));
  draw_frames(session, "frames.png", oblique_view(-60, 25), {.axes = false, .width = 1600},
              some_frames(session, 6), 3);
}

/// Results and pictures of falling_plates against the independent solution.
template <class System>
void compare_with_reference(Session<System>& session, int elements) {
  const PlatesPanels panels = beside_reference(
      session, "reference",
      [&](const std::string& name, const char* unit, double t, double value, double reference) {
        session.result(name + "_" + format_exact(t) + "s", value, reference, unit);
      });
  report_difference(session, panels.difference, {0.4, 0.6, 0.7, 0.8, 1.0});
  session.curves("trajectories", session.title() + ", without air",
                 {panels.place, panels.velocity, panels.difference, energy_panel(session)}, 2);
  show_motion(session, elements);
}

/// What the air changes: P beside the independent solution without it, and the air's force.
template <class System>
void compare_with_motion_without_air(Session<System>& session, int elements) {
  PlatesPanels panels = beside_reference(
      session, "without air",
      [&](const std::string& name, const char* unit, double t, double value, double reference) {
        session.result("shift_" + name + "_" + format_exact(t) + "s", value - reference,
                       std::nullopt, unit);
      });
  panels.difference.title = "shift by the air";
  Panel force{.title = "force of the air on the plates", .x_label = "t [s]", .y_label = "[N]"};
  for (const char* plate : {"I_x", "I_z", "II_x", "II_z"})
    force.curves.push_back(session.history().curve(std::string("gas_force_") + plate, plate));
  report_interface(session);
  for (const char* plate : {"I", "II"}) report_noise(session, plate);
  session.curves("trajectories", session.title(),
                 {panels.place, panels.velocity, panels.difference, force}, 2);
  show_motion(session, elements);
}

}  // namespace sphmbs::examples
