// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/kernels/kernel.hpp>

namespace sphmbs::kernels {

/// Quintic spline, eq. (10), support 3 h.
///
/// The constants follow from the integral of W being 1. The paper prints 120/h in one dimension (a
/// misprint of 1/(120 h)) and 3/(359 pi h^3) in three, which is 0.28 % too large.
template <int Dim>
struct QuinticSpline {
  static constexpr int dim = Dim;       ///< dimension of space
  static constexpr double support = 3;  ///< support radius over h [-]
  /// Makes the integral over space 1 [-].
  static constexpr double normalisation = Dim == 1   ? 1.0 / 120
                                          : Dim == 2 ? 7 / (478 * math::pi)
                                                     : 1 / (120 * math::pi);

  /// W without normalisation as a function of R = r / h, see `Kernel`.
  template <class N>
  static SPHMBS_INLINE N shape(N R) {
    const N a = math::max(N(3) - R, N(0));
    const N b = math::max(N(2) - R, N(0));
    const N c = math::max(N(1) - R, N(0));
    return math::power<5>(a) - N(6) * math::power<5>(b) + N(15) * math::power<5>(c);
  }

  /// Derivative of `shape` by R, never positive.
  template <class N>
  static SPHMBS_INLINE N slope(N R) {
    const N a = math::max(N(3) - R, N(0));
    const N b = math::max(N(2) - R, N(0));
    const N c = math::max(N(1) - R, N(0));
    return N(-5) * (math::power<4>(a) - N(6) * math::power<4>(b) + N(15) * math::power<4>(c));
  }
};

static_assert(Kernel<QuinticSpline<1>> && Kernel<QuinticSpline<2>> && Kernel<QuinticSpline<3>>);

}  // namespace sphmbs::kernels
