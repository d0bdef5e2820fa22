// SPDX-License-Identifier: MIT
// flexible_pendulum, slider_crank and spinning_top as their users run them, against other
// solutions.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "reference/flexible_pendulum.hpp"
#include "reference/slider_crank.hpp"
#include "reference/spinning_top.hpp"
#include "support/catch.hpp"
#include "support/program.hpp"
#include "validation/mbs/runs.hpp"

namespace {

namespace reference = sphmbs::examples;
using Words = std::vector<std::string>;

template <class Rows>
double pendulum_difference(const test::Table& traces, const Rows& rows, double until) {
  using Row = reference::FlexiblePendulumReference;
  return std::max({test::largest_difference(traces, "tip_x[m]", rows, &Row::tip_x, until),
                   test::largest_difference(traces, "tip_y[m]", rows, &Row::tip_y, until),
                   test::largest_difference(traces, "middle_x[m]", rows, &Row::middle_x, until),
                   test::largest_difference(traces, "middle_y[m]", rows, &Row::middle_y, until)});
}

double top_difference(const test::Table& traces, double until) {
  using Row = reference::TopReference;
  const auto& rows = reference::top_reference;
  return std::max({test::largest_difference(traces, "centre_x[m]", rows, &Row::x, until),
                   test::largest_difference(traces, "centre_y[m]", rows, &Row::y, until),
                   test::largest_difference(traces, "centre_z[m]", rows, &Row::z, until)});
}

}  // namespace

TEST_CASE("flexible_pendulum follows the reference with 12 and with 40 elements",
          "[flexible_pendulum]") {
  const auto few = test::run_structure(SPHMBS_FLEXIBLE_PENDULUM, {});
  const auto many = test::run_structure(SPHMBS_FLEXIBLE_PENDULUM, {"--elements", "40"});
  const auto& rows_12 = reference::flexible_pendulum_12;
  const auto& rows_40 = reference::flexible_pendulum_40;
  for (const auto& [until, allowed] :
       {std::pair(0.4, 2e-3), std::pair(0.6, 2e-3), std::pair(1.0, 1e-2)}) {
    const double by_12 = pendulum_difference(few.traces, rows_12, until),
                 by_40 = pendulum_difference(many.traces, rows_40, until),
                 between = pendulum_difference(few.traces, rows_40, until);
    std::cout << "flexible_pendulum up to " << until << " s: " << by_12 << " m with 12 elements, "
              << by_40 << " m with 40, 12 against 40 elements " << between << " m\n";
    CHECK(by_12 < allowed);
    CHECK(by_40 < allowed);
  }
}

TEST_CASE("slider_crank follows the exact motion at second order", "[slider_crank]") {
  const auto run = test::run_structure(SPHMBS_SLIDER_CRANK,
                                       {"--step", "5e-4", "--halvings", "2", "--until", "1"});
  // The exact motion itself, against the other solution of it.
  const reference::SliderCrankMotion exact;
  for (const auto& [t, angle, rate, slider] : reference::slider_crank_reference) {
    const auto state = exact.at(t);
    CHECK(state.angle == Approx(angle).margin(2e-8));
    CHECK(state.rate == Approx(rate).margin(2e-8));
    CHECK(state.slider == Approx(slider).margin(2e-9));
  }
  const auto time = run.traces.column("t[s]"), angle = run.traces.column("angle[rad]"),
             rate = run.traces.column("rate[rad/s]"), slider = run.traces.column("slider_x[m]"),
             velocity = run.traces.column("slider_vx[m/s]");
  double largest = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const auto state = exact.at(time[k]);
    largest = std::max(largest, std::abs(slider[k] - state.slider));
    CHECK(angle[k] == Approx(state.angle).margin(2e-3));
    CHECK(rate[k] == Approx(state.rate).margin(1e-1));
    // What the program says of the slider fits to what it says of the crank: places by the joints,
    // velocities as well as the steps go.
    CHECK(slider[k] == Approx(exact.slider_at(angle[k])).margin(1e-9));
    CHECK(velocity[k] == Approx(exact.slider_slope(angle[k]) * rate[k]).margin(2e-3));
  }
  std::cout << "slider_crank with steps of 5e-4 s: the slider is off by " << largest << " m\n";
  CHECK(largest < 1e-4);
  for (const char* order : {"order_1", "order_2"})
    CHECK(run.summary["results"][order]["value"].get<double>() == Approx(2).margin(0.1));
}

TEST_CASE("spinning_top follows the reference at second order", "[spinning_top]") {
  const auto coarse = test::run_structure(SPHMBS_SPINNING_TOP, {"--step", "2e-4"});
  const auto fine = test::run_structure(SPHMBS_SPINNING_TOP, {});
  const double by_coarse = top_difference(coarse.traces, 2),
               by_fine = top_difference(fine.traces, 2);
  std::cout << "spinning_top up to 2 s: its centre of mass is off by " << by_coarse
            << " m with steps of 2e-4 s, " << by_fine << " m with 1e-4 s\n";
  CHECK(by_fine < 3e-4);
  CHECK(std::log2(by_coarse / by_fine) == Approx(2).margin(0.1));
  using Row = reference::TopReference;
  CHECK(test::largest_difference(fine.traces, "rate_1[rad/s]", reference::top_reference,
                                 &Row::rate_1, 0.5) < 0.05);
  CHECK(test::largest_difference(fine.traces, "rate_3[rad/s]", reference::top_reference,
                                 &Row::rate_3, 0.5) < 0.05);
  // The force of the joint and the weight move the centre of mass, at rest along z at first:
  // m z(T) = integral of (T - t) (F - m g) dt, here by the trapezoidal rule.
  const auto time = fine.history.column("t[s]"), force = fine.history.column("force_z[N]");
  double z = 0;
  for (std::size_t k = 0; k + 1 < time.size(); ++k) {
    const auto moved = [&](std::size_t i) { return (2 - time[i]) * (force[i] / 15 - 9.81); };
    z += (time[k + 1] - time[k]) / 2 * (moved(k) + moved(k + 1));
  }
  CHECK(z == Approx(fine.traces.column("centre_z[m]").back()).margin(0.02));
}
