// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>
#include <type_traits>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ancf/pull_back.hpp>
#include <sphmbs/mbs/ancf/quadrature.hpp>
#include <sphmbs/mbs/ancf/section.hpp>
#include <sphmbs/mbs/ancf/shape_functions.hpp>
#include <sphmbs/mbs/ancf/strain_measures.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ancf {

/// Gradient-deficient ANCF cable: a line that stretches and bends, without shear and torsion
/// (Gerstmayr and Shabana 2006, Nonlinear Dynamics 45). Coordinates r, r' at either end, cubic
/// between; material coordinate x, the arc coordinate of the unstretched cable from 0 to length.
///
///   U = 1/2 integral of EA eps^2 + EI kappa^2 dx,   eps and kappa as Measure says
///
/// Internal damping is of Kelvin and Voigt's kind: stress = E (strain + damping * strain rate), for
/// eps and kappa alike. A line does not know how its sections spin about it, so in 3D it is the
/// rate of the magnitude of the curvature that is damped: a bent cable that turns as a whole, or
/// whirls without unbending, loses nothing. That magnitude is smoothed where the cable is
/// straighter than a strain of 1e-6 in fibres one radius of gyration off the axis: such bends are
/// not damped.
///
/// Neighbours share r', so a line of elements has no kinks. Thin elements lock mildly: both terms
/// of U take the same cubic, which does not bend without some stretch. A cantilever of length L
/// bent by 1 rad deflects too little by 0.04 % (EA L^2/(EI) = 1e3), 0.8 % (1e5) and 1.4 % (1e7)
/// with 4 elements, by 0.04 % in the last case with 16.
template <int Dim, StrainMeasure Measure = Green>
struct Cable {
  static_assert(Dim == 2 || Dim == 3);
  static constexpr std::string_view label = "cable";  ///< what messages call it
  /// Dimension of space.
  static constexpr int dim = Dim;            ///< dimension of space
  static constexpr int nodes = 2;            ///< one at either end
  static constexpr int node_dofs = 2 * Dim;  ///< r and r'
  static constexpr int dofs = 4 * Dim;       ///< of both nodes
  static constexpr int drawn = 1;            ///< dimension of its picture: 1 a line, 2 a surface
  using Material = Vector<1>;  ///< material coordinates of a point, in its own frame [m]

  double length = 0;             ///< unstretched [m]
  double axial_stiffness = 0;    ///< EA [N]
  double bending_stiffness = 0;  ///< EI [N m^2]
  double mass_per_length = 0;    ///< [kg/m]
  double damping = 0;            ///< relaxation time of Kelvin and Voigt [s]

  /// EA = E pi R^2, EI = E pi R^4/4, mass per length rho pi R^2.
  static Cable of(double length, const CircularSection& section, double damping = 0) {
    return {.length = length,
            .axial_stiffness = section.youngs_modulus * section.area(),
            .bending_stiffness = section.youngs_modulus * section.second_moment(),
            .mass_per_length = section.density * section.area(),
            .damping = damping};
  }

  /// @throws InvalidInput unless length, mass and EA are positive, EI and damping not negative.
  void check() const {
    const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
    const auto not_negative = [](double x) { return std::isfinite(x) && x >= 0; };
    expects(positive(length), "length", length, "positive [m]");
    expects(positive(axial_stiffness), "axial_stiffness", axial_stiffness, "positive [N]");
    expects(not_negative(bending_stiffness), "bending_stiffness", bending_stiffness,
            "zero or positive [N m^2]");
    expects(positive(mass_per_length), "mass_per_length", mass_per_length, "positive [kg/m]");
    expects(not_negative(damping), "damping", damping, "zero or positive [s]");
  }

  /// M = mass_per_length * integral of N^T N dx, exact.
  Matrix<dofs, dofs> mass_matrix() const {
    const auto products = hermite_products(length);
    Matrix<dofs, dofs> M = Matrix<dofs, dofs>::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (int k = 0; k < Dim; ++k)
          M(Dim * static_cast<int>(i) + k, Dim * static_cast<int>(j) + k) =
              mass_per_length * products[i][j];
    return M;
  }

  /// The point at arc coordinate x [m].
  static Material on_axis(double x) { return Material(x); }
  /// The point at the first node.
  Material start() const { return on_axis(0); }
  /// The point at the second node.
  Material end() const { return on_axis(length); }
  /// Where to draw: s from 0 to 1 runs from start to end.
  Material outline(double s) const { return on_axis(s * length); }

  /// r = N q, r' = shape_gradient(X, 0) q, r'' = shape_curvature(X) q.
  Matrix<Dim, dofs> shape(const Material& X) const { return derivative<0>(X); }
  /// dN/dx at X; r' = dN/dx q.
  Matrix<Dim, dofs> shape_gradient(const Material& X, int /*k*/) const { return derivative<1>(X); }
  /// d2N/dx2 at X; r'' = d2N/dx2 q.
  Matrix<Dim, dofs> shape_curvature(const Material& X) const { return derivative<2>(X); }

  /// As `Part` asks.
  static Matrix<dofs, Dim> translation() {
    Matrix<dofs, Dim> T = Matrix<dofs, Dim>::Zero();
    for (int k = 0; k < Dim; ++k) T(k, k) = T(2 * Dim + k, k) = 1;
    return T;
  }

  /// Generalized force of a constant load f per unstretched length [N/m]: integral of N^T f dx.
  Vector<dofs> line_load(const Vector<Dim>& f) const {
    return shape_matrix<Dim>(hermite_integrals(length)).transpose() * f;
  }

  /// eps [-] and kappa [1/m] at X; kappa is positive to the left in 2D, a magnitude in 3D.
  double axial_strain(const Vector<dofs>& q, const Material& X) const {
    return ancf::axial_strain<Measure, Dim, double>(derivative<1>(X) * q).value;
  }
  /// Kappa at X, as Measure has it [1/m].
  double curvature(const Vector<dofs>& q, const Material& X) const {
    Vector<2 * Dim> g;
    g << derivative<1>(X) * q, derivative<2>(X) * q;
    return ancf::bending_strain<Measure>(g, 0).value;
  }

  /// U(q) [J]. The scalar may be complex, for derivatives by a complex step.
  template <class S = double>
  S strain_energy(const std::type_identity_t<Vector<dofs, S>>& q) const {
    S energy = S(0);
    const double e0 = smoothing();
    for_axial_points([&](const Matrix<1, 4>& C, double dx) {
      const S e = ancf::axial_strain<Measure, Dim, S>(gradients<Dim>(C, q)).value;
      energy += 0.5 * dx * axial_stiffness * e * e;
    });
    for_bending_points([&](const Matrix<2, 4>& C, double dx) {
      const S e = ancf::bending_strain<Measure>(gradients<Dim>(C, q), e0).value;
      energy += 0.5 * dx * bending_stiffness * (Dim == 2 ? e * e : (e - e0) * (e + e0));
    });
    return energy;
  }

  /// dU/dq [N].
  template <class S = double>
  Vector<dofs, S> elastic_force(const std::type_identity_t<Vector<dofs, S>>& q) const {
    return internal_force<S>(q, Vector<dofs, S>::Zero());
  }

  /// dU/dq and the force of internal damping [N].
  template <class S = double>
  Vector<dofs, S> internal_force(const std::type_identity_t<Vector<dofs, S>>& q,
                                 const std::type_identity_t<Vector<dofs, S>>& v) const {
    Vector<dofs, S> force = Vector<dofs, S>::Zero();
    const double e0 = smoothing();
    for_axial_points([&](const Matrix<1, 4>& C, double dx) {
      const auto e = ancf::axial_strain<Measure, Dim, S>(gradients<Dim>(C, q));
      add_pull_back<Dim>(C, stress(dx * axial_stiffness, e, gradients<Dim>(C, v)), force);
    });
    for_bending_points([&](const Matrix<2, 4>& C, double dx) {
      const auto e = ancf::bending_strain<Measure>(gradients<Dim>(C, q), e0);
      add_pull_back<Dim>(C, stress(dx * bending_stiffness, e, gradients<Dim>(C, v)), force);
    });
    return force;
  }

  /// dF/dq + w dF/dv of F = internal_force(q, v).
  Matrix<dofs, dofs> tangent(const Vector<dofs>& q, const Vector<dofs>& v, double w) const {
    Matrix<dofs, dofs> K = Matrix<dofs, dofs>::Zero();
    const double e0 = smoothing();
    for_axial_points([&](const Matrix<1, 4>& C, double dx) {
      const Vector<Dim> g = gradients<Dim>(C, q), rate = gradients<Dim>(C, v);
      add_pull_back<Dim>(
          C,
          stress_tangent<Dim>(dx * axial_stiffness, ancf::axial_strain<Measure, Dim, double>(g),
                              axial_strain_hessian<Measure, Dim>(g), rate, w),
          K);
    });
    for_bending_points([&](const Matrix<2, 4>& C, double dx) {
      const Vector<2 *Dim> g = gradients<Dim>(C, q), rate = gradients<Dim>(C, v);
      add_pull_back<Dim>(
          C,
          stress_tangent<2 * Dim>(dx * bending_stiffness, ancf::bending_strain<Measure>(g, e0),
                                  bending_strain_hessian<Measure>(g, e0), rate, w),
          K);
    });
    return K;
  }

  /// Power of internal damping [W].
  double dissipation(const Vector<dofs>& q, const Vector<dofs>& v) const {
    double power = 0;
    const double e0 = smoothing();
    for_axial_points([&](const Matrix<1, 4>& C, double dx) {
      const auto e = ancf::axial_strain<Measure, Dim, double>(gradients<Dim>(C, q));
      const double rate = inner(e.gradient, gradients<Dim>(C, v));
      power += dx * damping * axial_stiffness * rate * rate;
    });
    for_bending_points([&](const Matrix<2, 4>& C, double dx) {
      const auto e = ancf::bending_strain<Measure>(gradients<Dim>(C, q), e0);
      const double rate = inner(e.gradient, gradients<Dim>(C, v));
      power += dx * damping * bending_stiffness * rate * rate;
    });
    return power;
  }

 private:
  template <int Order>
  Matrix<Dim, dofs> derivative(const Material& X) const {
    return shape_matrix<Dim>(hermite<Order>(X[0] / length, length));
  }

  // Curvature below which the damping of a spatial cable fades [1/m].
  double smoothing() const {
    return bending_stiffness > 0 ? 1e-6 * std::sqrt(axial_stiffness / bending_stiffness) : 1.0;
  }

  // visit(C, dx), with g = (C x I) q the r' that the axial strain depends on.
  template <class Visit>
  void for_axial_points(Visit&& visit) const {
    constexpr auto rule = gauss<Measure::axial_points>;
    for (std::size_t i = 0; i < Measure::axial_points; ++i) {
      const auto first = hermite<1>(rule.point[i], length);
      visit(Matrix<1, 4>(first.data()), rule.weight[i] * length);
    }
  }

  // The same with r' and r'', for bending.
  template <class Visit>
  void for_bending_points(Visit&& visit) const {
    constexpr auto rule = gauss<Measure::bending_points>;
    for (std::size_t i = 0; i < Measure::bending_points; ++i) {
      const auto first = hermite<1>(rule.point[i], length);
      const auto second = hermite<2>(rule.point[i], length);
      Matrix<2, 4> C;
      for (std::size_t k = 0; k < 4; ++k) {
        C(0, static_cast<int>(k)) = first[k];
        C(1, static_cast<int>(k)) = second[k];
      }
      visit(C, rule.weight[i] * length);
    }
  }

  // E (e + damping de/dt) de/dg.
  template <int n, class S>
  Vector<n, S> stress(double stiffness, const Strain<n, S>& e, const Vector<n, S>& rate) const {
    return stiffness * (e.value + damping * inner(e.gradient, rate)) * e.gradient;
  }

  // Its derivative in g plus w times that in dg/dt.
  template <int n>
  Matrix<n, n> stress_tangent(double stiffness, const Strain<n, double>& e,
                              const Matrix<n, n>& hessian, const Vector<n>& rate, double w) const {
    const double s = e.value + damping * inner(e.gradient, rate);
    const Vector<n> ds = (1 + w * damping) * e.gradient + damping * (hessian * rate);
    return stiffness * (s * hessian + e.gradient * ds.transpose());
  }
};

}  // namespace sphmbs::mbs::ancf
