// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/mbs/joints/frame.hpp>
#include <sphmbs/mbs/joints/relation.hpp>

namespace sphmbs::mbs::joints {

/// sin(p alpha + s q beta - phase) / p = 0 for the directions alpha and beta of two vectors of the
/// plane, as the imaginary part of a product of powers of complex numbers. It is smooth for all
/// angles, unlike angles themselves, and counts no turns: p and q are whole numbers.
struct Mesh {
  static constexpr std::string_view kind = "gear";  ///< what messages call it

  int p;            ///< whole number that multiplies alpha
  int q;            ///< whole number that multiplies beta
  int s;            ///< 1: opposite turning, -1: the same
  double phase;     ///< [rad]
  double length_a;  ///< of the first vector [m]
  double length_b;  ///< of the second vector [m]

  /// The condition, at the components x of both vectors.
  template <class S>
  Vector<1, S> operator()(const Vector<Dynamic, S>& x, const S&) const {
    const Complex<S> a = power<S>({x[0] / length_a, x[1] / length_a}, p);
    const Complex<S> b = power<S>({x[2] / length_b, x[3] * double(s) / length_b}, q);
    const Complex<S> z = product<S>(a, b);
    return Vector<1, S>(S((z.im * std::cos(phase) - z.re * std::sin(phase)) / double(p)));
  }

 private:
  template <class S>
  struct Complex {
    S re, im;
  };
  template <class S>
  static Complex<S> product(const Complex<S>& a, const Complex<S>& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  template <class S>
  static Complex<S> power(const Complex<S>& z, int n) {
    Complex<S> result = z;
    for (int k = 1; k < n; ++k) result = product<S>(result, z);
    return result;
  }
};

/// Two wheels in mesh whose centres are held by other joints: teeth_a alpha + teeth_b beta keeps
/// its value at q (one of them with its teeth inside: teeth_a alpha - teeth_b beta). 1 condition,
/// in [rad] of wheel a.
/// @param vector_a, vector_b any vectors of the wheels
/// @throws InvalidInput unless the numbers of teeth are positive and the vectors have a length.
inline Relation<Mesh> gear(const Marker<2>& vector_a, int teeth_a, const Marker<2>& vector_b,
                           int teeth_b, bool inside, const VectorXd& q,
                           std::string_view name = "") {
  const std::string title = titled(Mesh::kind, name);
  expects(teeth_a > 0, title + ": teeth of a", teeth_a, "positive");
  expects(teeth_b > 0, title + ": teeth of b", teeth_b, "positive");
  return named(title, [&]() -> Relation<Mesh> {
    const Vector<2> a = direction(vector_a, q), b = direction(vector_b, q);
    const int common = std::gcd(teeth_a, teeth_b);
    const Mesh mesh{.p = teeth_a / common,
                    .q = teeth_b / common,
                    .s = inside ? -1 : 1,
                    .phase = teeth_a / common * std::atan2(a[1], a[0]) +
                             (inside ? -1 : 1) * teeth_b / common * std::atan2(b[1], b[0]),
                    .length_a = vector_a.at(q).norm(),
                    .length_b = vector_b.at(q).norm()};
    return {name, std::vector<Marker<2>>{vector_a, vector_b}, mesh};
  });
}

}  // namespace sphmbs::mbs::joints
