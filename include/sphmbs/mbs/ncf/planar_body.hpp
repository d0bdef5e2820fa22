// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ncf/outline.hpp>
#include <sphmbs/mbs/ncf/planar.hpp>
#include <sphmbs/mbs/ncf/planar_inertia.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ncf {

/// Planar rigid body in natural coordinates: a point and a unit vector, q = (r0, u). A material
/// point X, in the body's axes, is r = r0 + X1 u + X2 J u with the quarter turn J. Both nodes may
/// be shared. Garcia de Jalon and Bayo 1994, sections 2.1 and 4.2.
struct PlanarBody {
  static constexpr std::string_view label = "planar body";  ///< what messages call it
  static constexpr int dim = 2;                             ///< dimension of space
  static constexpr int nodes = 2;                           ///< nodes that carry its coordinates
  static constexpr int node_dofs = 2;                       ///< coordinates of a node
  static constexpr int dofs = nodes * node_dofs;            ///< all its coordinates, node by node
  static constexpr int conditions = 1;  ///< algebraic conditions that keep it rigid
  static constexpr int drawn = 1;       ///< dimension of its picture: 1 a line, 2 a surface
  using Material = Vector<2>;           ///< material coordinates of a point, in its own frame [m]

  PlanarInertia inertia;                    ///< mass, centre and moment of inertia
  Vector<2> reference = Vector<2>::Zero();  ///< material point that these belong to [m]:
  Vector<2> position = Vector<2>::Zero();   ///< its place at t = 0 [m]
  Vector<2> velocity = Vector<2>::Zero();   ///< its velocity at t = 0 [m/s]
  double angle = 0;                         ///< of the body's x axis at t = 0 [rad]
  double angular_velocity = 0;              ///< at t = 0 [rad/s]
  /// Drawn polyline; none: square of equal inertia [m].
  std::vector<Vector<2>> outline_points = {};

  /// @throws InvalidInput unless the mass properties make sense and all is finite.
  void check() const {
    inertia.check();
    expects(reference.allFinite(), "reference", reference.transpose(), "finite [m]");
    expects(position.allFinite(), "position", position.transpose(), "finite [m]");
    expects(velocity.allFinite(), "velocity", velocity.transpose(), "finite [m/s]");
    expects(std::isfinite(angle), "angle", angle, "finite [rad]");
    expects(std::isfinite(angular_velocity), "angular_velocity", angular_velocity,
            "finite [rad/s]");
    expects(outline_points.size() != 1, "outline_points", "1 point", "none, or two and more");
  }

  /// N at X, in the frame of the body.
  Matrix<2, 4> shape(const Material& X) const {
    return (Matrix<2, 4>() << Matrix<2, 2>::Identity(), similarity(X)).finished();
  }

  /// As `Part` asks.
  Matrix<4, 4> mass_matrix() const {
    const Matrix<2, 2> one = Matrix<2, 2>::Identity();
    const Matrix<2, 2> first = similarity(inertia.mass * inertia.centre);
    return (Matrix<4, 4>() << inertia.mass * one, first, first.transpose(),
            inertia.polar_about_origin() * one)
        .finished();
  }

  /// As `Part` asks.
  static Matrix<4, 2> translation() { return Matrix<4, 2>::Identity(); }

  /// Phi = (|u|^2 - 1) / 2 [-].
  Vector<1> rigidity(const Vector<4>& q) const {
    return Vector<1>((q.tail<2>().squaredNorm() - 1) / 2);
  }
  /// As `Body` asks.
  Matrix<1, 4> rigidity_jacobian(const Vector<4>& q) const {
    return (Matrix<1, 4>() << 0, 0, q[2], q[3]).finished();
  }
  /// As `Body` asks.
  Matrix<4, 4> rigidity_hessian(const Vector<1>& lambda) const {
    return Vector<4>(0, 0, lambda[0], lambda[0]).asDiagonal();
  }

  /// As `Body` asks.
  Vector<4> initial_coordinates() const {
    const Vector<2> u(std::cos(angle), std::sin(angle));
    return (Vector<4>() << position - similarity(reference) * u, u).finished();
  }
  /// As `Body` asks.
  Vector<4> initial_rates() const {
    const Vector<2> u_rate = angular_velocity * Vector<2>(-std::sin(angle), std::cos(angle));
    return (Vector<4>() << velocity - similarity(reference) * u_rate, u_rate).finished();
  }

  /// Where its picture is at s in [0, 1].
  Material outline(double s) const {
    if (!outline_points.empty()) return along(outline_points, s);
    const double a = std::sqrt(1.5 * inertia.polar / inertia.mass);
    const std::vector<Vector<2>> square{{-a, -a}, {a, -a}, {a, a}, {-a, a}, {-a, -a}};
    return inertia.centre + along(square, s);
  }
};

static_assert(Body<PlanarBody>);

}  // namespace sphmbs::mbs::ncf
