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
    N << Matrix<2, 2>::Identity() - A, A;
    return N;
  }

  /// From m, the first moments m c and the polar moment about the first point alone.
  Matrix<4, 4> mass_matrix() const {
    const PlanarInertia p = mass_properties();
    const double L = length();
    const Matrix<2, 2> one = Matrix<2, 2>::Identity();
    const Matrix<2, 2> first = similarity(p.mass / L * p.centre);
    const Matrix<2, 2> second = p.polar_about_origin() / (L * L) * one;
    Matrix<4, 4> M;
    M << p.mass * one - first - first.transpose() + second, first - second,
        first.transpose() - second, second;
    return M;
  }

  ///@{ As `Part` asks.
  static Matrix<4, 2> translation() { return Matrix<2, 2>::Identity().replicate<2, 1>(); }
  ///@}

  /// Phi = (|r2 - r1|^2 - L^2) / (2 L) [m]: to first order the change of length.
  Vector<1> rigidity(const Vector<4>& q) const {
    const double L = length();
    return Vector<1>(((q.tail<2>() - q.head<2>()).squaredNorm() - L * L) / (2 * L));
  }
  ///@{ As `Body` asks.
  Matrix<1, 4> rigidity_jacobian(const Vector<4>& q) const {
    const Vector<2> e = (q.tail<2>() - q.head<2>()) / length();
    return (Matrix<1, 4>() << -e.transpose(), e.transpose()).finished();
  }
  Matrix<4, 4> rigidity_hessian(const Vector<1>& lambda) const {
    const Matrix<2, 2> h = lambda[0] / length() * Matrix<2, 2>::Identity();
    return (Matrix<4, 4>() << h, -h, -h, h).finished();
  }
  ///@}

  ///@{ As `Body` asks.
  Vector<4> initial_coordinates() const { return (Vector<4>() << from, to).finished(); }
  Vector<4> initial_rates() const {
    const Vector<2> turning = angular_velocity * quarter_turn() * (to - from);
    return (Vector<4>() << velocity, velocity + turning).finished();
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
