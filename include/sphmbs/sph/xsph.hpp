// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/expects.hpp>

namespace sphmbs::sph {

/// XSPH, eq. (14): particles move with a velocity smoothed over their neighbours,
/// dr_a/dt = v_a - zeta sum m_b / rho_ab v_ab W, rho_ab the mean density. Only positions feel it.
struct Xsph {
  static constexpr bool acts = true;
  double zeta = 0.5;  // as in the paper [-]

  /// @throws InvalidInput unless zeta lies between 0 and 1.
  void check() const { expects(zeta >= 0 && zeta <= 1, "XSPH zeta", zeta, "between 0 and 1"); }
};

/// Particles move with their own velocity.
struct NoXsph {
  static constexpr bool acts = false;
  static constexpr double zeta = 0;
  void check() const {}
};

/// What a smoothing of the motion offers.
template <class X>
concept MotionSmoothing = std::is_trivially_copyable_v<X> && requires(const X xsph) {
  { X::acts } -> std::convertible_to<bool>;
  { xsph.zeta } -> std::convertible_to<double>;
  xsph.check();
};

static_assert(MotionSmoothing<Xsph> && MotionSmoothing<NoXsph>);

}  // namespace sphmbs::sph
