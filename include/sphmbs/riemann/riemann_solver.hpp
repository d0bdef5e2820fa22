// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <limits>
#include <type_traits>

#include <sphmbs/core/math.hpp>

/// Solvers of the one-dimensional Riemann problem between the two particles of a pair, sect. 2.2.
namespace sphmbs::riemann {

/// One side of the problem. `u` is the velocity along the line from the left to the right particle,
/// eq. (17).
template <class N>
struct State {
  N rho;  ///< density [kg/m^3]
  N u;    ///< velocity along the pair [m/s]
  N p;    ///< pressure [Pa]
  N c;    ///< sound speed [m/s]
};

/// What meets at the contact between them: p*, eq. (16), and v*, eq. (19).
template <class N>
struct Star {
  N p;  ///< [Pa]
  N u;  ///< [m/s]
};

/// A gas whose heat capacity ratio is one number, as that of the ideal and the stiffened gas.
template <class E>
concept GammaLaw = requires(const E eos) {
  { eos.gamma } -> std::convertible_to<double>;
};

namespace detail {

/// What the concept of a solver is tried with: equations of state live in a room of their own.
struct SomeGas {
  double gamma;  // [-]
};

/// Keeps the denominators of gas without pressure above 0, and is too small to be felt elsewhere.
inline constexpr double tiny = 1e-30;

/// Z = rho c [kg/(m^2 s)], positive also where c = 0.
template <class N>
SPHMBS_INLINE N impedance(const State<N>& s) {
  return s.rho * math::max(s.c, N(static_cast<Scalar<N>>(tiny)));
}

/// P = rho c^2 / gamma [Pa]: p of an ideal gas, p + p_inf of a stiffened one. Vacuum has P = 0.
template <class N>
SPHMBS_INLINE N whole_pressure(const State<N>& s, double gamma) {
  return s.rho * s.c * s.c * N(static_cast<Scalar<N>>(1 / gamma));
}

/// p_inf = P - p [Pa]; 0 where it is no more than the rounding of an ideal gas's sound speed. It is
/// taken from the side of the smaller P, since the rounding of a strong side is pressure to a weak
/// one.
template <class N>
SPHMBS_INLINE N stiffness(const State<N>& left, const State<N>& right, double gamma) {
  constexpr auto rounding = 16 * std::numeric_limits<Scalar<N>>::epsilon();
  const N P_left = whole_pressure(left, gamma);
  const N P_right = whole_pressure(right, gamma);
  const auto left_is_weak = P_left < P_right;
  const N P = math::select(left_is_weak, P_left, P_right);
  const N found = P - math::select(left_is_weak, left.p, right.p);
  return math::select(found > N(rounding) * P, found, N(0));
}

}  // namespace detail

/// What a solver offers; `star` must also accept States of packs. The equation of state is the one
/// of the gas on both sides; solvers that need no more than the States ignore it. Gas without
/// pressure on both sides has a finite answer.
template <class R>
concept RiemannSolver = std::is_trivially_copyable_v<R> &&
    requires(const R solver, detail::SomeGas eos, State<double> left, State<double> right) {
  { solver.star(eos, left, right) } -> std::same_as<Star<double>>;
  solver.check();  // throws InvalidInput where a parameter is out of range
};

}  // namespace sphmbs::riemann
