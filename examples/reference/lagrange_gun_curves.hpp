// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "reference/lagrange_gun.hpp"
#include "support/coupled_session.hpp"

namespace sphmbs::examples {

/// Results and pictures of lagrange_gun against the exact motion.
template <class System>
void compare_with_exact(Session<System>& session, const LagrangeGun& exact) {
  const History& history = session.history();
  const double end = history.time().back();
  session.result("speed", history.of("speed").back(), exact.velocity(end), "m/s");
  session.result("way", history.of("way").back(), exact.way(end), "m");
  session.result("face_pressure", history.of("face_pressure").back(), exact.face_pressure(end),
                 "Pa");
  report_interface(session);
  const auto panel = [&](const std::string& name, const std::string& heading,
                         const std::string& label, const std::function<double(double)>& value) {
    Curve curve;
    curve.label = "exact";
    curve.reference = true;
    for (const double t : history.time()) {
      curve.x.push_back(t);
      curve.y.push_back(value(t));
    }
    return Panel{.title = heading,
                 .x_label = "t [s]",
                 .y_label = label,
                 .curves = {history.curve(name, "sphmbs"), curve}};
  };
  session.curves(
      "history", session.title(),
      {panel("speed", "piston", "speed [m/s]", [&](double t) { return exact.velocity(t); }),
       panel("face_pressure", "gas on the piston", "pressure [Pa]",
             [&](double t) { return exact.face_pressure(t); })},
      2);
}

}  // namespace sphmbs::examples
