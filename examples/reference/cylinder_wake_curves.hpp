// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/gas_session.hpp"

namespace sphmbs::examples {

/// Mean drag and frequency of a wake over the whole periods of its second half.
struct Shedding {
  double drag;      // mean coefficient [-]
  double lift;      // half the way between the extremes of the lift coefficient [-]
  double strouhal;  // frequency D / U [-]
  int periods;      // taken into account
};

/// From the history's drag_coefficient and lift_coefficient. A period ends where the lift rises
/// through its mean; without two such times all numbers but the mean drag are NaN.
inline Shedding shedding(const History& history) {
  const std::vector<double>& t = history.time();
  const std::vector<double>& drag = history.of("drag_coefficient");
  const std::vector<double>& lift = history.of("lift_coefficient");
  const auto half =
      static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), t.back() / 2) - t.begin());
  double middle = 0;
  for (std::size_t i = half; i < t.size(); ++i)
    middle += lift[i] / static_cast<double>(t.size() - half);
  const double extreme =
      0.5 * (*std::max_element(lift.begin() + static_cast<std::ptrdiff_t>(half), lift.end()) -
             *std::min_element(lift.begin() + static_cast<std::ptrdiff_t>(half), lift.end()));
  std::vector<double> rises;
  bool below = false;  // noise at the middle does not count
  for (std::size_t i = half + 1; i < t.size(); ++i) {
    if (lift[i] < middle - 0.3 * extreme) below = true;
    if (!below || lift[i] < middle) continue;
    below = false;
    const double share = (middle - lift[i - 1]) / (lift[i] - lift[i - 1]);
    rises.push_back(t[i - 1] + share * (t[i] - t[i - 1]));
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Shedding found{0, nan, nan, std::max(0, static_cast<int>(rises.size()) - 1)};
  const bool sheds = found.periods > 0;
  const double from = sheds ? rises.front() : t[half], to = sheds ? rises.back() : t.back();
  double time = 0;
  for (std::size_t i = half; i + 1 < t.size(); ++i) {
    if (t[i] < from || t[i + 1] > to) continue;
    found.drag += 0.5 * (drag[i] + drag[i + 1]) * (t[i + 1] - t[i]);
    time += t[i + 1] - t[i];
  }
  found.drag /= time;
  if (!sheds) return found;
  found.lift = extreme;
  found.strouhal = found.periods / (to - from);
  return found;
}

/// Drag and lift beside what others found at a Reynolds number of 100: mean drag 1.33 to 1.37,
/// Strouhal number 0.164 to 0.166, both for a stream without bounds.
template <class Fluid>
void compare_with_literature(Session<Fluid>& session) {
  const History& history = session.history();
  const Shedding found = shedding(history);
  session.result("mean_drag_coefficient", found.drag, 1.35, "-");
  session.result("strouhal_number", found.strouhal, 0.165, "-");
  session.result("lift_amplitude", found.lift, std::nullopt, "-");
  session.result("periods", found.periods, std::nullopt, "-");
  const double until = history.time().back();
  const auto level = [&](double value, const char* label) {
    Curve curve;
    curve.label = label;
    curve.x = {0, until};
    curve.y = {value, value};
    curve.reference = true;
    return curve;
  };
  Panel drag, lift;
  drag.title = "drag, mean " + format_number(found.drag, 4);
  drag.x_label = lift.x_label = "t U / D [-]";
  drag.y_label = "drag coefficient [-]";
  drag.y_range = Range{1, 1.8};
  drag.curves = {history.curve("drag_coefficient", "sphmbs"), level(1.33, "literature"),
                 level(1.37, "")};
  lift.title = "lift, Strouhal number " + format_number(found.strouhal, 4);
  lift.y_label = "lift coefficient [-]";
  lift.y_range = Range{-0.6, 0.6};
  lift.curves = {history.curve("lift_coefficient", "sphmbs")};
  session.curves("history",
                 "cylinder_wake, spacing D / " + format_number(1 / session.settings().spacing, 4),
                 {drag, lift}, 2);
}

/// Picture of the vorticity of the gas, from the slopes of the scheme where it has them.
template <class Fluid>
void draw_vorticity(Session<Fluid>& session) {
  if constexpr (Fluid::SchemeType::Reconstruction::slopes) {
    using Policy = typename Fluid::PolicyType;
    Fluid& fluid = session.system();
    const std::size_t n = fluid.size();
    const auto fields = fluid.particles().fields();
    const auto set = download<Policy>(fields.set, n);
    const auto all_x = download<Policy>(fields.r[0], n);
    const auto all_y = download<Policy>(fields.r[1], n);
    const auto slopes = download<Policy>(fluid.vicinities(), n * particles::slopes_size<2>);
    std::vector<double> x, y, vorticity;
    for (std::size_t i = 0; i < n; ++i) {
      if (set[i] != particles::gas) continue;
      const auto s = particles::load_vicinity<2>(slopes.data(), i).slopes;
      x.push_back(all_x[i]);
      y.push_back(all_y[i]);
      vorticity.push_back(s.v[1][0] - s.v[0][1]);
    }
    ImageOptions options;
    options.title = session.title() + ", t = " + format_number(fluid.time(), 4) + " s";
    options.bar_label = "vorticity [1/s]";
    options.value_range = Range{-2, 2};
    options.y_range = Range{-6, 6};
    session.picture("vorticity.png", [&](const std::filesystem::path& path) {
      draw_particles(path, {x, y, vorticity, 1.5 * session.settings().spacing}, options);
    });
  }
}

}  // namespace sphmbs::examples
