// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ncf/planar.hpp>
#include <sphmbs/mbs/ncf/planar_inertia.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ncf {

/// Planar rigid body in natural coordinates: two points, q = (r1, r2), at a fixed distance L.
/// A material point X, in axes from the first point with x1 towards the second one, is
///   r = r1 + X1 e + X2 J e,  e = (r2 - r1) / L,  J the quarter turn.
/// Two bars hinged together may share the node of the common point. Garcia de Jalon and Bayo,
/// Kinematic and Dynamic Simulation of Multibody Systems, Springer 1994, sections 2.1 and 4.2.
struct Bar {
  static constexpr std::string_view label = "bar";  ///< what messages call it
  static constexpr int dim = 2;                     ///< dimension of space
  static constexpr int nodes = 2;                   ///< nodes that carry its coordinates
  static constexpr int node_dofs = 2;               ///< coordinates of a node
  static constexpr int dofs = nodes * node_dofs;    ///< all its coordinates, node by node
  static constexpr int conditions = 1;              ///< algebraic conditions that keep it rigid
  static constexpr int drawn = 1;  ///< dimension of its picture: 1 a line, 2 a surface
  using Material = Vector<2>;      ///< material coordinates of a point, in its own frame [m]

  Vector<2> from;                             ///< first point at t = 0 [m]
  Vector<2> to;                               ///< second point at t = 0 [m]
  double density = 0;                         ///< of a prismatic bar [kg/m^3]
  double area = 0;                            ///< of its section [m^2]
  double height = 0;                          ///< of its section, in the plane [m]
  std::optional<PlanarInertia> inertia = {};  ///< instead of density, area and height
  Vector<2> velocity = Vector<2>::Zero();     ///< of the first point at t = 0 [m/s]
  double angular_velocity = 0;                ///< at t = 0 [rad/s]

  /// [m].
  double length() const { return (to - from).norm(); }

  /// Given, or that of a prismatic bar: m = rho A L at L/2, with m (L^2 + h^2) / 12 about it.
  PlanarInertia mass_properties() const {
    if (inertia) return *inertia;
    const double L = length(), m = density * area * L;
    return {.mass = m, .centre = {L / 2, 0}, .polar = m * (L * L + height * height) / 12};
  }

  /// @throws InvalidInput unless the length is positive and the mass properties make sense.
  void check() const {
    expects(from.allFinite(), "from", from.transpose(), "finite [m]");
    expects(to.allFinite(), "to", to.transpose(), "finite [m]");
    expects(length() > 0, "length", length(), "positive [m]");
    expects(velocity.allFinite(), "velocity", velocity.transpose(), "finite [m/s]");
    expects(std::isfinite(angular_velocity), "angular_velocity", angular_velocity,
            "finite [rad/s]");
    if (inertia) {
      inertia->check();
      expects(density == 0 && area == 0 && height == 0, "density, area, height",
              Vector<3>(density, area, height).transpose(), "left out where inertia is given");
    } else {
      expects(density > 0 && std::isfinite(density), "density", density, "positive [kg/m^3]");
      expects(area > 0 && std::isfinite(area), "area", area, "positive [m^2]");
      expects(height >= 0 && std::isfinite(height), "height", height, "not negative [m]");
    }
  }

  /// N at X, which counts along the bar and across it.
  Matrix<2, 4> shape(const Material& X) const {
    const Matrix<2, 2> A = similarity(X / length());
    Matrix<2, 4> N;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        N(i, j) = (i == j ? 1 : 0) - A(i, j);
        N(i, 2 + j) = A(i, j);
      }
    return N;
  }

  /// From m, the first moments m c and the polar moment about the first point alone.
  Matrix<4, 4> mass_matrix() const {
    const PlanarInertia p = mass_properties();
    const double L = length();
    const Matrix<2, 2> first = similarity(p.mass / L * p.centre);
    const double second = p.polar_about_origin() / (L * L);
    Matrix<4, 4> M;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double one = i == j ? 1 : 0;
        M(i, j) = p.mass * one - first(i, j) - first(j, i) + second * one;
        M(i, 2 + j) = first(i, j) - second * one;
        M(2 + i, j) = first(j, i) - second * one;
        M(2 + i, 2 + j) = second * one;
      }
    return M;
  }

  ///@{ As `Part` asks.
  static Matrix<4, 2> translation() {
    Matrix<4, 2> T = Matrix<4, 2>::Zero();
    for (int k = 0; k < 4; ++k) T(k, k % 2) = 1;
    return T;
  }
  ///@}

  /// Phi = (|r2 - r1|^2 - L^2) / (2 L) [m]: to first order the change of length.
  Vector<1> rigidity(const Vector<4>& q) const {
    const double L = length();
    const double x = q[2] - q[0], y = q[3] - q[1];
    return Vector<1>((x * x + y * y - L * L) / (2 * L));
  }
  ///@{ As `Body` asks.
  Matrix<1, 4> rigidity_jacobian(const Vector<4>& q) const {
    const double L = length(), x = (q[2] - q[0]) / L, y = (q[3] - q[1]) / L;
    return {-x, -y, x, y};
  }
  Matrix<4, 4> rigidity_hessian(const Vector<1>& lambda) const {
    const double h = lambda[0] / length();
    Matrix<4, 4> H = Matrix<4, 4>::Zero();
    for (int k = 0; k < 4; ++k) {
      H(k, k) = h;
      H(k, (k + 2) % 4) = -h;
    }
    return H;
  }
  ///@}

  ///@{ As `Body` asks.
  Vector<4> initial_coordinates() const { return {from[0], from[1], to[0], to[1]}; }
  Vector<4> initial_rates() const {
    const Vector<2> other = velocity + angular_velocity * quarter_turn(to - from);
    return {velocity[0], velocity[1], other[0], other[1]};
  }
  ///@}

  /// The first end.
  Material start() const { return {0, 0}; }
  /// The second end.
  Material end() const { return {length(), 0}; }
  /// Where its picture is at s in [0, 1].
  Material outline(double s) const { return {s * length(), 0}; }
};

static_assert(Body<Bar>);

}  // namespace sphmbs::mbs::ncf
