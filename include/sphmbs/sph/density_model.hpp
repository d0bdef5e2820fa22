// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/expects.hpp>

/// Where the density of the gas comes from, as a policy.
namespace sphmbs::sph {

/// The paper's: eq. (20) alone, free to drift from the masses around. Best where the gas is smooth
/// and slow, since the disorder of particles leaves no trace in the pressure.
struct Integrated {
  /// Whether the density is drawn to that of the masses around.
  static constexpr bool relaxes = false;
  static constexpr double rate = 0;  ///< nothing is drawn [-]
  /// Does nothing: no parameter can be out of range.
  void check() const {}
};

/// Eq. (20), and on top a pull towards the density of the masses around,
///
///   d rho_a / dt += rate c_a / h_a (m_a sum W_ab - rho_a),
///
/// a virtual particle without a state counting as gas like a. (With m_a, not m_b, as Hu and Adams
/// 2006, for gases of different density on one lattice; particles of different mass in one gas are
/// drawn off where they meet.) Without it shocks leave a density
/// that is some percent off for ever, with it they converge; mass, momentum and energy are
/// conserved all the same. In slow gas the disorder of particles becomes noise of the pressure.
struct Relaxed {
  /// Whether the density is drawn to that of the masses around.
  static constexpr bool relaxes = true;
  double rate = 0.2;  ///< [-]

  /// @throws InvalidInput unless the rate lies between 0 and 1, beyond which steps may be unstable.
  void check() const {
    expects(rate >= 0 && rate <= 1, "rate of the density's relaxation", rate, "between 0 and 1");
  }
};

/// What a model of the density offers.
template <class D>
concept DensityModel = std::is_trivially_copyable_v<D> && requires(const D density) {
  { D::relaxes } -> std::convertible_to<bool>;
  { density.rate } -> std::convertible_to<double>;
  density.check();
};

static_assert(DensityModel<Integrated> && DensityModel<Relaxed>);

}  // namespace sphmbs::sph
