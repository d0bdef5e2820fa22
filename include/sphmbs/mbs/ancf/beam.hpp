// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <type_traits>
#include <utility>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ancf/beam_strain.hpp>
#include <sphmbs/mbs/ancf/quadrature.hpp>
#include <sphmbs/mbs/ancf/section.hpp>
#include <sphmbs/mbs/ancf/shape_functions.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ancf {

/// Fully parameterised ANCF beam of rectangular section, which stretches, bends, shears, twists and
/// changes its section. Coordinates r, r_x, r_y, r_z at either end; between them r is cubic in x
/// and linear in y and z (Shabana and Yakoub 2001; Yakoub and Shabana 2001, Journal of Mechanical
/// Design 123). Material coordinates: x from 0 to length, y and z from the axis.
///
/// The energy is that of a structure, in the strains e_0 ... e_8 of `BeamStrain`: U = 1/2 integral
/// of
///
///   E A e_0^2 + A (2 mu (f_1^2 + f_2^2) + lambda (f_1 + f_2)^2) + G A e_5^2,   f_i = e_i + nu e_0
///   + G A_y e_3^2 + G A_z e_4^2 + E I_z e_6^2 + E I_y e_7^2 + G J e_8^2
///
/// The first line is Saint Venant and Kirchhoff's law, by squares, on the axis. It acts there
/// alone, and bending takes E: a section linear in y and z cannot contract where its fibres
/// stretch, and with that law throughout would bend too little, by 26 % at nu = 0.3 (Poisson
/// locking; Gerstmayr and Shabana 2005; Gerstmayr, Matikainen and Mikkola 2008, Multibody System
/// Dynamics 20). J is St Venant's. Warping and strains of second order in y and z are left out.
///
/// Directors r_y, r_z linear in x cannot follow the slope of a cubic axis: the plain integral locks
/// where the beam is thin. Therefore stretch and shear (e_0, e_3, e_4) take three Gauss points,
/// bending and twist the middle, strains of the section (e_1, e_2, e_5, f_i) the two ends, where
/// directors can keep their length; and the areas A_y, A_z that shear count what a constant
/// curvature misses of the bending, 1/(G A_y) = 1/(k G A) + length^2/(12 E I_z), A_z with I_y
/// likewise (residual bending flexibility: MacNeal 1978, Computers and Structures 8). Under small
/// forces at the nodes the deflection is then that of Timoshenko's beam for any number of elements.
///
/// What remains: an element bent by the angle p is too soft by p^2/12 (1 % at 0.35 rad), as its
/// directors are short in the middle, and gives way beyond a moment of E I/length. A clamp should
/// hold r, r_y and r_z and leave r_x free to shear; holding r_x too stiffens the element beside it.
///
/// Internal damping is Kelvin and Voigt's: each e_k counts as e_k + damping * de_k/dt in the
/// stress.
struct Beam {
  static constexpr std::string_view label = "beam";  ///< what messages call it
  static constexpr int dim = 3;                      ///< dimension of space
  static constexpr int nodes = 2;                    ///< one at either end
  static constexpr int node_dofs = 12;               ///< r and its three gradients
  static constexpr int dofs = 24;                    ///< of both nodes  ///< dimension of space
  static constexpr int drawn = 1;  ///< dimension of its picture: 1 a line, 2 a surface
  using Material = Vector<3>;      ///< material coordinates of a point, in its own frame [m]

  double length = 0;                  ///< unstretched [m]
  double width = 0;                   ///< along y [m]
  double height = 0;                  ///< along z [m]
  double density = 0;                 ///< [kg/m^3]
  double youngs_modulus = 0;          ///< E [Pa]
  double poisson_ratio = 0.3;         ///< nu [-]
  double shear_correction = 5.0 / 6;  ///< k [-]
  double damping = 0;                 ///< relaxation time of Kelvin and Voigt [s]

  /// @throws InvalidInput unless -1 < nu < 0.5, damping is not negative and the others are
  /// positive.
  void check() const {
    const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
    expects(positive(length), "length", length, "positive [m]");
    expects(positive(width), "width", width, "positive [m]");
    expects(positive(height), "height", height, "positive [m]");
    expects(positive(density), "density", density, "positive [kg/m^3]");
    expects(positive(youngs_modulus), "youngs_modulus", youngs_modulus, "positive [Pa]");
    expects(poisson_ratio > -1 && poisson_ratio < 0.5, "poisson_ratio", poisson_ratio,
            "between -1 and 0.5, both excluded");
    expects(positive(shear_correction), "shear_correction", shear_correction, "positive");
    expects(std::isfinite(damping) && damping >= 0, "damping", damping, "zero or positive [s]");
  }

  double area() const { return width * height; }                            ///< [m^2]
  double second_moment_y() const { return area() * height * height / 12; }  ///< of z^2 [m^4]
  double second_moment_z() const { return area() * width * width / 12; }    ///< of y^2 [m^4]
  double shear_modulus() const { return youngs_modulus / (2 + 2 * poisson_ratio); }  ///< G [Pa]

  /// M = density * integral of N^T N dV, exact.
  Matrix<dofs, dofs> mass_matrix() const {
    const auto axis = hermite_products(length);
    Matrix<8, 8> m = Matrix<8, 8>::Zero();
    constexpr std::array<int, 4> place{0, 1, 4, 5};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) m(place[i], place[j]) = area() * axis[i][j];
    for (const auto& [k, moment] : {std::pair{2, second_moment_z()}, {3, second_moment_y()}}) {
      m(k, k) = m(k + 4, k + 4) = moment * length / 3;
      m(k, k + 4) = m(k + 4, k) = moment * length / 6;
    }
    Matrix<dofs, dofs> M = Matrix<dofs, dofs>::Zero();
    add_blocks<3, 8>(density * m, M);
    return M;
  }

  /// The point of the axis at arc coordinate x [m].
  static Material on_axis(double x) { return {x, 0, 0}; }
  /// The point of the axis at the first node.
  Material start() const { return on_axis(0); }
  /// The point of the axis at the second node.
  Material end() const { return on_axis(length); }
  /// Where to draw: s from 0 to 1 runs along the axis.
  Material outline(double s) const { return on_axis(s * length); }

  /// r = N q; shape_gradient(X, k) q is r_x, r_y, r_z for k = 0, 1, 2.
  Matrix<3, dofs> shape(const Material& X) const {
    const double xi = X[0] / length;
    const auto h = hermite<0>(xi, length);
    const double left = 1 - xi, right = xi;
    return shape_matrix<3>(std::array{h[0], h[1], X[1] * left, X[2] * left,  //
                                      h[2], h[3], X[1] * right, X[2] * right});
  }
  /// dN/dX_k at X.
  Matrix<3, dofs> shape_gradient(const Material& X, int k) const {
    const double xi = X[0] / length;
    if (k == 1) return shape_matrix<3>(std::array{0., 0., 1 - xi, 0., 0., 0., xi, 0.});
    if (k == 2) return shape_matrix<3>(std::array{0., 0., 0., 1 - xi, 0., 0., 0., xi});
    const auto h = hermite<1>(xi, length);
    const double y = X[1] / length, z = X[2] / length;
    return shape_matrix<3>(std::array{h[0], h[1], -y, -z, h[2], h[3], y, z});
  }
  /// d2r/dx2 is shape_curvature(X) q.
  Matrix<3, dofs> shape_curvature(const Material& X) const {
    const auto h = hermite<2>(X[0] / length, length);
    return shape_matrix<3>(std::array{h[0], h[1], 0., 0., h[2], h[3], 0., 0.});
  }

  /// As `Part` asks.
  static Matrix<dofs, 3> translation() {
    Matrix<dofs, 3> T = Matrix<dofs, 3>::Zero();
    T.topRows<3>().setIdentity();
    T.middleRows<3>(12).setIdentity();
    return T;
  }

  /// Generalized force of a constant load f on the axis, per unstretched length [N/m].
  Vector<dofs> line_load(const Vector<3>& f) const {
    const auto h = hermite_integrals(length);
    return shape_matrix<3>(std::array{h[0], h[1], 0., 0., h[2], h[3], 0., 0.}).transpose() * f;
  }

  /// Strains on the axis at x = X[0].
  BeamStrain<> strain(const Vector<dofs>& q, const Material& X) const {
    return beam_strain<double>(gradients<double>(q, beam_coefficients(X[0] / length, length)));
  }

  /// U(q) [J]. The scalar may be complex, for derivatives by a complex step.
  template <class S = double>
  S strain_energy(const std::type_identity_t<Vector<dofs, S>>& q) const {
    S energy = S(0);
    for_points([&](const Matrix<5, 8>& C, const Section& D) {
      const BeamStrain<S> e = beam_strain<S>(gradients<S>(q, C));
      energy += 0.5 * inner(e, BeamStrain<S>(D * e));
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
    Matrix<3, 8, S> force = Matrix<3, 8, S>::Zero();
    for_points([&](const Matrix<5, 8>& C, const Section& D) {
      const BeamGradients<S> g = gradients<S>(q, C), rate = gradients<S>(v, C);
      const BeamStrain<S> e = beam_strain<S>(g) + damping * beam_strain_rate<S>(g, rate);
      const BeamGradients<S> in_g = g * beam_strain_hessian<S>(D * e);
      force += in_g * C;
    });
    return Eigen::Map<const Vector<dofs, S>>(force.data());
  }

  /// dF/dq + w dF/dv of F = internal_force(q, v).
  Matrix<dofs, dofs> tangent(const Vector<dofs>& q, const Vector<dofs>& v, double w) const {
    Matrix<dofs, dofs> K = Matrix<dofs, dofs>::Zero();
    for_points([&](const Matrix<5, 8>& C, const Section& D) {
      const BeamGradients<> g = gradients(q, C), rate = gradients(v, C);
      const BeamStrain<> e = beam_strain<double>(g) + damping * beam_strain_rate<double>(g, rate);
      const Matrix<dofs, 9> B = beam_strain_gradient<8>(g, C), BD = B * D;
      Matrix<dofs, 9> dB = (1 + w * damping) * B;
      if (damping > 0) dB += damping * beam_strain_gradient<8>(rate, C);
      K.noalias() += BD * dB.transpose();
      add_blocks<3, 8>(C.transpose() * beam_strain_hessian<double>(D * e) * C, K);
    });
    return K;
  }

  /// Power of internal damping [W].
  double dissipation(const Vector<dofs>& q, const Vector<dofs>& v) const {
    double power = 0;
    for_points([&](const Matrix<5, 8>& C, const Section& D) {
      const BeamStrain<> rate = beam_strain_rate<double>(gradients(q, C), gradients(v, C));
      power += damping * rate.dot(D * rate);
    });
    return power;
  }

 private:
  using Section = Matrix<9, 9>;

  // k G A, with the residual bending flexibility of the plane where the section has this moment.
  double shear_stiffness(double moment) const {
    const double shear = shear_correction * shear_modulus() * area();
    return 1 / (1 / shear + length * length / (12 * youngs_modulus * moment));
  }

  // visit(C, D) at each point: g = q C^T are the gradients there, D times the strains are forces
  // and moments of the section times dx.
  template <class Visit>
  void for_points(Visit&& visit) const {
    const double E = youngs_modulus, nu = poisson_ratio, A = area(), G = shear_modulus();
    const double Iy = second_moment_y(), Iz = second_moment_z();
    Vector<9> axis = Vector<9>::Zero(), middle = Vector<9>::Zero();
    axis[0] = E * A;
    axis[3] = shear_stiffness(Iz);
    axis[4] = shear_stiffness(Iy);
    middle.tail<3>() << E * Iz, E * Iy, G * torsion_constant(width, height);
    const auto& rule = gauss<3>;
    for (std::size_t i = 0; i < 3; ++i)
      visit(beam_coefficients(rule.point[i], length),
            Section((rule.weight[i] * length * axis).asDiagonal()));
    visit(beam_coefficients(0.5, length), Section((length * middle).asDiagonal()));

    Matrix<2, 3> f;
    f << nu, 1, 0, nu, 0, 1;
    const double lambda = 2 * G * nu / (1 - 2 * nu);
    Matrix<2, 2> plane = Matrix<2, 2>::Constant(lambda * A);
    plane.diagonal().array() += 2 * G * A;
    Section end = Section::Zero();
    end.topLeftCorner<3, 3>() = length / 2 * f.transpose() * plane * f;
    end(5, 5) = length / 2 * G * A;
    visit(beam_coefficients(0, length), end);
    visit(beam_coefficients(1, length), end);
  }

  template <class S = double>
  static BeamGradients<S> gradients(const Vector<dofs, S>& q, const Matrix<5, 8>& C) {
    return Eigen::Map<const Matrix<3, 8, S>>(q.data()) * C.transpose();
  }
};

static_assert(Element<Beam>);

}  // namespace sphmbs::mbs::ancf
