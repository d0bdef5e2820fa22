// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>
#include <type_traits>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ancf/plate_chain.hpp>
#include <sphmbs/mbs/ancf/plate_pressure.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ancf {

/// Rectangular thin plate of Kirchhoff and Love in absolute nodal coordinates (Dmitrochenko and
/// Pogorelov 2003): large displacements and rotations, small strains, flat and unstressed where
/// r = (x, y). Coordinates of a node: r, r_x, r_y (36 of an element, `Plate36`), and r_xy (48,
/// `Plate48`). Nodes: (0, 0), (length, 0), (length, width), (0, width). The energy is
///
///   U = 1/2 int E t/(1-nu^2) (e11^2 + e22^2 + 2 nu e11 e22 + (1-nu)/2 g12^2)
///         + E t^3/12/(1-nu^2) (k11^2 + k22^2 + 2 nu k11 k22 + (1-nu)/2 k12^2) dx dy
///   e11 = (r_x.r_x - 1)/2, e22 = (r_y.r_y - 1)/2, g12 = r_x.r_y
///   k11 = n.r_xx/|n|^3, k22 = n.r_yy/|n|^3, k12 = 2 n.r_xy/|n|^3, n = r_x x r_y
///
/// by 4 x 4 Gauss points; the mass matrix is exact. Damping (Kelvin and Voigt) adds the stress
/// tau D d(strain)/dt: it is free of rigid motion.
///
/// Limits. No shear through the thickness, no rotary inertia. Membrane strains are Green's and may
/// be some tenths; the curvatures are those of the paper, geometric ones where the membrane strain
/// is small. Bending and membrane strains come from the same cubics, which cannot bend without some
/// membrane strain: an element laid on an arc of angle a [rad] stores 2e-5 a^6 (length/thickness)^2
/// times the energy of the arc too much. Very thin plates that bend sharply are too stiff until the
/// mesh makes that small. With Acm, normals of neighbours agree at nodes only, so that deflections
/// and frequencies may converge from either side. Forces are not finite where r_x and r_y are
/// parallel.
template <class Shape = Acm>
struct Plate {
  using Material = Vector<2>;                         ///< x in [0, length], y in [0, width] [m]
  static constexpr std::string_view label = "plate";  ///< what messages call it
  static constexpr int dim = 3;                       ///< dimension of space
  static constexpr int nodes = 4;                     ///< one at each corner
  /// r and its gradients, as the family has it.
  static constexpr int node_dofs = 3 * Shape::node_functions;
  static constexpr int dofs = nodes * node_dofs;  ///< all its coordinates, node by node
  static constexpr int drawn = 2;  ///< dimension of its picture: 1 a line, 2 a surface

  double length = 0;           ///< along x [m]
  double width = 0;            ///< along y [m]
  double thickness = 0;        ///< [m]
  double density = 0;          ///< [kg/m^3]
  double youngs_modulus = 0;   ///< [Pa]
  double poisson_ratio = 0.3;  ///< [-]
  double damping = 0;          ///< tau, relaxation time of Kelvin and Voigt [s]

  /// @throws InvalidInput unless sizes, density and Young's modulus are positive, Poisson's ratio
  /// is above -1 and below 0.5, and the damping is not negative; all finite.
  void check() const {
    const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
    expects(positive(length), "length", length, "positive [m]");
    expects(positive(width), "width", width, "positive [m]");
    expects(positive(thickness), "thickness", thickness, "positive [m]");
    expects(positive(density), "density", density, "positive [kg/m^3]");
    expects(positive(youngs_modulus), "youngs_modulus", youngs_modulus, "positive [Pa]");
    expects(poisson_ratio > -1 && poisson_ratio < 0.5, "poisson_ratio", poisson_ratio,
            "between -1 and 0.5");
    expects(std::isfinite(damping) && damping >= 0, "damping", damping, "zero or positive [s]");
  }

  /// N(X).
  Matrix<3, dofs> shape(const Material& X) const { return functions(X, 0, 0); }
  /// Derivative of N in x (k = 0) or in y (k = 1).
  Matrix<3, dofs> shape_gradient(const Material& X, int k) const {
    return k == 0 ? functions(X, 1, 0) : functions(X, 0, 1);
  }
  /// Derivative of N in x and y.
  Matrix<3, dofs> shape_twist(const Material& X) const { return functions(X, 1, 1); }
  /// As `Part` asks.
  static Matrix<dofs, 3> translation() {
    Matrix<dofs, 3> T = Matrix<dofs, 3>::Zero();
    for (int i = 0; i < nodes; ++i) T.template middleRows<3>(i * node_dofs).setIdentity();
    return T;
  }
  /// (e11, e22, g12, k11, k22, k12) at X: [-], and curvatures [1/m].
  Vector<6> strains(const Vector<dofs>& q, const Material& X) const {
    detail::SurfaceVectors<double> g;
    for (std::size_t m = 0; m < 5; ++m) {
      const Vector<3> r = functions(X, Chain::table.ds[m], Chain::table.dt[m]) * q;
      g[m] = {r[0], r[1], r[2]};
    }
    const auto [e, k] = detail::PlateSurface<double>(g).strain();
    return {e[0], e[1], e[2], k[0], k[1], 2 * k[2]};
  }
  /// The point at the shares s, t in [0, 1] of the length and the width.
  Material outline(double s, double t) const { return {s * length, t * width}; }

  /// M = int density thickness N^T N dx dy, exact.
  Matrix<dofs, dofs> mass_matrix() const {
    const double mass = density * thickness * length * width;
    const auto scale = this->scale();
    Matrix<dofs, dofs> M = Matrix<dofs, dofs>::Zero();
    for (int k = 0; k < Functions::size; ++k)
      for (int l = 0; l < Functions::size; ++l)
        M.template block<3, 3>(3 * k, 3 * l)
            .diagonal()
            .setConstant(mass * (scale(k) * scale(l)) * Chain::table.integral(k, l));
    return M;
  }

  /// int N^T f dx dy of a constant load f per reference area [N/m^2].
  Vector<dofs> surface_load(const Vector<3>& f) const {
    const auto scale = this->scale();
    Vector<dofs> Q;
    for (int k = 0; k < Functions::size; ++k)
      Q.template segment<3>(3 * k) = length * width * scale(k) * Chain::table.integral(k) * f;
    return Q;
  }

  /// U [J]. The scalar may be complex, for derivatives by a complex step, here and below.
  template <class S = double>
  S strain_energy(const std::type_identity_t<Vector<dofs, S>>& q) const {
    return chain().template energy<S>(stiffness(), q);
  }
  /// dU/dq.
  template <class S = double>
  Vector<dofs, S> elastic_force(const std::type_identity_t<Vector<dofs, S>>& q) const {
    return chain().template force<false, S>(stiffness(), q, q, 0);
  }
  /// dU/dq and the force of damping.
  template <class S = double>
  Vector<dofs, S> internal_force(const std::type_identity_t<Vector<dofs, S>>& q,
                                 const std::type_identity_t<Vector<dofs, S>>& v) const {
    if (damping == 0) return elastic_force<S>(q);
    return chain().template force<true, S>(stiffness(), q, v, damping);
  }
  /// dF/dq + w dF/dv, exact; symmetric without damping.
  Matrix<dofs, dofs> tangent(const Vector<dofs>& q, const Vector<dofs>& v, double w) const {
    if (damping == 0) return chain().template tangent<false>(stiffness(), q, v, 0, 0);
    return chain().template tangent<true>(stiffness(), q, v, damping, w);
  }
  /// Power that damping takes: tau times the integral of D (de/dt)^2 [W].
  double dissipation(const Vector<dofs>& q, const Vector<dofs>& v) const {
    return damping == 0 ? 0.0 : damping * chain().squared_rate(stiffness(), q, v);
  }

  /// int N^T n dx dy, n = r_x x r_y, exact: the force of a unit pressure that follows the surface
  /// and acts along n on the area as it is [m^2].
  template <class S = double>
  Vector<dofs, S> pressure_force(const std::type_identity_t<Vector<dofs, S>>& q) const {
    return detail::PlatePressure<Shape>(scale()).template force<S>(q);
  }
  /// Its derivative in q; not symmetric, as the pressure's work depends on the edges.
  Matrix<dofs, dofs> pressure_tangent(const Vector<dofs>& q) const {
    return detail::PlatePressure<Shape>(scale()).tangent(q);
  }

 private:
  using Chain = detail::PlateChain<Shape>;
  using Functions = PlateFunctions<Shape>;

  Chain chain() const { return {length, width}; }
  detail::PlateScale<Shape> scale() const { return {length, width}; }

  // Of the whole area; the twist p.r_xy is half of k12.
  detail::PlateStiffness<double> stiffness() const {
    const double nu = poisson_ratio;
    const double C = youngs_modulus * thickness / (1 - nu * nu) * length * width;
    const double D = C * thickness * thickness / 12;
    return {{C, nu * C, (1 - nu) / 2 * C}, {D, nu * D, 2 * (1 - nu) * D}};
  }

  Matrix<3, dofs> functions(const Material& X, int ds, int dt) const {
    const double factor = std::pow(length, -ds) * std::pow(width, -dt);
    const auto scale = this->scale();
    Matrix<3, dofs> N = Matrix<3, dofs>::Zero();
    for (int k = 0; k < Functions::size; ++k)
      N.template middleCols<3>(3 * k).diagonal().setConstant(
          factor * scale(k) * Functions::value(k, X[0] / length, X[1] / width, ds, dt));
    return N;
  }
};

/// With the nodal coordinates r, r_x, r_y.
using Plate36 = Plate<Acm>;
/// With the nodal coordinates r, r_x, r_y, r_xy.
using Plate48 = Plate<Bicubic>;

static_assert(Element<Plate36> && Element<Plate48>);

}  // namespace sphmbs::mbs::ancf
