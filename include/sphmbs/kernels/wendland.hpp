// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/kernels/kernel.hpp>

/// Wendland's functions with support 2 h, in the forms that Dehnen and Aly (2012, MNRAS 425, table
/// 1) give: one polynomial for one dimension, another for two and three. They resist the pairing of
/// particles at any number of neighbours. Below, q = R / 2.
namespace sphmbs::kernels {

/// Twice continuously differentiable.
template <int Dim>
struct WendlandC2 {
  static constexpr int dim = Dim;       ///< dimension of space
  static constexpr double support = 2;  ///< support radius over h [-]
  /// Makes the integral over space 1 [-].
  static constexpr double normalisation = Dim == 1   ? 5.0 / 8
                                          : Dim == 2 ? 7 / (4 * math::pi)
                                                     : 21 / (16 * math::pi);

  /// W without normalisation as a function of R = r / h, see `Kernel`.
  template <class N>
  static SPHMBS_INLINE N shape(N R) {
    const N q = N(0.5) * R;
    const N a = math::max(N(1) - q, N(0));
    if constexpr (Dim == 1)
      return math::power<3>(a) * (N(1) + N(3) * q);
    else
      return math::power<4>(a) * (N(1) + N(4) * q);
  }

  /// Derivative of `shape` by R, never positive.
  template <class N>
  static SPHMBS_INLINE N slope(N R) {
    const N q = N(0.5) * R;
    const N a = math::max(N(1) - q, N(0));
    if constexpr (Dim == 1)
      return N(-6) * q * math::power<2>(a);
    else
      return N(-10) * q * math::power<3>(a);
  }
};

/// Four times continuously differentiable.
template <int Dim>
struct WendlandC4 {
  static constexpr int dim = Dim;       ///< dimension of space
  static constexpr double support = 2;  ///< support radius over h [-]
  /// Makes the integral over space 1 [-].
  static constexpr double normalisation = Dim == 1   ? 3.0 / 4
                                          : Dim == 2 ? 9 / (4 * math::pi)
                                                     : 495 / (256 * math::pi);

  /// W without normalisation as a function of R = r / h, see `Kernel`.
  template <class N>
  static SPHMBS_INLINE N shape(N R) {
    const N q = N(0.5) * R;
    const N a = math::max(N(1) - q, N(0));
    if constexpr (Dim == 1)
      return math::power<5>(a) * (N(1) + q * (N(5) + N(8) * q));
    else
      return math::power<6>(a) * (N(1) + q * (N(6) + N(static_cast<Scalar<N>>(35.0 / 3)) * q));
  }

  /// Derivative of `shape` by R, never positive.
  template <class N>
  static SPHMBS_INLINE N slope(N R) {
    const N q = N(0.5) * R;
    const N a = math::max(N(1) - q, N(0));
    if constexpr (Dim == 1)
      return N(-7) * q * math::power<4>(a) * (N(1) + N(4) * q);
    else
      return N(static_cast<Scalar<N>>(-28.0 / 3)) * q * math::power<5>(a) * (N(1) + N(5) * q);
  }
};

/// Six times continuously differentiable.
template <int Dim>
struct WendlandC6 {
  static constexpr int dim = Dim;       ///< dimension of space
  static constexpr double support = 2;  ///< support radius over h [-]
  /// Makes the integral over space 1 [-].
  static constexpr double normalisation = Dim == 1   ? 55.0 / 64
                                          : Dim == 2 ? 78 / (28 * math::pi)
                                                     : 1365 / (512 * math::pi);

  /// W without normalisation as a function of R = r / h, see `Kernel`.
  template <class N>
  static SPHMBS_INLINE N shape(N R) {
    const N q = N(0.5) * R;
    const N a = math::max(N(1) - q, N(0));
    if constexpr (Dim == 1)
      return math::power<7>(a) * (N(1) + q * (N(7) + q * (N(19) + N(21) * q)));
    else
      return math::power<8>(a) * (N(1) + q * (N(8) + q * (N(25) + N(32) * q)));
  }

  /// Derivative of `shape` by R, never positive.
  template <class N>
  static SPHMBS_INLINE N slope(N R) {
    const N q = N(0.5) * R;
    const N a = math::max(N(1) - q, N(0));
    if constexpr (Dim == 1)
      return N(-3) * q * math::power<6>(a) * (N(3) + q * (N(18) + N(35) * q));
    else
      return N(-11) * q * math::power<7>(a) * (N(1) + q * (N(7) + N(16) * q));
  }
};

static_assert(Kernel<WendlandC2<1>> && Kernel<WendlandC4<2>> && Kernel<WendlandC6<3>>);

}  // namespace sphmbs::kernels
