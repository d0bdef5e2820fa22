// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/core/vec.hpp>
#include <sphmbs/eos/ideal_gas.hpp>

/// The shear stress of eq. (4) and the conduction of heat, as a policy.
namespace sphmbs::sph {

/// No stress and no conduction, as in the paper's cases.
struct Inviscid {
  static constexpr bool acts = false;  ///< whether there is any stress or conduction
  /// Largest diffusivity of momentum or heat at a density [m^2/s].
  template <class E>
  double diffusivity(const E&, double) const {
    return 0;
  }
  /// Does nothing: no parameter can be out of range.
  void check() const {}
};

/// Newtonian viscosity and Fourier conduction with constant coefficients, in a pairwise form that
/// conserves momentum and total energy to rounding (Espanol and Revenga 2003; Cleary and Monaghan
/// 1999). With F = -(dW/dr)/r and v_ab = v_a - v_b, d dimensions:
///
///   dv_a/dt += -sum m_b F / (rho_a rho_b) [(5 mu/3 - zeta) v_ab + (d + 2)(zeta + mu/3) n (n.v_ab)]
///   de_a/dt += half the work of that force, never negative, - sum m_b F / (rho_a rho_b) 2 k T_ab
///
/// in the limit of many neighbours rho dv/dt = mu lap v + (zeta + mu/3) grad div v, with the bulk
/// viscosity zeta. The paper's virtual particles act as walls of their own temperature that gas
/// sticks to. Angular momentum is conserved by the second term alone.
struct Newtonian {
  static constexpr bool acts = true;  ///< whether there is any stress or conduction
  double viscosity;                   ///< mu [Pa s]
  double conductivity = 0;            ///< k [W/(m K)]
  double bulk = 0;                    ///< zeta [Pa s]

  /// What b takes from the acceleration of a [m/s^2].
  /// @param share  m_b F / (rho_a rho_b)
  /// @param n      unit vector along the pair
  /// @param dv     v_a - v_b [m/s]
  template <int Dim, class N>
  SPHMBS_INLINE Vec<Dim, N> drag(N share, const Vec<Dim, N>& n, const Vec<Dim, N>& dv) const {
    using T = Scalar<N>;
    const N shear = N(static_cast<T>(5 * viscosity / 3 - bulk));
    const N along = N(static_cast<T>((Dim + 2) * (bulk + viscosity / 3)));
    return share * (shear * dv + (along * dot(n, dv)) * n);
  }

  /// Heat that a gives to b, by its mass, for the difference of temperatures T_a - T_b [W/kg].
  template <class N>
  SPHMBS_INLINE N conduction(N share, N dT) const {
    return share * N(static_cast<Scalar<N>>(2 * conductivity)) * dT;
  }

  /// Largest diffusivity of momentum or heat at a density [m^2/s].
  template <eos::EquationOfState E>
  SPHMBS_INLINE double diffusivity(const E& eos, double rho) const {
    const double momentum = 4 * viscosity / 3 + bulk;
    const double heat = conductivity / eos.isochoric_heat_capacity();
    return (momentum > heat ? momentum : heat) / rho;
  }

  /// @throws InvalidInput for a negative coefficient, or zeta > 5 mu / 3, which would not dissipate
  ///         in every pair.
  void check() const {
    expects(viscosity >= 0, "viscosity", viscosity, "zero or positive [Pa s]");
    expects(conductivity >= 0, "conductivity", conductivity, "zero or positive [W/(m K)]");
    expects(bulk >= 0 && bulk <= 5 * viscosity / 3, "bulk viscosity", bulk,
            "between 0 and 5/3 of the viscosity [Pa s]");
  }
};

/// What a transport policy offers.
template <class S>
concept StressModel = std::is_trivially_copyable_v<S> &&
    requires(const S stress, const eos::IdealGas gas, double rho) {
  { S::acts } -> std::convertible_to<bool>;
  { stress.diffusivity(gas, rho) } -> std::same_as<double>;
  stress.check();
};

static_assert(StressModel<Inviscid> && StressModel<Newtonian>);

}  // namespace sphmbs::sph
