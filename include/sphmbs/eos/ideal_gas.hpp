// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/expects.hpp>
#include <sphmbs/eos/equation_of_state.hpp>

namespace sphmbs::eos {

/// Ideal gas with constant heat capacities, eqs. (5)-(7).
struct IdealGas {
  double gamma = 1.4;           ///< heat capacity ratio [-]
  double molar_mass = 0.02895;  ///< air [kg/mol]
  double gas_constant = 8.314;  ///< kappa in eq. (6) [J/(mol K)]

  /// p = (gamma - 1) rho e, eq. (5).
  template <class N>
  SPHMBS_INLINE N pressure(N rho, N e) const {
    return N(static_cast<Scalar<N>>(gamma - 1)) * rho * e;
  }

  /// Inverse of `pressure`.
  template <class N>
  SPHMBS_INLINE N internal_energy(N rho, N p) const {
    return p / (N(static_cast<Scalar<N>>(gamma - 1)) * rho);
  }

  /// c = sqrt(gamma p / rho) = sqrt(gamma (gamma - 1) e), eq. (7).
  template <class N>
  SPHMBS_INLINE N sound_speed(N rho, N p) const {
    return math::sqrt(N(static_cast<Scalar<N>>(gamma)) * p / rho);
  }

  /// T = M p / (kappa rho), from eqs. (5) and (6).
  template <class N>
  SPHMBS_INLINE N temperature(N rho, N p) const {
    return N(static_cast<Scalar<N>>(molar_mass / gas_constant)) * p / rho;
  }

  /// Heat capacity at constant pressure [J/(kg K)].
  SPHMBS_INLINE double heat_capacity() const {
    return gamma / (gamma - 1) * gas_constant / molar_mass;
  }

  /// Heat capacity at constant volume [J/(kg K)].
  SPHMBS_INLINE double isochoric_heat_capacity() const { return heat_capacity() / gamma; }

  /// @throws InvalidInput unless gamma > 1 and molar mass and gas constant are positive.
  void check() const {
    expects(gamma > 1, "gamma", gamma, "a heat capacity ratio above 1");
    expects(molar_mass > 0, "molar_mass", molar_mass, "positive [kg/mol]");
    expects(gas_constant > 0, "gas_constant", gas_constant, "positive [J/(mol K)]");
  }
};

static_assert(EquationOfState<IdealGas>);

}  // namespace sphmbs::eos
