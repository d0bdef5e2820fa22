// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/particles/record.hpp>
#include <sphmbs/particles/slopes.hpp>
#include <sphmbs/riemann/riemann_solver.hpp>

/// Walls and bodies as gas sees them: virtual particles, sect. 3.2.
namespace sphmbs::boundary {

/// A gas particle and a virtual particle, seen from the gas.
template <int Dim, class N>
struct Meeting {
  particles::Record<Dim, N> gas;     ///< the gas particle
  particles::Slopes<Dim, N> slopes;  ///< of the gas
  Vec<Dim, N> wall_velocity;         ///< of the surface in front of the virtual particle [m/s]
  Vec<Dim, N> d;                     ///< way from the gas to the virtual particle [m]
  Vec<Dim, N> normal;                ///< of the surface, from the gas into the solid [-]
  N depth;                           ///< of the virtual particle below the surface [m]
};

/// What meets in the middle between them.
template <int Dim, class N>
struct Contact {
  Vec<Dim, N> v;  ///< velocity [m/s]
  N p;            ///< pressure [Pa]
  N phi;          ///< way to the middle as a share of the gas's distance from the surface [-]
};

/// A wall model says what gas meets at a virtual particle. There are two kinds:
///
/// - `facing(gas, stored)` is the far side of their Riemann problem; `stored` is the virtual
///   particle's own state, its u the velocity of the wall. `evolves` says whether virtual particles
///   carry a density and an energy that follow eqs. (20) and (22).
/// - with `surfaces`, `contact(meeting)` is the solution itself, from the gas's slopes and the true
///   surface; the virtual particles must have been added with their solid.
///
/// `slips` says whether gas slides along the surface without friction, which only walls of the
/// second kind know. All must also accept packs.
template <class W>
concept WallModel = std::is_trivially_copyable_v<W> && requires(const W wall) {
  { W::evolves } -> std::convertible_to<bool>;
  { W::surfaces } -> std::convertible_to<bool>;
  { W::slips } -> std::convertible_to<bool>;
  wall.check();
} &&(
    requires(const W wall, riemann::State<double> gas, riemann::State<double> stored) {
      { wall.facing(gas, stored) } -> std::same_as<riemann::State<double>>;
    } ||
    requires(const W wall, Meeting<2, double> meeting) {
      { wall.contact(meeting) } -> std::same_as<Contact<2, double>>;
      { wall.isothermal } -> std::convertible_to<bool>;
    });

}  // namespace sphmbs::boundary
