// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/body_images.hpp"
#include "support/structure_session.hpp"

namespace sphmbs::examples {

/// Energies over the run as a panel.
template <class System>
Panel energy_panel(Session<System>& session) {
  Panel panel{.title = "energy", .x_label = "t [s]", .y_label = "[J]"};
  const History& history = session.history();
  for (const char* name :
       {"kinetic", "strain", "potential", "springs", "dissipated", "work", "total"}) {
    const std::vector<double>& values = history.of(name);
    const double first = values.empty() ? 0 : values.front();
    Curve curve = history.curve(name, name);
    const bool nothing = std::all_of(values.begin(), values.end(), [](double e) { return e == 0; });
    if (nothing) continue;
    if (std::string_view(name) == "potential") {
      curve.label = "potential, from its start";
      for (double& e : curve.y) e -= first;
    }
    if (std::string_view(name) == "total") {
      curve.label = "change of the total";
      for (double& e : curve.y) e -= first;
    }
    panel.curves.push_back(curve);
  }
  return panel;
}

/// Results for the largest magnitude of a panel's curves up to each of the times that the run has
/// reached: largest_difference_to_0.4s ...
template <class System>
void report_difference(Session<System>& session, const Panel& difference,
                       std::initializer_list<double> times) {
  for (const double t : times) {
    if (t > session.settings().until + 1e-9) continue;
    double largest = 0;
    for (const Curve& curve : difference.curves)
      largest = std::max(largest, largest_until(curve, t));
    session.result("largest_difference_to_" + format_exact(t) + "s", largest, std::nullopt, "m");
  }
}

/// About so many of a session's frames, evenly spaced, first and last among them.
template <class System>
std::vector<Frame> some_frames(Session<System>& session, std::size_t count) {
  const std::vector<Frame>& frames = session.display().frames();
  std::vector<Frame> some;
  const std::size_t last = frames.size() - 1;
  const std::size_t pieces = std::min(last, count - 1);
  for (std::size_t k = 0; k <= pieces; ++k)
    some.push_back(frames[pieces > 0 ? k * last / pieces : 0]);
  return some;
}

/// Paths of points in a plane, from the columns <name>_x, <name>_y of trajectories.csv, or of
/// others in the places of x, y and z.
inline io::Mesh paths_of(const History& traces, const std::vector<std::string>& names,
                         std::string_view axes = "xy") {
  io::Mesh mesh;
  for (const std::string& name : names) {
    const auto first = static_cast<std::int64_t>(mesh.size());
    for (std::size_t k = 0; k < traces.time().size(); ++k)
      for (const char axis : {'x', 'y', 'z'}) {
        const bool given = axes.find(axis) != std::string_view::npos;
        mesh.points.push_back(given ? traces.of(name + "_" + axis)[k] : 0.0);
      }
    mesh.lines.add_row(first, static_cast<std::int64_t>(traces.time().size()));
  }
  return mesh;
}

/// Draws frames into one picture of a plane, coloured by time, over the paths of some points.
template <class System>
void draw_motion(Session<System>& session, const std::string& name, const View& view,
                 ImageOptions options, const std::vector<Frame>& frames,
                 const io::Mesh& paths = {}) {
  BodyTile tile{.layers = {{&paths, {}}}, .title = ""};
  for (const Frame& frame : frames)
    tile.layers.push_back({&frame.mesh, std::vector<double>(frame.mesh.size(), frame.time)});
  options.title = session.title();
  options.bar_label = "t [s]";
  session.picture(name, [&](const std::filesystem::path& file) {
    draw_bodies(file, std::span(&tile, 1), 1, view, options);
  });
}

/// Draws frames side by side, coloured by speed.
template <class System>
void draw_frames(Session<System>& session, const std::string& name, const View& view,
                 ImageOptions options, const std::vector<Frame>& frames, int columns) {
  std::vector<BodyTile> tiles;
  for (const Frame& frame : frames)
    tiles.push_back({{{&frame.mesh, lengths_of(frame.mesh, "velocity [m/s]")}},
                     "t = " + format_number(frame.time) + " s"});
  options.title = session.title();
  options.bar_label = "|v| [m/s]";
  session.picture(name, [&](const std::filesystem::path& file) {
    draw_bodies(file, tiles, columns, view, options);
  });
}

}  // namespace sphmbs::examples
