// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/math.hpp>

/// Equations of state.
namespace sphmbs::eos {

/// What an equation of state offers; all functions must also accept packs. A state is admissible
/// where the density is positive and the sound speed a positive number.
template <class E>
concept EquationOfState = std::is_trivially_copyable_v<E> &&
    requires(const E eos, double rho, double e, double p) {
  { eos.pressure(rho, e) } -> std::same_as<double>;         // [Pa]
  { eos.internal_energy(rho, p) } -> std::same_as<double>;  // [J/kg]
  { eos.sound_speed(rho, p) } -> std::same_as<double>;      // [m/s]
  { eos.temperature(rho, p) } -> std::same_as<double>;      // [K]
  eos.check();  // throws InvalidInput where a parameter is out of range
};

}  // namespace sphmbs::eos
