// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/reconstruction/limiters.hpp>

namespace sphmbs::reconstruction {

/// Piecewise linear: density, velocity and pressure are carried to the middle of the pair along the
/// renormalised gradients of the two particles (van Leer 1979; for particles Vila 1999, Inutsuka
/// 2002), as far as a limiter allows. Exact for linear fields on any arrangement of particles.
/// A pair whose sides would not be admissible gas, or whose densities differ more than tenfold (two
/// gases meet), keeps the values at the particles, and is counted.
template <Limiter LimiterType = VanLeer>
struct Muscl {
  static constexpr bool slopes = true;  ///< whether slopes of the gas are computed
  /// Whether slopes are limited particle by particle first.
  static constexpr bool limits_particles = LimiterType::limits_particles;
  /// How slopes are limited.
  LimiterType limiter{};

  /// Half of the limited difference between the particles of a pair.
  template <class N>
  SPHMBS_INLINE N step(N projected, N jump) const {
    return N(static_cast<Scalar<N>>(0.5)) * limiter.difference(projected, jump);
  }
};

static_assert(Reconstruction<Muscl<>> && Reconstruction<Muscl<BarthJespersen>>);

}  // namespace sphmbs::reconstruction
