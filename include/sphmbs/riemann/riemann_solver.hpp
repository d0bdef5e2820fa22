// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/math.hpp>

/// Solvers of the one-dimensional Riemann problem between the two particles of a pair, sect. 2.2.
namespace sphmbs::riemann {

/// One side of the problem. `u` is the velocity along the line from the left to the right particle,
/// eq. (17).
template <class N>
struct State {
  N rho;  // density [kg/m^3]
  N u;    // velocity along the pair [m/s]
  N p;    // pressure [Pa]
  N c;    // sound speed [m/s]
};

/// What meets at the contact between them: p*, eq. (16), and v*, eq. (19).
template <class N>
struct Star {
  N p;  // [Pa]
  N u;  // [m/s]
};

/// What a solver offers; `star` must also accept States of packs.
template <class R>
concept RiemannSolver = std::is_trivially_copyable_v<R> &&
    requires(const R solver, State<double> left, State<double> right) {
  { solver.star(left, right) } -> std::same_as<Star<double>>;
};

}  // namespace sphmbs::riemann
