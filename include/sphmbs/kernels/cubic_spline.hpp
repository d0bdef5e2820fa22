// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/kernels/kernel.hpp>

namespace sphmbs::kernels {

/// Cubic spline M4 (Monaghan and Lattanzio 1985), support 2 h.
template <int Dim>
struct CubicSpline {
  static constexpr int dim = Dim;       ///< dimension of space
  static constexpr double support = 2;  ///< support radius over h [-]
  /// Makes the integral over space 1 [-].
  static constexpr double normalisation = Dim == 1   ? 2.0 / 3
                                          : Dim == 2 ? 10 / (7 * math::pi)
                                                     : 1 / math::pi;

  /// W without normalisation as a function of R = r / h, see `Kernel`.
  template <class N>
  static SPHMBS_INLINE N shape(N R) {
    const N a = math::max(N(2) - R, N(0));
    const N b = math::max(N(1) - R, N(0));
    return N(0.25) * math::power<3>(a) - math::power<3>(b);
  }

  /// Derivative of `shape` by R, never positive.
  template <class N>
  static SPHMBS_INLINE N slope(N R) {
    const N a = math::max(N(2) - R, N(0));
    const N b = math::max(N(1) - R, N(0));
    return N(3) * math::power<2>(b) - N(0.75) * math::power<2>(a);
  }
};

static_assert(Kernel<CubicSpline<1>> && Kernel<CubicSpline<2>> && Kernel<CubicSpline<3>>);

}  // namespace sphmbs::kernels
