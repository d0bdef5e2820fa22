// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/clouds.hpp"
#include "support/rates.hpp"

/// Small gases of all kinds, at time 0.
namespace test {

/// What is simulated: particles, where, by which equations.
template <class SchemeType, class MotionType = sphmbs::boundary::Fixed>
struct Setup {
  using Scheme = SchemeType;
  using Motion = MotionType;
  Scheme scheme{};
  sphmbs::geometry::Domain<Scheme::dim> domain;
  sphmbs::particles::Cloud<Scheme::dim> cloud;
  Motion motion{};

  template <class Policy>
  sphmbs::sph::Fluid<Scheme, Policy, Motion> fluid() const {
    return {scheme, domain, cloud, motion};
  }
};

/// A periodic cube of disordered gas.
template <class Scheme>
Setup<Scheme> cube_setup(int per_side) {
  constexpr int dim = Scheme::dim;
  return {{}, cube<dim>(per_side * 0.1, true), disordered_cloud<dim>(per_side, 0.1, 7)};
}

struct Channel {
  double distance(sphmbs::Vec<2> x) const { return std::min(x[1] - 0.6, 2.4 - x[1]); }
};

/// Gas between walls and around a thin plate, under a body force.
template <class Scheme>
Setup<Scheme> channel_setup() {
  Setup<Scheme> setup;
  setup.domain = cube<2>(3, true);
  setup.domain.periodic[1] = false;
  std::vector<sphmbs::Vec<2>> gas, wall, plate;
  for (const auto& x : cell_centres<2>(30, 0.1)) {
    const bool on_plate = std::abs(x[1] - 1.55) < 0.01 && x[0] > 0.9 && x[0] < 2.1;
    (x[1] < 0.6 || x[1] > 2.4 ? wall : on_plate ? plate : gas).push_back(x);
  }
  const auto air = still_air<2>();
  setup.cloud.add_gas(gas, air, {.spacing = 0.1});
  disturb(setup.cloud, 0.1, 5, {.place = 0.1, .speed = 10, .density = 0.05, .pressure = 0.05});
  setup.cloud.add_virtual(wall, air, {.spacing = 0.1}, Channel{});
  setup.cloud.add_sheet(plate, std::vector<sphmbs::Vec<2>>(plate.size(), sphmbs::Vec<2>{0, 1}), air,
                        {.spacing = 0.1});
  setup.scheme.acceleration = {100, 0};
  return setup;
}

/// Gas that comes in at one end and goes out at the other.
inline Setup<sphmbs::sph::SmoothScheme<2>> stream_setup() {
  Setup<sphmbs::sph::SmoothScheme<2>> setup;
  const double dx = 0.1;
  const sphmbs::particles::State<2> far{.rho = 1.2, .p = 1e5, .v = {100, 0}};
  const sphmbs::geometry::Box<2> inside{{0, 0}, {4, 1.2}};
  setup.domain = {{{-1, 0}, {5, 1.2}}, {false, true}};
  const sphmbs::geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
  setup.cloud.add_gas(lattice.inner_points(inside, setup.domain), far, {dx});
  const auto open = [&](double from, double to, int side) {
    const sphmbs::geometry::Box<2> zone{{from, 0}, {to, 1.2}};
    setup.cloud.add_opening({.lower = zone.lower,
                             .upper = zone.upper,
                             .axis = 0,
                             .side = side,
                             .far = far,
                             .distance = 4},
                            lattice.inner_points(zone, setup.domain), {dx});
  };
  open(-0.8, 0, 1);
  open(4, 4.8, -1);
  return setup;
}

/// Gas in a cavity whose walls close in.
inline Setup<Gas<2>, sphmbs::boundary::Contraction> cavity_setup() {
  Setup<Gas<2>, sphmbs::boundary::Contraction> setup;
  setup.motion = {.length = 2, .speed = 10};
  setup.domain = {{{-3, -3}, {3, 3}}, {false, false}};
  const sphmbs::geometry::Lattice<2> lattice{.spacing = 0.1, .origin = {0.05, 0.05}};
  const sphmbs::geometry::Box<2> inside{{-1, -1}, {1, 1}};
  const sphmbs::particles::State<2> air = still_air<2>();
  setup.cloud.add_gas(lattice.inner_points(inside, setup.domain), air, {0.1});
  setup.cloud.add_virtual(lattice.inner_points(inside.grown(0.5) - inside, setup.domain, 0.6), air,
                          {0.1});
  return setup;
}

}  // namespace test
