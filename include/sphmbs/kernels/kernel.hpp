// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/math.hpp>

/// Smoothing functions W(r, h) = normalisation / h^d * shape(R), with R = r / h; zero beyond the
/// support, R >= support.
namespace sphmbs::kernels {

/// What a smoothing function offers. `shape` and `slope` must also accept a Pack: write them for
/// any number type, with math::max instead of branches. `slope` is the derivative of `shape` by R.
template <class K>
concept Kernel = std::is_trivially_copyable_v<K> && requires(double R) {
  { K::dim } -> std::convertible_to<int>;
  { K::support } -> std::convertible_to<double>;        // support radius / h [-]
  { K::normalisation } -> std::convertible_to<double>;  // makes the integral over space 1 [-]
  { K::shape(R) } -> std::same_as<double>;
  { K::slope(R) } -> std::same_as<double>;
};

/// W at distance r [1/m^dim].
/// @param r          distance [m]
/// @param inverse_h  1/h [1/m]
template <Kernel K, class N>
SPHMBS_INLINE N value(N r, N inverse_h) {
  return N(static_cast<Scalar<N>>(K::normalisation)) * math::power<K::dim>(inverse_h) *
         K::shape(r * inverse_h);
}

/// dW/dr = (1/h) dW/dR at distance r, never positive [1/m^(dim+1)].
template <Kernel K, class N>
SPHMBS_INLINE N derivative(N r, N inverse_h) {
  return N(static_cast<Scalar<N>>(K::normalisation)) * math::power<K::dim + 1>(inverse_h) *
         K::slope(r * inverse_h);
}

}  // namespace sphmbs::kernels
