// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/io/structure_mesh.hpp>
#include <sphmbs/io/vtp.hpp>

#include "support/snapshot.hpp"

namespace sphmbs::examples {

/// The particles with the given ids and those within three supports of them, all fields and rates,
/// into a VTP file. Periodic images are left out.
/// @return whether any was found; else there is no file
/// @throws OutputError with path and reason.
template <class Fluid>
bool write_culprits(const std::filesystem::path& path, Fluid& fluid,
                    const std::vector<std::uint32_t>& culprits) {
  constexpr int dim = Fluid::dim;
  using Policy = typename Fluid::PolicyType;
  const std::size_t n = fluid.size();
  const auto fields = fluid.particles().fields();
  const auto rates = fluid.particles().rates();
  const auto id = download<Policy>(fields.id, n);
  const auto h = download<Policy>(fields.h, n);
  std::array<std::vector<double>, static_cast<std::size_t>(dim)> r;
  for (int k = 0; k < dim; ++k) {
    const auto x = download<Policy>(fields.r[k], n);
    r[static_cast<std::size_t>(k)].assign(x.begin(), x.end());
  }
  std::vector<std::int32_t> is_culprit(n);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < n; ++i)
    is_culprit[i] = std::find(culprits.begin(), culprits.end(), id[i]) != culprits.end() ? 1 : 0;
  const auto near = [&](std::size_t i, std::size_t c) {
    double square = 0;
    for (const auto& x : r) square += (x[i] - x[c]) * (x[i] - x[c]);
    const double reach = 3 * Fluid::SchemeType::Kernel::support * static_cast<double>(h[c]);
    return square <= reach * reach;
  };
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < n; ++i)
    if (is_culprit[i] != 0) found.push_back(i);
  for (std::size_t i = 0; i < n; ++i)
    if (std::any_of(found.begin(), found.end(), [&](std::size_t c) { return near(i, c); }))
      chosen.push_back(i);
  if (chosen.empty()) return false;

  const auto pick = [&]<class T>(const std::vector<T>& all) {
    std::vector<T> some;
    for (const std::size_t i : chosen) some.push_back(all[i]);
    return some;
  };
  std::vector<io::PointArray> arrays;
  const auto scalar = [&](const char* name, const auto* field) {
    const auto x = download<Policy>(field, n);
    arrays.push_back({name, 1, pick(std::vector<float>(x.begin(), x.end()))});
  };
  const auto vectors = [&](auto* const(&components)[dim]) {
    std::vector<float> xyz(3 * chosen.size());
    for (int k = 0; k < dim; ++k) {
      const auto x = pick(download<Policy>(components[k], n));
      for (std::size_t i = 0; i < x.size(); ++i)
        xyz[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(x[i]);
    }
    return xyz;
  };
  arrays.push_back({"velocity [m/s]", 3, vectors(fields.v)});
  arrays.push_back({"acceleration [m/s2]", 3, vectors(rates.v)});
  scalar("density [kg/m3]", fields.rho);
  scalar("energy [J/kg]", fields.e);
  scalar("smoothing length [m]", fields.h);
  scalar("mass [kg]", fields.m);
  scalar("rate of density [kg/m3/s]", rates.rho);
  scalar("rate of energy [W/kg]", rates.e);
  scalar("neighbours", rates.pairs);
  arrays.push_back({"pressure [Pa]", 1, pick(pressures(fluid))});
  arrays.push_back({"set", 1, pick(download<Policy>(fields.set, n))});
  arrays.push_back({"id", 1, pick(std::vector<std::int32_t>(id.begin(), id.end()))});
  arrays.push_back({"culprit", 1, pick(is_culprit)});
  io::write_vtp(path, vectors(fields.r), arrays, fluid.time());
  return true;
}

/// What a failed run leaves behind, to be looked at: <folder>/culprits.vtp with the particles that
/// the failure names and those around them, and <folder>/bodies.vtp, of whatever there is in the
/// system, a gas, a structure or both. Fields are those at the beginning of the step, rates those
/// of its last stage.
/// @return the files
/// @throws OutputError with path and reason.
template <class System>
std::vector<std::filesystem::path> write_crash_report(const std::filesystem::path& folder,
                                                      System& system,
                                                      const NumericalFailure& failure) {
  std::error_code ignored;  // a folder that is missing shows when files are written
  std::filesystem::create_directories(folder, ignored);
  std::vector<std::filesystem::path> files;
  const auto gas = [&](auto& fluid) {
    const auto path = folder / "culprits.vtp";
    if (write_culprits(path, fluid, failure.particles)) files.push_back(path);
  };
  if constexpr (requires { system.fluid().particles(); })
    gas(system.fluid());
  else if constexpr (requires { system.particles(); })
    gas(system);
  if constexpr (requires { io::structure_mesh(system.structure(), system.state()); }) {
    const auto path = folder / "bodies.vtp";
    io::write_vtp(path, io::structure_mesh(system.structure(), system.state()), system.time());
    files.push_back(path);
  }
  return files;
}

}  // namespace sphmbs::examples
