// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/particles/record.hpp>

/// The shear stress of eq. (4) and the conduction of heat, as a policy.
namespace sphmbs::sph {

/// A pair as transport policies see it.
template <int Dim, class N>
struct PairGeometry {
  Vec<Dim, N> n;  // unit vector from a to b [-]
  N slope;        // -(dW/dr) / r, never negative [1/m^(Dim+2)]
};

/// What a pair gives to particle a beyond the Riemann fluxes.
template <int Dim, class N>
struct Transport {
  Vec<Dim, N> v;  // acceleration [m/s^2]
  N e;            // heating [W/kg]
};

/// No stress and no conduction, as in the paper's cases.
struct Inviscid {
  static constexpr bool acts = false;
  /// Largest diffusivity of momentum or heat at a density [m^2/s].
  template <class E>
  double diffusivity(const E&, double) const {
    return 0;
  }
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
/// viscosity zeta. Virtual particles act as no-slip walls of their own temperature. Angular
/// momentum is conserved by the second term alone.
struct Newtonian {
  static constexpr bool acts = true;
  double viscosity;         // mu [Pa s]
  double conductivity = 0;  // k [W/(m K)]
  double bulk = 0;          // zeta [Pa s]

  /// Contribution of b to a.
  template <int Dim, class N, class T, eos::EquationOfState E>
  SPHMBS_INLINE Transport<Dim, N> pair(const E& eos, const particles::Record<Dim, T>& a,
                                       const particles::Record<Dim, N>& b,
                                       const PairGeometry<Dim, N>& g) const {
    const N share = b.m * g.slope / (N(a.rho) * b.rho);
    const N shear = N(static_cast<T>(5 * viscosity / 3 - bulk));
    const N along = N(static_cast<T>((Dim + 2) * (bulk + viscosity / 3)));
    const Vec<Dim, N> dv = a.v - b.v;
    const Vec<Dim, N> drag = share * (shear * dv + (along * dot(g.n, dv)) * g.n);
    const N dT = N(eos.temperature(a.rho, a.p)) - eos.temperature(b.rho, b.p);
    return {.v = N(-1) * drag,
            .e = N(T(0.5)) * dot(drag, dv) - share * N(static_cast<T>(2 * conductivity)) * dT};
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
