// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/reconstruction/reconstruction.hpp>

namespace sphmbs::reconstruction {

/// The paper's: the two sides of a Riemann problem are the values at the two particles. Of first
/// order, with a numerical viscosity of about 0.17 c h.
struct Constant {
  static constexpr bool slopes = false;  ///< whether slopes of the gas are computed
  /// Whether slopes are limited particle by particle first.
  static constexpr bool limits_particles = false;

  /// Nothing changes from a particle to the middle of a pair.
  template <class N>
  SPHMBS_INLINE N step(N, N) const {
    return N(0);
  }
};

static_assert(Reconstruction<Constant>);

}  // namespace sphmbs::reconstruction
