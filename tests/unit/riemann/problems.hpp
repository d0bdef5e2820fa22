// SPDX-License-Identifier: MIT
// Riemann problems, given and at random.
#pragma once

#include <cmath>

#include <sphmbs/riemann/exact_solution.hpp>
#include <sphmbs/riemann/riemann_solver.hpp>

#include "support/random.hpp"

namespace test {

using sphmbs::riemann::Primitive;
using sphmbs::riemann::State;

/// Two states that meet.
struct Problem {
  Primitive left;
  Primitive right;
};

/// A state with its sound speed.
template <class T = double, class Gas>
State<T> state_of(const Gas& gas, const Primitive& s) {
  return {static_cast<T>(s.rho), static_cast<T>(s.u), static_cast<T>(s.p),
          static_cast<T>(gas.sound_speed(s.rho, s.p))};
}

inline double impedance(const State<double>& s) { return s.rho * s.c; }

/// A state near that of air.
template <class Gas>
State<double> some_state(const Gas& gas, Random& random) {
  return state_of(gas, {random.between(0.5, 3), random.between(-50, 50), random.between(1e4, 2e5)});
}

inline double power_of_ten(Random& random, double from, double to) {
  return std::pow(10, random.between(from, to));
}

/// Gases at rest, their pressures apart by up to `decades` powers of ten, densities by up to two.
inline Problem some_problem_at_rest(Random& random, double decades) {
  const auto some = [&] {
    return Primitive{power_of_ten(random, -1, 1), 0,
                     power_of_ten(random, -decades / 2, decades / 2)};
  };
  return {some(), some()};
}

}  // namespace test
