// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>

#include <sphmbs/core/vec.hpp>

/// Solids by signed distance, and the space they live in.
namespace sphmbs::geometry {

/// A solid: `distance` is negative inside, positive outside, zero on the surface [m]. Unions and
/// differences bound the distance from below, which is all that filling needs.
template <class S>
concept Shape = requires(const S shape, Vec<S::dim> x) {
  { S::dim } -> std::convertible_to<int>;
  { shape.distance(x) } -> std::same_as<double>;
};

/// A shape that gives the slope of its distance, a unit vector, also where its distance has a kink.
template <class S>
concept KnowsNormal = Shape<S> && requires(const S shape, Vec<S::dim> x) {
  { shape.normal(x) } -> std::same_as<Vec<S::dim>>;
};

/// Points in a or in b.
template <Shape A, Shape B>
struct Union {
  static constexpr int dim = A::dim;  ///< dimension of space
  A a;                                ///< the first solid
  B b;                                ///< the second solid
  /// Signed distance, or less [m].
  double distance(Vec<dim> x) const { return std::min(a.distance(x), b.distance(x)); }
};

/// Points in a and not in b.
template <Shape A, Shape B>
struct Difference {
  static constexpr int dim = A::dim;  ///< dimension of space
  A a;                                ///< the first solid
  B b;                                ///< the second solid
  /// Signed distance, or less [m].
  double distance(Vec<dim> x) const { return std::max(a.distance(x), -b.distance(x)); }
};

/// Points not in a: the solid around a cavity.
template <Shape A>
struct Outside {
  static constexpr int dim = A::dim;  ///< dimension of space
  A a;                                ///< the first solid
  /// Signed distance, or less [m].
  double distance(Vec<dim> x) const { return -a.distance(x); }
  /// Slope of the distance, a unit vector.
  Vec<dim> normal(Vec<dim> x) const requires KnowsNormal<A> { return -1.0 * a.normal(x); }
};

/// All points that are not in a.
template <Shape A>
Outside<A> outside(A a) {
  return {a};
}

/// Points in a or in b.
template <Shape A, Shape B>
requires(A::dim == B::dim) Union<A, B>
operator|(A a, B b) { return {a, b}; }

/// Points in a and not in b.
template <Shape A, Shape B>
requires(A::dim == B::dim) Difference<A, B>
operator-(A a, B b) { return {a, b}; }

}  // namespace sphmbs::geometry
