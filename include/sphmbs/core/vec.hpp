// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/inline.hpp>

namespace sphmbs {

/// A small vector of Dim = 1, 2 or 3 components of number type N (a plain number or a Pack).
/// An aggregate: `Vec<2>{1.0, 2.0}`. Safe in particle loops on any device.
template <int Dim, class N = double>
struct Vec {
  static_assert(Dim >= 1 && Dim <= 3, "space has one, two or three dimensions");
  N component[Dim];  ///< along x, y, z

  /// Component along axis k = 0, 1, 2; not checked.
  SPHMBS_INLINE constexpr N& operator[](int k) { return component[k]; }
  /// Component along axis k = 0, 1, 2; not checked.
  SPHMBS_INLINE constexpr const N& operator[](int k) const { return component[k]; }

  /// The same value along every axis.
  static SPHMBS_INLINE constexpr Vec all(N value) {
    Vec a;
    a[0] = value;
    if constexpr (Dim > 1) a[1] = value;
    if constexpr (Dim > 2) a[2] = value;
    return a;
  }

  /// The vector in another number type.
  template <class M>
  SPHMBS_INLINE constexpr Vec<Dim, M> to() const {
    Vec<Dim, M> a;
    a[0] = static_cast<M>(component[0]);
    if constexpr (Dim > 1) a[1] = static_cast<M>(component[1]);
    if constexpr (Dim > 2) a[2] = static_cast<M>(component[2]);
    return a;
  }

  /// Adds b, component by component.
  template <class M>
  SPHMBS_INLINE constexpr Vec& operator+=(const Vec<Dim, M>& b) {
    component[0] += b[0];
    if constexpr (Dim > 1) component[1] += b[1];
    if constexpr (Dim > 2) component[2] += b[2];
    return *this;
  }

  /// Subtracts b, component by component.
  template <class M>
  SPHMBS_INLINE constexpr Vec& operator-=(const Vec<Dim, M>& b) {
    component[0] -= b[0];
    if constexpr (Dim > 1) component[1] -= b[1];
    if constexpr (Dim > 2) component[2] -= b[2];
    return *this;
  }

  /// Whether all components are equal.
  friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

/// Sum, in the number type that the sum of two components has.
template <int Dim, class A, class B>
SPHMBS_INLINE constexpr auto operator+(const Vec<Dim, A>& a, const Vec<Dim, B>& b) {
  Vec<Dim, decltype(a[0] + b[0])> c;
  c[0] = a[0] + b[0];
  if constexpr (Dim > 1) c[1] = a[1] + b[1];
  if constexpr (Dim > 2) c[2] = a[2] + b[2];
  return c;
}

/// Difference.
template <int Dim, class A, class B>
SPHMBS_INLINE constexpr auto operator-(const Vec<Dim, A>& a, const Vec<Dim, B>& b) {
  Vec<Dim, decltype(a[0] - b[0])> c;
  c[0] = a[0] - b[0];
  if constexpr (Dim > 1) c[1] = a[1] - b[1];
  if constexpr (Dim > 2) c[2] = a[2] - b[2];
  return c;
}

/// s times b.
template <int Dim, class A, class B>
SPHMBS_INLINE constexpr auto operator*(const A& s, const Vec<Dim, B>& b) {
  Vec<Dim, decltype(s * b[0])> c;
  c[0] = s * b[0];
  if constexpr (Dim > 1) c[1] = s * b[1];
  if constexpr (Dim > 2) c[2] = s * b[2];
  return c;
}

/// Scalar product.
template <int Dim, class A, class B>
SPHMBS_INLINE constexpr auto dot(const Vec<Dim, A>& a, const Vec<Dim, B>& b) {
  auto s = a[0] * b[0];
  if constexpr (Dim > 1) s += a[1] * b[1];
  if constexpr (Dim > 2) s += a[2] * b[2];
  return s;
}

/// Squared length.
template <int Dim, class A>
SPHMBS_INLINE constexpr A norm2(const Vec<Dim, A>& a) {
  return dot(a, a);
}

}  // namespace sphmbs
