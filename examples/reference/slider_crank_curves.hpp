// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/mbs/ncf/readout.hpp>

#include "reference/slider_crank.hpp"
#include "support/structure_pictures.hpp"

namespace sphmbs::examples {

/// Angle of the crank over all its turns, its rate, place and velocity of the slider in
/// trajectories.csv.
template <class System, class Crank, class Slider>
void trace_slider_crank(Session<System>& session, const Crank& crank, const Slider& slider) {
  System& system = session.system();
  const auto arm = crank.vector(crank.part.start(), crank.part.end());
  session.trace("angle", "rad", [&session, &system, arm] {
    const auto u = arm.at(system.state().q);
    const std::vector<double>& earlier = session.traces().of("angle");
    const double turn = 2 * std::numbers::pi, angle = std::atan2(u[1], u[0]);
    return angle + turn * std::round(((earlier.empty() ? 0 : earlier.back()) - angle) / turn);
  });
  session.trace("rate", "rad/s", [&system, arm] {
    const auto u = arm.at(system.state().q), v = arm.rate(system.state().v);
    return (u[0] * v[1] - u[1] * v[0]) / u.squaredNorm();
  });
  trace_point(session, "slider", slider.point({0, 0}), "x");
  trace_velocity(session, "slider", slider.point({0, 0}), "x");
}

/// Results and pictures of slider_crank against the exact motion.
template <class System>
void compare_with_reference(Session<System>& session, const SliderCrankMotion& exact) {
  const History& traces = session.traces();
  ReferenceCurve angle{.time = traces.time(), .value = {}}, rate = angle, slider = angle;
  double root = 0, before = 0;
  for (const double t : traces.time()) {
    root = exact.root(root, std::exchange(before, t), t);
    const auto state = exact.state(root);
    angle.value.push_back(state.angle);
    rate.value.push_back(state.rate);
    slider.value.push_back(state.slider);
  }
  const double until = session.settings().until;
  for (const double t : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    if (t > until + 1e-9) continue;
    const std::string at = "_" + format_exact(t) + "s";
    session.result("angle" + at, traces.at("angle", t), angle.at(t), "rad");
    session.result("rate" + at, traces.at("rate", t), rate.at(t), "rad/s");
    session.result("slider" + at, traces.at("slider_x", t), slider.at(t), "m");
  }
  const Panel difference{.title = "difference from the exact motion",
                         .x_label = "t [s]",
                         .y_label = "x of the slider [m]",
                         .curves = {slider.difference(traces, "slider_x", "")}};
  report_difference(session, difference, {until});
  const std::vector<Panel> panels{
      {.title = "rate of the crank",
       .x_label = "t [s]",
       .y_label = "rate [rad/s]",
       .curves = {traces.curve("rate", "sphmbs"), rate.curve("exact", until)}},
      {.title = "slider",
       .x_label = "t [s]",
       .y_label = "x [m]",
       .curves = {traces.curve("slider_x", "sphmbs"), slider.curve("exact", until)}},
      difference,
      energy_panel(session)};
  session.curves("history", session.title(), panels, 2);
  draw_motion(session, "motion.png", view_xy, {}, some_frames(session, 9));
}

/// Errors of the slider's place for the step of the run and so many halves of it, and the order at
/// which they fall; run(step) returns the place at each time of the trajectories.
template <class System, class Run>
void report_order(Session<System>& session, const SliderCrankMotion& exact, int halvings,
                  Run&& run) {
  const std::vector<double>& time = session.traces().time();
  const auto error_of = [&](const std::vector<double>& x) {
    double error = 0;
    for (std::size_t k = 0; k < time.size(); ++k)
      error = std::max(error, std::abs(x[k] - exact.at(time[k]).slider));
    return error;
  };
  Curve errors{.label = "slider", .style = {.marker = Marker::circle}};
  Curve square{.label = "order 2", .reference = true};
  const double first = *session.settings().step;
  for (int k = 0; k <= halvings; ++k) {
    const double step = std::ldexp(first, -k);
    const double error = error_of(k == 0 ? session.traces().of("slider_x") : run(step));
    if (k > 0)
      session.result("order_" + std::to_string(k), std::log2(errors.y.back() / error), 2, "-");
    errors.x.push_back(step);
    errors.y.push_back(error);
    square.x.push_back(step);
    square.y.push_back(errors.y.front() * std::ldexp(1.0, -2 * k));
  }
  session.curves("order", session.title(),
                 {{.title = "largest error of the slider's place",
                   .x_label = "step [s]",
                   .y_label = "[m]",
                   .curves = {errors, square},
                   .log_x = true,
                   .log_y = true}},
                 1);
}

}  // namespace sphmbs::examples
