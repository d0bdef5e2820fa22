// SPDX-License-Identifier: MIT
#pragma once

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

/// Density, pressure, speed, ... of all particles at the beginning of a step into a VTP file.
/// @throws OutputError with path and reason.
template <class Fluid>
void write_snapshot(const std::filesystem::path& path, Fluid& fluid) {
  constexpr int dim = Fluid::dim;
  using Policy = typename Fluid::PolicyType;
  const std::size_t n = fluid.size();
  const auto fields = fluid.particles().fields();
  std::vector<double> xyz(3 * n);
  std::vector<float> velocity(3 * n);
  for (int k = 0; k < dim; ++k) {
    const auto r = download<Policy>(fields.r[k], n);
    const auto v = download<Policy>(fields.v[k], n);
    for (std::size_t i = 0; i < n; ++i) {
      xyz[3 * i + static_cast<std::size_t>(k)] = static_cast<double>(r[i]);
      velocity[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(v[i]);
    }
  }
  const auto rho = download<Policy>(fields.rho, n);
  const auto e = download<Policy>(fields.e, n);
  const auto h = download<Policy>(fields.h, n);
  const auto id = download<Policy>(fields.id, n);
  std::vector<float> pressure(n);
  for (std::size_t i = 0; i < n; ++i)
    pressure[i] = static_cast<float>(fluid.scheme().eos.pressure(rho[i], e[i]));
  const auto floats = [](const auto& x) { return std::vector<float>(x.begin(), x.end()); };
  const std::vector<PointArray> arrays{
      {"velocity [m/s]", 3, std::move(velocity)},
      {"density [kg/m3]", 1, floats(rho)},
      {"pressure [Pa]", 1, std::move(pressure)},
      {"internal energy [J/kg]", 1, floats(e)},
      {"smoothing length [m]", 1, floats(h)},
      {"set", 1, download<Policy>(fields.set, n)},
      {"id", 1, std::vector<std::int32_t>(id.begin(), id.end())}};
  write_vtp(path, xyz, arrays, fluid.time());
}

/// Pictures of speed, pressure and density of plane gas: speed_<number>.png and so on.
/// @throws OutputError with path and reason.
template <class Fluid>
void draw_snapshot(const std::filesystem::path& folder, Fluid& fluid, const std::string& title,
                   const std::string& number) {
  using Policy = typename Fluid::PolicyType;
  const auto fields = fluid.particles().fields();
  const std::size_t n = fluid.size();
  const auto x = download<Policy>(fields.r[0], n);
  const auto y = download<Policy>(fields.r[1], n);
  const auto u = download<Policy>(fields.v[0], n);
  const auto v = download<Policy>(fields.v[1], n);
  const auto rho = download<Policy>(fields.rho, n);
  const auto e = download<Policy>(fields.e, n);
  const auto h = download<Policy>(fields.h, n);
  const auto set = download<Policy>(fields.set, n);
  std::vector<double> px, py, speed, pressure, density;
  double diameter = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (set[i] != particles::gas) continue;
    px.push_back(static_cast<double>(x[i]));
    py.push_back(static_cast<double>(y[i]));
    speed.push_back(std::hypot(static_cast<double>(u[i]), static_cast<double>(v[i])));
    pressure.push_back(static_cast<double>(fluid.scheme().eos.pressure(rho[i], e[i])));
    density.push_back(static_cast<double>(rho[i]));
    diameter += 1.2 * static_cast<double>(h[i]);  // overlapping, so that no gaps show
  }
  diameter /= static_cast<double>(std::max<std::size_t>(1, px.size()));
  ImageOptions options;
  const auto draw = [&](const std::string& name, const std::vector<double>& value,
                        const std::string& label) {
    options.title = title + ", t = " + format_number(fluid.time(), 4) + " s";
    options.bar_label = label;
    draw_particles(folder / (name + "_" + number + ".png"), {px, py, value, diameter}, options);
  };
  draw("speed", speed, "|v| [m/s]");
  draw("pressure", pressure, "p [Pa]");
  draw("density", density, "density [kg/m³]");
}

}  // namespace sphmbs::examples
