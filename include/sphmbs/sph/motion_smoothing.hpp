// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/expects.hpp>

/// How particles move with their gas, as a policy. Only positions feel it: mass, momentum and
/// energy are conserved whatever it does, angular momentum is not.
namespace sphmbs::sph {

/// XSPH, eq. (14): particles move with a velocity smoothed over their neighbours,
/// dr_a/dt = v_a - zeta sum m_b / rho_ab v_ab W, rho_ab the mean density.
struct Xsph {
  static constexpr bool acts = true;     ///< whether neighbours change how a particle moves
  static constexpr bool shifts = false;  ///< whether particles drift to where they are sparse
  double zeta = 0.5;                     ///< as in the paper [-]

  /// @throws InvalidInput unless zeta lies between 0 and 1.
  void check() const { expects(zeta >= 0 && zeta <= 1, "XSPH zeta", zeta, "between 0 and 1"); }
};

/// Particles move with their own velocity.
struct NoXsph {
  static constexpr bool acts = false;    ///< whether neighbours change how a particle moves
  static constexpr bool shifts = false;  ///< whether particles drift to where they are sparse
  static constexpr double zeta = 0;      ///< of XSPH [-]
  /// Does nothing: no parameter can be out of range.
  void check() const {}
};

/// XSPH, and on top of it a drift from where particles crowd to where they are sparse, which keeps
/// their arrangement regular in long runs and at low pressure (Lind et al. 2012; Oger et al. 2016):
///
///   dr_a/dt += -strength c_a h_a sum V_b grad W, at most `limit` times the root mean square of
///   the neighbours' velocities relative to v_a
///
/// Fields are carried along and not corrected: in the frame of the gas they move with that drift,
/// an error of the drift times their gradient, which vanishes with the disorder.
struct Shifting {
  static constexpr bool acts = true;    ///< whether neighbours change how a particle moves
  static constexpr bool shifts = true;  ///< whether particles drift to where they are sparse
  double strength = 0.5;                ///< [-]
  double limit = 1;                     ///< [-]
  double zeta = 0.5;                    ///< of XSPH [-]

  /// @throws InvalidInput for a negative strength or limit, or zeta outside 0 to 1.
  void check() const {
    expects(zeta >= 0 && zeta <= 1, "XSPH zeta", zeta, "between 0 and 1");
    expects(strength >= 0, "strength of shifting", strength, "zero or positive");
    expects(limit >= 0, "limit of shifting", limit, "zero or positive");
  }
};

/// What a smoothing of the motion offers.
template <class X>
concept MotionSmoothing = std::is_trivially_copyable_v<X> && requires(const X motion) {
  { X::acts } -> std::convertible_to<bool>;
  { X::shifts } -> std::convertible_to<bool>;
  { motion.zeta } -> std::convertible_to<double>;
  motion.check();
};

static_assert(MotionSmoothing<Xsph> && MotionSmoothing<NoXsph> && MotionSmoothing<Shifting>);

}  // namespace sphmbs::sph
