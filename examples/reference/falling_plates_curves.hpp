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

/// Results and pictures of falling_plates against the independent solution.
template <class System>
void compare_with_reference(Session<System>& session, int elements) {
  const double until = session.settings().until;
  const History& traces = session.traces();
  Panel place{.title = "place of P", .x_label = "t [s]", .y_label = "[m]"};
  Panel velocity{.title = "velocity of P", .x_label = "t [s]", .y_label = "[m/s]"};
  Panel difference{.title = "difference from the reference", .x_label = "t [s]", .y_label = "[m]"};
  const auto compare = [&](const std::string& name, double PlatesReference::*member, Panel& panel) {
    const ReferenceCurve reference = reference_curve(plates_reference, member);
    panel.curves.push_back(traces.curve(name, name));
    panel.curves.push_back(reference.curve(panel.curves.size() == 1 ? "reference" : "", until));
    if (&panel == &place) difference.curves.push_back(reference.difference(traces, name, name));
    for (const double t : {0.4, 0.6})
      if (t < until + 1e-9)
        session.result(name + "_" + format_exact(t) + "s", traces.at(name, t), reference.at(t),
                       &panel == &place ? "m" : "m/s");
  };
  compare("P_x", &PlatesReference::P_x, place);
  compare("P_z", &PlatesReference::P_z, place);
  compare("P_vx", &PlatesReference::P_vx, velocity);
  compare("P_vz", &PlatesReference::P_vz, velocity);
  report_difference(session, difference, {0.4, 0.6, 0.7, 0.8, 1.0});
  double aside = 0;
  for (const double y : session.history().of("P_y")) aside = std::max(aside, std::abs(y - 2.5));
  session.result("largest_asymmetry_of_P", aside, std::nullopt, "m");
  session.curves("trajectories", session.title() + ", without air",
                 {place, velocity, difference, energy_panel(session)}, 2);
  std::vector<Frame> sections = some_frames(session, 11);
  for (Frame& frame : sections) frame.mesh = middle_of(frame.mesh, elements);
  draw_motion(session, "motion.png", view_xz, {.y_name = "z"}, sections,
              paths_of(traces, {"P"}, "xz"));
  draw_frames(session, "frames.png", oblique_view(-60, 25), {.axes = false, .width = 1600},
              some_frames(session, 6), 3);
}

}  // namespace sphmbs::examples
