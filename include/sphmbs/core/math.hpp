// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

#include <sphmbs/core/pack.hpp>

/// The few functions that particle loops need, for plain numbers and packs alike. They stand in for
/// those of `<cmath>` and `<algorithm>`, which device compilers cannot call from a loop.
namespace sphmbs::math {

/// The ratio of a circle's circumference to its diameter.
inline constexpr double pi = 3.14159265358979323846;

/// The larger one; a where one of them is NaN.
template <std::floating_point T>
SPHMBS_INLINE constexpr T max(T a, T b) {
  return a < b ? b : a;
}
/// The smaller one.
template <std::floating_point T>
SPHMBS_INLINE constexpr T min(T a, T b) {
  return b < a ? b : a;
}
/// Absolute value.
template <std::floating_point T>
SPHMBS_INLINE constexpr T abs(T a) {
  return a < T(0) ? -a : a;
}
/// x where the condition holds, else y.
template <std::floating_point T>
SPHMBS_INLINE constexpr T select(bool condition, T x, T y) {
  return condition ? x : y;
}
/// Square root, NaN of a negative number.
SPHMBS_INLINE double sqrt(double a) { return __builtin_sqrt(a); }
/// Square root, NaN of a negative number.
SPHMBS_INLINE float sqrt(float a) { return __builtin_sqrtf(a); }
/// Largest whole number that is not above a.
SPHMBS_INLINE double floor(double a) { return __builtin_floor(a); }
/// Largest whole number that is not above a.
SPHMBS_INLINE float floor(float a) { return __builtin_floorf(a); }
/// x to the power y, for packs lane by lane.
SPHMBS_INLINE double pow(double x, double y) { return __builtin_pow(x, y); }
/// x to the power y.
SPHMBS_INLINE float pow(float x, float y) { return __builtin_powf(x, y); }
/// Whether the condition holds, for packs in any lane.
SPHMBS_INLINE constexpr bool any(bool condition) { return condition; }

/// The larger one, lane by lane.
template <class T, int W>
SPHMBS_INLINE Pack<T, W> max(Pack<T, W> a, Pack<T, W> b) {
  using V [[maybe_unused]] = typename Pack<T, W>::Vector;
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64 && sizeof(T) == 8)
    return (V)_mm512_maskz_max_pd(0xff, (__m512d)b.v, (__m512d)a.v);
#endif
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32 && sizeof(T) == 8)
    return (V)_mm256_max_pd((__m256d)b.v, (__m256d)a.v);
  if constexpr (sizeof(V) == 32 && sizeof(T) == 4)
    return (V)_mm256_max_ps((__m256)b.v, (__m256)a.v);
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(V) == 16 && sizeof(T) == 8) return (V)_mm_max_pd((__m128d)b.v, (__m128d)a.v);
  if constexpr (sizeof(V) == 16 && sizeof(T) == 4) return (V)_mm_max_ps((__m128)b.v, (__m128)a.v);
#endif
  return a.v < b.v ? b.v : a.v;
}
/// The smaller one, lane by lane.
template <class T, int W>
SPHMBS_INLINE Pack<T, W> min(Pack<T, W> a, Pack<T, W> b) {
  return b.v < a.v ? b.v : a.v;
}
/// Absolute value, lane by lane.
template <class T, int W>
SPHMBS_INLINE Pack<T, W> abs(Pack<T, W> a) {
  return max(a, -a);
}
/// x in the lanes where the condition holds, else y; both are computed.
template <class T, int W>
SPHMBS_INLINE Pack<T, W> select(Mask<T, W> condition, Pack<T, W> x, Pack<T, W> y) {
  return condition.v ? x.v : y.v;
}
/// Square root, lane by lane.
template <class T, int W>
SPHMBS_INLINE Pack<T, W> sqrt(Pack<T, W> a) {
  using V [[maybe_unused]] = typename Pack<T, W>::Vector;
  // The builtin on each lane would keep a branch for errno; the instruction has none.
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64 && sizeof(T) == 8)
    return (V)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.v);
#endif
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32 && sizeof(T) == 8) return (V)_mm256_sqrt_pd((__m256d)a.v);
  if constexpr (sizeof(V) == 32 && sizeof(T) == 4) return (V)_mm256_sqrt_ps((__m256)a.v);
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(V) == 16 && sizeof(T) == 8) return (V)_mm_sqrt_pd((__m128d)a.v);
  if constexpr (sizeof(V) == 16 && sizeof(T) == 4) return (V)_mm_sqrt_ps((__m128)a.v);
#endif
  for (int l = 0; l < W; ++l) a.v[l] = sqrt(a.v[l]);
  return a;
}
/// x to the power y, lane by lane: not vectorised.
template <class T, int W>
SPHMBS_INLINE Pack<T, W> pow(Pack<T, W> x, Pack<T, W> y) {
  for (int l = 0; l < W; ++l) x.v[l] = pow(x.v[l], y.v[l]);
  return x;
}
/// Whether the condition holds in any lane.
template <class T, int W>
SPHMBS_INLINE bool any(Mask<T, W> condition) {
  return condition.bits() != 0;
}

/// a to a small whole power, n >= 0.
template <int n, class N>
SPHMBS_INLINE constexpr N power(N a) {
  if constexpr (n == 0) {
    return N(1);
  } else if constexpr (n % 2 == 0) {
    const N half = power<n / 2>(a);
    return half * half;
  } else {
    return a * power<n - 1>(a);
  }
}

}  // namespace sphmbs::math
