// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <sphmbs/geometry/ball.hpp>
#include <sphmbs/geometry/lattice.hpp>

#include "reference/gas_cylinder.hpp"
#include "support/gas_session.hpp"

namespace sphmbs::examples {

/// The outermost lattice points of the cylinder: as many as lie in an annulus of 7.0886 layers by
/// area, which are the paper's 4 296 at a spacing of 0.1 m. Of a shell that is cut, points nearer
/// to the x direction stay.
inline std::vector<Vec<2>> ring(const geometry::Lattice<2>& lattice,
                                const geometry::Domain<2>& domain,
                                const geometry::Ball<2>& cylinder) {
  std::vector<Vec<2>> points = lattice.points(cylinder, domain);
  const double layers = 7.0886;
  const double radius = std::floor(cylinder.radius / lattice.spacing);
  const double count = math::pi * layers * (2 * radius - layers);
  const auto order = [&](const Vec<2>& a, const Vec<2>& b) {
    const Vec<2> da = a - cylinder.centre;
    const Vec<2> db = b - cylinder.centre;
    const double difference = norm2(da) - norm2(db);
    const double same = 1e-3 * lattice.spacing * lattice.spacing;
    if (std::abs(difference) > same) return difference > 0;
    return std::abs(da[1]) < std::abs(db[1]);
  };
  std::stable_sort(points.begin(), points.end(), order);
  const double all = static_cast<double>(points.size());
  if (radius > layers && count < all) points.resize(static_cast<std::size_t>(std::lround(count)));
  return points;
}

/// Results and pictures of gas_cylinder against the finite-volume reference.
template <class Fluid>
void compare_with_reference(Session<Fluid>& session) {
  struct Point {
    const char* name;
    const char* title;
    double CylinderReference::*speed;
    double CylinderReference::*pressure;
  };
  const Point points[] = {
      {"upstream", "(25, 25) upstream", &CylinderReference::speed_upstream,
       &CylinderReference::p_upstream},
      {"above", "(40, 40) above", &CylinderReference::speed_above, &CylinderReference::p_above},
      {"downstream", "(55, 25) downstream", &CylinderReference::speed_downstream,
       &CylinderReference::p_downstream},
      {"far", "(65, 40) far downstream", &CylinderReference::speed_far, &CylinderReference::p_far}};
  const History& history = session.history();
  const double until = session.settings().until;
  std::vector<double> time;
  for (const auto& row : cylinder_reference)
    if (row.t <= until + 1e-9) time.push_back(row.t);
  std::vector<double> stream;  // speed of the undisturbed gas, 3 t
  for (const double t : time) stream.push_back(3 * t);
  const std::vector<double> one(time.size(), 1.0);
  std::vector<Panel> panels;
  const auto panel = [&](const std::string& title, const std::string& label,
                         const std::string& name, double CylinderReference::*member) {
    std::vector<double> reference;
    for (std::size_t i = 0; i < time.size(); ++i)
      reference.push_back(cylinder_reference[i].*member);
    Curve exact;
    exact.label = "finite volumes";
    exact.x = time;
    exact.y = reference;
    exact.reference = true;
    Panel p;
    p.title = title;
    p.x_label = "t [s]";
    p.y_label = label;
    p.curves = {history.curve(name, "sphmbs"), exact};
    panels.push_back(p);
    return reference;
  };
  for (const Point& point : points) {
    const std::string speed = std::string("speed_") + point.name;
    const auto reference = panel(point.title, "speed [m/s]", speed, point.speed);
    if (time.empty()) continue;
    session.result(speed, history.at(speed, time.back()), reference.back(), "m/s");
    session.result(speed + "_rms_share_of_3t",
                   rms_difference(history, speed, time, reference, stream, 0.2, 1), std::nullopt,
                   "-");
  }
  for (const Point& point : points) {
    const std::string pressure = std::string("p_") + point.name;
    const auto reference = panel(point.title, "pressure [Pa]", pressure, point.pressure);
    if (time.empty()) continue;
    session.result(pressure, history.at(pressure, time.back()), reference.back(), "Pa");
    session.result(pressure + "_rms",
                   rms_difference(history, pressure, time, reference, one, 0.2, 1), std::nullopt,
                   "Pa");
  }
  const auto force =
      panel("force on the cylinder", "force [N/m]", "force", &CylinderReference::force);
  if (!time.empty()) session.result("force", history.at("force", time.back()), force.back(), "N/m");
  session.curves("history",
                 "gas_cylinder, spacing " + format_exact(session.settings().spacing) + " m", panels,
                 4);
}

}  // namespace sphmbs::examples
