// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/cloud.hpp>

#include "support/random.hpp"

namespace test {

/// The box from 0 to `side` along every axis, periodic along all of them or none.
template <int Dim>
sphmbs::geometry::Domain<Dim> cube(double side, bool periodic) {
  sphmbs::geometry::Domain<Dim> domain{{sphmbs::Vec<Dim>::all(0.0), sphmbs::Vec<Dim>::all(side)},
                                       {}};
  domain.periodic.fill(periodic);
  return domain;
}

/// The centres of the cells of a cube of `per_side` cells along each axis.
template <int Dim>
std::vector<sphmbs::Vec<Dim>> cell_centres(int per_side, double spacing) {
  std::vector<sphmbs::Vec<Dim>> points;
  const int y_cells = Dim > 1 ? per_side : 1;
  const int z_cells = Dim > 2 ? per_side : 1;
  for (int i = 0; i < per_side; ++i)
    for (int j = 0; j < y_cells; ++j)
      for (int k = 0; k < z_cells; ++k) {
        const int cell[3] = {i, j, k};
        sphmbs::Vec<Dim> x;
        for (int axis = 0; axis < Dim; ++axis) x[axis] = (cell[axis] + 0.5) * spacing;
        points.push_back(x);
      }
  return points;
}

/// A cube of gas on a lattice, all particles alike.
template <int Dim>
sphmbs::particles::Cloud<Dim> lattice_cloud(int per_side, double spacing,
                                            const sphmbs::particles::State<Dim>& state) {
  sphmbs::particles::Cloud<Dim> cloud;
  cloud.add_gas(cell_centres<Dim>(per_side, spacing), state, {.spacing = spacing});
  return cloud;
}

/// How far the particles of a disordered cloud stray from those of a lattice.
struct Disorder {
  double place = 0.3;      // of the spacing [-]; below 0.5 all stay in their cells
  double speed = 30;       // [m/s]
  double density = 0.2;    // share [-]
  double pressure = 0.3;   // share [-]
  double smoothing = 0.2;  // share [-]
  double mass = 0.1;       // share [-]
};

/// Adds disorder to the particles from `begin` on.
template <int Dim>
void disturb(sphmbs::particles::Cloud<Dim>& cloud, double spacing, std::uint64_t seed,
             const Disorder& disorder = {}, std::size_t begin = 0) {
  Random random(seed);
  const auto about_one = [&](double share) { return 1 + random.between(-share, share); };
  for (std::size_t i = begin; i < cloud.size(); ++i) {
    cloud.r[i] += random.vector<Dim>(disorder.place * spacing);
    cloud.v[i] += random.vector<Dim>(disorder.speed);
    cloud.rho[i] *= about_one(disorder.density);
    cloud.p[i] *= about_one(disorder.pressure);
    cloud.h[i] *= about_one(disorder.smoothing);
    cloud.m[i] *= about_one(disorder.mass);
  }
}

/// Air at rest at everyday density and pressure.
template <int Dim>
constexpr sphmbs::particles::State<Dim> still_air() {
  return {.rho = 1.2, .p = 1e5, .v = {}};
}

/// A cube of air whose particles differ in everything: place, velocity, density, pressure,
/// smoothing length and mass.
template <int Dim>
sphmbs::particles::Cloud<Dim> disordered_cloud(int per_side, double spacing, std::uint64_t seed,
                                               const Disorder& disorder = {}) {
  auto cloud = lattice_cloud<Dim>(per_side, spacing, still_air<Dim>());
  disturb(cloud, spacing, seed, disorder);
  return cloud;
}

/// Particles along each side that make a cloud of some hundreds.
template <int Dim>
inline constexpr int some_hundreds = Dim == 1   ? 200
                                     : Dim == 2 ? 18
                                                : 9;

}  // namespace test
