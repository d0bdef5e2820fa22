// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "support/gas_session.hpp"

namespace sphmbs::examples {

/// Mean drag and frequency of a wake over the second half of a run.
struct Shedding {
  double drag;      // mean coefficient, over whole periods [-]
  double lift;      // amplitude of the coefficient at the frequency [-]
  double strouhal;  // frequency D / U [-]
};

/// From the history's drag_coefficient and lift_coefficient: the frequency, between 0.05 and 0.5,
/// at which the lift's Fourier integral with a Hann window is largest. Sound that the start leaves
/// between the cylinders thus does not count. Without two periods, frequency and lift are NaN.
inline Shedding shedding(const History& history) {
  const std::vector<double>& t = history.time();
  const std::vector<double>& drag = history.of("drag_coefficient");
  const std::vector<double>& lift = history.of("lift_coefficient");
  const double from = t.back() / 2, to = t.back();
  const auto mean = [&](const std::vector<double>& x, double begin) {
    double sum = 0, time = 0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      if (t[i - 1] < begin) continue;
      sum += 0.5 * (x[i - 1] + x[i]) * (t[i] - t[i - 1]);
      time += t[i] - t[i - 1];
    }
    return sum / time;
  };
  const double middle = mean(lift, from);
  std::vector<double> weight(t.size());
  double weights = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] < from) continue;
    weight[i] = (t[i] - t[i - 1]) * (1 - std::cos(2 * math::pi * (t[i] - from) / (to - from)));
    weights += weight[i];
  }
  Shedding found{0, 0, 0};
  for (double f = 0.05; f <= 0.5; f += 1e-4) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      if (weight[i] > 0)
        sum += weight[i] * (lift[i] - middle) * std::polar(1.0, -2 * math::pi * f * t[i]);
    if (2 * std::abs(sum) / weights > found.lift) found = {0, 2 * std::abs(sum) / weights, f};
  }
  const double periods = std::floor((to - from) * found.strouhal);
  found.drag = mean(drag, periods > 0 ? to - periods / found.strouhal : from);
  if (periods < 2) found.lift = found.strouhal = std::numeric_limits<double>::quiet_NaN();
  return found;
}

/// Drag and lift beside what is commonly found at a Reynolds number of 100 in an incompressible
/// stream without bounds: mean drag 1.33 to 1.37, Strouhal number 0.164 to 0.166 (Park, Kwon and
/// Choi 1998 among many), which needs a wake that sheds vortices.
/// @param known  whether the flow is that one
template <class Fluid>
void compare_with_literature(Session<Fluid>& session, bool known) {
  const History& history = session.history();
  const Shedding found = shedding(history);
  const auto published = [&](double value) {
    return known && std::isfinite(found.strouhal) ? std::optional(value) : std::nullopt;
  };
  session.result("mean_drag_coefficient", found.drag, published(1.35), "-");
  session.result("strouhal_number", found.strouhal, published(0.165), "-");
  session.result("lift_amplitude", found.lift, std::nullopt, "-");
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
  drag.curves = {history.curve("drag_coefficient", "sphmbs")};
  if (known) {
    drag.curves.push_back(level(1.33, "literature"));
    drag.curves.push_back(level(1.37, ""));
  }
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
    const auto slopes = download<Policy>(fluid.vicinities(),
                                         n * particles::slopes_size<2, typename Fluid::NumberType>);
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
