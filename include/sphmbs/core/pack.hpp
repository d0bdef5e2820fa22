// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <sphmbs/core/inline.hpp>

/// Packs: several numbers that host loops compute with at once. Physics is written for a number
/// type N, which is a plain floating-point number on devices and a Pack on hosts; so a pair loop is
/// vectorised by its types and not by the compiler's mood or by relaxed-math flags.
namespace sphmbs {

namespace detail {

template <class T, int W>
struct VectorOf {
  using type [[gnu::vector_size(W * sizeof(T))]] = T;
};

// The same for numbers anywhere in memory.
template <class T, int W>
struct UnalignedVectorOf {
  using type [[gnu::vector_size(W * sizeof(T)), gnu::aligned(alignof(T)), gnu::may_alias]] = T;
};

template <class T>
constexpr int vector_bytes() {
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
  return sizeof(T) == 8 ? 64 : 32;
#elif defined(__AVX__)
  return 32;
#else
  return 16;
#endif
}

}  // namespace detail

/// Number of lanes of T in the widest pack that this build's instruction set serves well. nvcc does
/// not know vector types.
template <class T>
#if defined(__CUDACC__)
inline constexpr int native_lanes = 1;
#else
inline constexpr int native_lanes = detail::vector_bytes<T>() / static_cast<int>(sizeof(T));
#endif

/// Result of comparing two packs: one truth value a lane.
template <class T, int W>
struct Mask {
  /// The compiler's vector of truth values.
  using Vector = decltype(typename detail::VectorOf<T, W>::type{} <
                          typename detail::VectorOf<T, W>::type{});
  Vector v;  ///< the lanes

  /// Lanes in which both hold.
  friend SPHMBS_INLINE Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }

  /// Bit l is the truth of lane l.
  SPHMBS_INLINE unsigned bits() const {
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
    if constexpr (W == 8 && sizeof(T) == 8) return _mm512_movepi64_mask((__m512i)v);
#endif
#if defined(__AVX__)
    if constexpr (W == 8 && sizeof(T) == 4)
      return static_cast<unsigned>(_mm256_movemask_ps((__m256)v));
    if constexpr (W == 4 && sizeof(T) == 8)
      return static_cast<unsigned>(_mm256_movemask_pd((__m256d)v));
#endif
#if defined(__SSE2__)
    if constexpr (W == 4 && sizeof(T) == 4)
      return static_cast<unsigned>(_mm_movemask_ps((__m128)v));
    if constexpr (W == 2 && sizeof(T) == 8)
      return static_cast<unsigned>(_mm_movemask_pd((__m128d)v));
#endif
    unsigned b = 0;
    for (int l = 0; l < W; ++l) {
      // In one expression, GCC 12's undefined-behaviour sanitizer reads lane l before l is set.
      const unsigned set = v[l] != 0 ? 1u : 0u;
      b |= set << l;
    }
    return b;
  }
};

/// W numbers of type T, computed with lane by lane.
template <class T, int W>
struct Pack {
  using Vector = typename detail::VectorOf<T, W>::type;  ///< the compiler's vector type
  using Scalar = T;                                      ///< type of a lane
  static constexpr int lanes = W;                        ///< numbers computed with at once
  Vector v;                                              ///< the lanes

  Pack() = default;
  /// From the compiler's vector.
  SPHMBS_INLINE Pack(Vector x) : v(x) {}
  /// The same number in every lane.
  SPHMBS_INLINE Pack(T x) : v(x - Vector{}) {}

  ///@{ Arithmetic, lane by lane.
  friend SPHMBS_INLINE Pack operator+(Pack a, Pack b) { return a.v + b.v; }
  friend SPHMBS_INLINE Pack operator-(Pack a, Pack b) { return a.v - b.v; }
  friend SPHMBS_INLINE Pack operator*(Pack a, Pack b) { return a.v * b.v; }
  friend SPHMBS_INLINE Pack operator/(Pack a, Pack b) { return a.v / b.v; }
  friend SPHMBS_INLINE Pack operator-(Pack a) { return -a.v; }
  SPHMBS_INLINE Pack& operator+=(Pack b) { return v += b.v, *this; }
  SPHMBS_INLINE Pack& operator-=(Pack b) { return v -= b.v, *this; }
  SPHMBS_INLINE Pack& operator*=(Pack b) { return v *= b.v, *this; }
  ///@}

  /// Lanes in which a is below b.
  friend SPHMBS_INLINE Mask<T, W> operator<(Pack a, Pack b) { return {a.v < b.v}; }
  /// The bits of a < b, by the instruction that yields them where there is one.
  friend SPHMBS_INLINE unsigned bits_less(Pack a, Pack b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(Vector) == 64 && sizeof(T) == 8)
      return _mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OS);
#endif
    return (a < b).bits();
  }
  /// Lanes in which a is above b.
  friend SPHMBS_INLINE Mask<T, W> operator>(Pack a, Pack b) { return {a.v > b.v}; }

  /// W consecutive numbers from memory, no alignment needed.
  static SPHMBS_INLINE Pack load(const T* p) {
    return Vector(*reinterpret_cast<const typename detail::UnalignedVectorOf<T, W>::type*>(p));
  }
};

/// Sum of the lanes in a fixed order, or the number itself.
SPHMBS_INLINE double lane_sum(double a) { return a; }
/// A number is its own sum.
SPHMBS_INLINE float lane_sum(float a) { return a; }
/// Sum over the lanes, in an order that depends on their number alone.
template <class T, int W>
SPHMBS_INLINE T lane_sum(Pack<T, W> a) {
  if constexpr (W == 8)
    return ((a.v[0] + a.v[4]) + (a.v[2] + a.v[6])) + ((a.v[1] + a.v[5]) + (a.v[3] + a.v[7]));
  T s = a.v[0];
  for (int l = 1; l < W; ++l) s += a.v[l];
  return s;
}

/// Largest of the lanes, or the number itself.
SPHMBS_INLINE double lane_max(double a) { return a; }
/// A number is its own maximum.
SPHMBS_INLINE float lane_max(float a) { return a; }
/// Largest of the lanes.
template <class T, int W>
SPHMBS_INLINE T lane_max(Pack<T, W> a) {
  T s = a.v[0];
  for (int l = 1; l < W; ++l) s = a.v[l] > s ? a.v[l] : s;
  return s;
}

namespace detail {
template <class T, int W>
struct NumberOf {
  using type = Pack<T, W>;
};
template <class T>
struct NumberOf<T, 1> {
  using type = T;
};
}  // namespace detail

/// What a loop of `lanes` lanes computes with: T itself for one lane, else a Pack.
template <class T, int lanes>
using Number = typename detail::NumberOf<T, lanes>::type;

namespace detail {
template <class N>
struct ScalarOf {
  using type = N;
};
template <class T, int W>
struct ScalarOf<Pack<T, W>> {
  using type = T;
};
}  // namespace detail

/// The plain floating-point type behind a number type.
template <class N>
using Scalar = typename detail::ScalarOf<N>::type;

namespace detail {
/// The set lanes of each pattern of W bits, first the first.
template <int W>
struct SetLanes {
  std::uint32_t lane[1 << W][W] = {};
  constexpr SetLanes() {
    for (unsigned bits = 0; bits < (1u << W); ++bits)
      for (int l = 0, n = 0; l < W; ++l)
        if ((bits >> l & 1u) != 0) lane[bits][n++] = static_cast<std::uint32_t>(l);
  }
};
template <int W>
inline constexpr SetLanes<W> set_lanes{};
}  // namespace detail

/// Appends to `out` the numbers begin + l for each lane l that is set in `bits`; returns how many.
/// `out` must have room for W entries.
template <int W>
SPHMBS_INLINE int append_set_lanes(unsigned bits, std::uint32_t begin, std::uint32_t* out) {
#if defined(__AVX512VL__)
  if constexpr (W == 8) {
    const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i index = _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(begin)));
    _mm256_storeu_si256((__m256i*)out,
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), index));
    return __builtin_popcount(bits);
  }
#endif
  if constexpr (W == 4) {
    typename detail::VectorOf<std::uint32_t, W>::type index;
    __builtin_memcpy(&index, detail::set_lanes<W>.lane[bits], sizeof index);
    index += begin;
    __builtin_memcpy(out, &index, sizeof index);
    return __builtin_popcount(bits);
  }
  int n = 0;
  for (int l = 0; l < W; ++l) {
    out[n] = begin + static_cast<std::uint32_t>(l);
    n += static_cast<int>((bits >> l) & 1u);
  }
  return n;
}

}  // namespace sphmbs
