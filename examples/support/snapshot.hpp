// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sphmbs/io/vtp.hpp>
#include <sphmbs/particles/particles.hpp>

#include "support/pictures.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {

/// A device field, on the host.
template <class Policy, class T>
std::vector<T> download(const T* field, std::size_t n) {
  std::vector<T> host(n);
  Policy::download(host.data(), field, n * sizeof(T));
  return host;
}

/// Pressure of all particles [Pa].
template <class Fluid>
std::vector<float> pressures(Fluid& fluid) {
  using Policy = typename Fluid::PolicyType;
  const auto fields = fluid.particles().fields();
  const auto rho = download<Policy>(fields.rho, fluid.size());
  const auto e = download<Policy>(fields.e, fluid.size());
  std::vector<float> p(fluid.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = static_cast<float>(fluid.scheme().eos.pressure(rho[i], e[i]));
  return p;
}

/// Density, pressure, velocity, ... of all particles at the beginning of a step into a VTP file, in
/// single precision.
/// @throws OutputError with path and reason.
template <class Fluid>
void write_snapshot(const std::filesystem::path& path, Fluid& fluid) {
  constexpr int dim = Fluid::dim;
  using Policy = typename Fluid::PolicyType;
  const std::size_t n = fluid.size();
  const auto fields = fluid.particles().fields();
  const auto vectors = [&](auto* const(&components)[dim]) {
    std::vector<float> xyz(3 * n);
    for (int k = 0; k < dim; ++k) {
      const auto x = download<Policy>(components[k], n);
      for (std::size_t i = 0; i < n; ++i)
        xyz[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(x[i]);
    }
    return xyz;
  };
  const auto scalars = [&](const auto* field) {
    const auto x = download<Policy>(field, n);
    return std::vector<float>(x.begin(), x.end());
  };
  std::vector<io::PointArray> arrays;
  arrays.push_back({"velocity [m/s]", 3, vectors(fields.v)});
  arrays.push_back({"density [kg/m3]", 1, scalars(fields.rho)});
  arrays.push_back({"pressure [Pa]", 1, pressures(fluid)});
  arrays.push_back({"smoothing length [m]", 1, scalars(fields.h)});
  arrays.push_back({"set", 1, download<Policy>(fields.set, n)});
  const auto id = download<Policy>(fields.id, n);
  arrays.push_back({"id", 1, std::vector<std::int32_t>(id.begin(), id.end())});
  io::write_vtp(path, vectors(fields.r), arrays, fluid.time());
}

/// Pictures of speed, pressure and density of plane gas: speed_<number>.png and so on.
/// @throws OutputError with path and reason.
template <class Fluid>
void draw_snapshot(const std::filesystem::path& folder, Fluid& fluid, const std::string& title,
                   const std::string& number) {
  using Policy = typename Fluid::PolicyType;
  const auto fields = fluid.particles().fields();
  const std::size_t n = fluid.size();
  const auto set = download<Policy>(fields.set, n);
  const auto of_gas = [&](const auto& all) {
    std::vector<double> chosen;
    chosen.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
      if (set[i] == particles::gas) chosen.push_back(static_cast<double>(all[i]));
    return chosen;
  };
  const auto x = of_gas(download<Policy>(fields.r[0], n));
  const auto y = of_gas(download<Policy>(fields.r[1], n));
  double diameter = 0;
  for (const double h : of_gas(download<Policy>(fields.h, n))) diameter += h;
  // Discs overlap, so that no gaps show where the gas is stretched.
  diameter *= 1.2 / static_cast<double>(std::max<std::size_t>(1, x.size()));
  const auto draw = [&](const std::string& name, const std::vector<double>& value,
                        const std::string& label) {
    ImageOptions options;
    options.title = title + ", t = " + format_number(fluid.time(), 4) + " s";
    options.bar_label = label;
    draw_particles(folder / (name + "_" + number + ".png"), {x, y, value, diameter}, options);
  };
  std::vector<double> speed = of_gas(download<Policy>(fields.v[0], n));
  const std::vector<double> across = of_gas(download<Policy>(fields.v[1], n));
  for (std::size_t i = 0; i < speed.size(); ++i) speed[i] = std::hypot(speed[i], across[i]);
  draw("speed", speed, "|v| [m/s]");
  draw("pressure", of_gas(pressures(fluid)), "p [Pa]");
  draw("density", of_gas(download<Policy>(fields.rho, n)), "density [kg/m³]");
}

}  // namespace sphmbs::examples
