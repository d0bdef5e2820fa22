// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/expects.hpp>
#include <sphmbs/eos/equation_of_state.hpp>

namespace sphmbs::eos {

/// Stiffened gas, p = (gamma - 1) rho e - gamma p_inf (Harlow and Amsden 1971): a compressible
/// liquid or a dense gas. With p_inf = 0 it is the ideal gas.
struct StiffenedGas {
  double gamma = 4.4;             ///< [-]
  double stiffness = 6e8;         ///< p_inf [Pa]
  double heat_capacity_v = 1816;  ///< at constant volume [J/(kg K)]

  /// p = (gamma - 1) rho e - gamma p_inf [Pa].
  template <class N>
  SPHMBS_INLINE N pressure(N rho, N e) const {
    return N(static_cast<Scalar<N>>(gamma - 1)) * rho * e -
           N(static_cast<Scalar<N>>(gamma * stiffness));
  }

  /// Inverse of `pressure` [J/kg].
  template <class N>
  SPHMBS_INLINE N internal_energy(N rho, N p) const {
    return (p + N(static_cast<Scalar<N>>(gamma * stiffness))) /
           (N(static_cast<Scalar<N>>(gamma - 1)) * rho);
  }

  /// c = sqrt(gamma (p + p_inf) / rho).
  template <class N>
  SPHMBS_INLINE N sound_speed(N rho, N p) const {
    return math::sqrt(N(static_cast<Scalar<N>>(gamma)) *
                      (p + N(static_cast<Scalar<N>>(stiffness))) / rho);
  }

  /// T = (p + p_inf) / ((gamma - 1) c_v rho).
  template <class N>
  SPHMBS_INLINE N temperature(N rho, N p) const {
    return (p + N(static_cast<Scalar<N>>(stiffness))) /
           (N(static_cast<Scalar<N>>((gamma - 1) * heat_capacity_v)) * rho);
  }

  /// Heat capacity at constant pressure [J/(kg K)].
  double heat_capacity() const { return gamma * heat_capacity_v; }

  /// Heat capacity at constant volume [J/(kg K)].
  SPHMBS_INLINE double isochoric_heat_capacity() const { return heat_capacity_v; }

  /// @throws InvalidInput unless gamma > 1, p_inf >= 0 and the heat capacity is positive.
  void check() const {
    expects(gamma > 1, "gamma", gamma, "above 1");
    expects(stiffness >= 0, "stiffness", stiffness, "zero or positive [Pa]");
    expects(heat_capacity_v > 0, "heat_capacity_v", heat_capacity_v, "positive [J/(kg K)]");
  }
};

static_assert(EquationOfState<StiffenedGas>);

}  // namespace sphmbs::eos
