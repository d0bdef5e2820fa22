// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>

#include <sphmbs/mbs/ancf/pull_back.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ancf {

/// A function of a = r'.r' with its first and second derivative.
template <class S>
struct Jet {
  S value;   ///< of the function
  S first;   ///< derivative by a
  S second;  ///< derivative of that
};

/// Green's axial strain (r'.r' - 1)/2 and the geometric curvature |r' x r''|/|r'|^3: the measures
/// of Gerstmayr and Shabana 2006. Five Gauss points for both terms.
struct Green {
  static constexpr int axial_points = 5;     ///< Gauss points of the axial energy
  static constexpr int bending_points = 5;   ///< Gauss points of the bending energy
  static constexpr int curvature_power = 3;  ///< n in |r' x r''| / |r'|^n

  /// Axial strain as a function of a = r'.r'.
  template <class S>
  static Jet<S> axial(const S& a) {
    return {0.5 * (a - 1.0), S(0.5), S(0.0)};
  }
};

/// Engineering strain |r'| - 1 and the material curvature |r' x r''|/|r'|^2, the rotation of the
/// tangent per unstretched length (Gerstmayr and Irschik 2008): normal force and moment are work
/// conjugate to a geometrically exact beam without shear. Five Gauss points for the axial term and
/// three for bending, as in Exudyn.
struct Engineering {
  static constexpr int axial_points = 5;     ///< Gauss points of the axial energy
  static constexpr int bending_points = 3;   ///< Gauss points of the bending energy
  static constexpr int curvature_power = 2;  ///< n in |r' x r''| / |r'|^n

  /// Axial strain as a function of a = r'.r'.
  template <class S>
  static Jet<S> axial(const S& a) {
    using std::sqrt;
    const S norm = sqrt(a);
    return {norm - 1.0, 0.5 / norm, -0.25 / (a * norm)};
  }
};

/// How a line measures its stretch and bending.
template <class M>
concept StrainMeasure = requires(const double a) {
  { M::axial_points } -> std::convertible_to<int>;
  { M::bending_points } -> std::convertible_to<int>;
  { M::curvature_power } -> std::convertible_to<int>;
  { M::axial(a) } -> std::same_as<Jet<double>>;
};

static_assert(StrainMeasure<Green> && StrainMeasure<Engineering>);

/// A strain as a function of gradients g, with its gradient in g.
template <int n, class S>
struct Strain {
  S value;                ///< of the strain
  Vector<n, S> gradient;  ///< by the components of g
};

/// Axial strain as a function of g = r'.
template <class Measure, int Dim, class S>
Strain<Dim, S> axial_strain(const Vector<Dim, S>& g) {
  const Jet<S> e = Measure::axial(inner(g, g));
  return {e.value, 2.0 * e.first * g};
}

/// Its second derivatives.
template <class Measure, int Dim>
Matrix<Dim, Dim> axial_strain_hessian(const Vector<Dim>& g) {
  const Jet<double> e = Measure::axial(inner(g, g));
  return 2 * e.first * Matrix<Dim, Dim>::Identity() + (4 * e.second) * g * g.transpose();
}

/// Bending strain of a planar line as a function of g = (r', r''): the curvature, positive where
/// the line turns to the left.
template <class Measure, class S>
Strain<4, S> bending_strain(const Vector<4, S>& g, double /*smoothing*/) {
  using std::sqrt;
  const S a = g[0] * g[0] + g[1] * g[1];
  const S cross = g[0] * g[3] - g[1] * g[2];
  const S f = Measure::curvature_power == 2 ? 1.0 / a : 1.0 / (a * sqrt(a));
  const S fa = -static_cast<double>(Measure::curvature_power) * f / a * cross;
  return {f * cross,
          Vector<4, S>(f * g[3] + fa * g[0], -f * g[2] + fa * g[1], -f * g[1], f * g[0])};
}

/// Its second derivatives.
template <class Measure>
Matrix<4, 4> bending_strain_hessian(const Vector<4>& g, double /*smoothing*/) {
  constexpr double half = 0.5 * Measure::curvature_power;
  const Vector<2> r1 = g.head<2>(), turned(g[3], -g[2]), normal(-g[1], g[0]);
  const double a = r1.squaredNorm(), cross = r1.dot(turned);
  const double f = Measure::curvature_power == 2 ? 1 / a : 1 / (a * std::sqrt(a));
  const double fa = -2 * half * f / a, faa = 4 * half * (half + 1) * f / (a * a);
  Matrix<4, 4> h = Matrix<4, 4>::Zero();
  h.topLeftCorner<2, 2>() =
      fa * (turned * r1.transpose() + r1 * turned.transpose()) + cross * faa * r1 * r1.transpose();
  h.topLeftCorner<2, 2>().diagonal().array() += cross * fa;
  h.topRightCorner<2, 2>() = fa * r1 * normal.transpose();
  h(0, 3) += f;
  h(1, 2) -= f;
  h.bottomLeftCorner<2, 2>() = h.topRightCorner<2, 2>().transpose();
  return h;
}

/// Bending strain of a spatial line as a function of g = (r', r''): sqrt(kappa^2 + smoothing^2).
/// The curvature kappa has no derivative where the line is straight; this has, and half its square
/// has the gradient of kappa^2/2.
template <class Measure, class S>
Strain<6, S> bending_strain(const Vector<6, S>& g, double smoothing) {
  using std::sqrt;
  const auto r1 = g.template head<3>(), r2 = g.template tail<3>();
  const S a = inner(r1, r1), b = inner(r1, r2), c = inner(r2, r2);
  const S f = Measure::curvature_power == 2 ? 1.0 / (a * a) : 1.0 / (a * a * a);
  const S square = (a * c - b * b) * f;
  const S value = sqrt(square + smoothing * smoothing);
  const S k1 = (c * f - static_cast<double>(Measure::curvature_power) * square / a) / value;
  Vector<6, S> gradient;
  gradient << k1 * r1 - b * f / value * r2, (a * f / value) * r2 - b * f / value * r1;
  return {value, gradient};
}

/// Its second derivatives, by those of kappa^2 = (a c - b^2)/a^n in a = r'.r', b = r'.r'', c =
/// r''.r''.
template <class Measure, class S>
Matrix<6, 6, S> bending_strain_hessian(const Vector<6, S>& g, double smoothing) {
  constexpr double n = Measure::curvature_power;
  const Strain<6, S> strain = bending_strain<Measure>(g, smoothing);
  const Vector<3, S> r1 = g.template head<3>(), r2 = g.template tail<3>();
  const double a = r1.squaredNorm(), b = r1.dot(r2), c = r2.squaredNorm();
  const double f = Measure::curvature_power == 2 ? 1 / (a * a) : 1 / (a * a * a);
  const double square = (a * c - b * b) * f;
  const double ka = c * f - n * square / a, kb = -2 * b * f, kc = a * f;
  const double kaa = -2 * n * c * f / a + n * (n + 1) * square / (a * a);
  const double kab = 2 * n * b * f / a, kac = (1 - n) * f, kbb = -2 * f;

  Matrix<6, 6, S> h;
  h.template topLeftCorner<3, 3>() =
      r1 * (4 * kaa * r1 + 2 * kab * r2).transpose() + r2 * (2 * kab * r1 + kbb * r2).transpose();
  h.template topRightCorner<3, 3>() =
      r1 * (2 * kab * r1 + 4 * kac * r2).transpose() + (kbb * r2) * r1.transpose();
  h.template bottomRightCorner<3, 3>() = kbb * r1 * r1.transpose();
  for (int i = 0; i < 3; ++i) {
    h(i, i) += 2 * ka;
    h(i, 3 + i) += kb;
    h(3 + i, 3 + i) += 2 * kc;
  }
  h.template bottomLeftCorner<3, 3>() = h.template topRightCorner<3, 3>().transpose();
  return (0.5 * h - strain.gradient * strain.gradient.transpose()) / strain.value;
}

}  // namespace sphmbs::mbs::ancf
