// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>

#include <Eigen/Geometry>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ncf {

/// Thin spatial rod in natural coordinates: two points, q = (r1, r2), at a fixed distance L. It has
/// no rotation about its own axis, which a RigidBody with the inertia of a thin rod would have,
/// without inertia against it. The material point at X, measured from the first point [m], is
/// r = r1 + X e, e = (r2 - r1) / L. Garcia de Jalon and Bayo 1994, section 4.2.
struct Rod {
  static constexpr std::string_view label = "rod";  ///< what messages call it
  static constexpr int dim = 3;                     ///< dimension of space
  static constexpr int nodes = 2;                   ///< nodes that carry its coordinates
  static constexpr int node_dofs = 3;               ///< coordinates of a node
  static constexpr int dofs = nodes * node_dofs;    ///< all its coordinates, node by node
  static constexpr int conditions = 1;              ///< algebraic conditions that keep it rigid
  static constexpr int drawn = 1;  ///< dimension of its picture: 1 a line, 2 a surface
  using Material = Vector<1>;      ///< material coordinates of a point, in its own frame [m]

  Vector<3> from;                                  ///< first point at t = 0 [m]
  Vector<3> to;                                    ///< second point at t = 0 [m]
  double density;                                  ///< [kg/m^3]
  double area;                                     ///< of the section [m^2]
  Vector<3> velocity = Vector<3>::Zero();          ///< of the first point at t = 0 [m/s]
  Vector<3> angular_velocity = Vector<3>::Zero();  ///< at t = 0, in global axes [rad/s]

  /// [m].
  double length() const { return (to - from).norm(); }
  /// [kg].
  double mass() const { return density * area * length(); }

  /// @throws InvalidInput unless length, density and area are positive and all is finite.
  void check() const {
    expects(from.allFinite(), "from", from.transpose(), "finite [m]");
    expects(to.allFinite(), "to", to.transpose(), "finite [m]");
    expects(length() > 0, "length", length(), "positive [m]");
    expects(density > 0 && std::isfinite(density), "density", density, "positive [kg/m^3]");
    expects(area > 0 && std::isfinite(area), "area", area, "positive [m^2]");
    expects(velocity.allFinite(), "velocity", velocity.transpose(), "finite [m/s]");
    expects(angular_velocity.allFinite(), "angular_velocity", angular_velocity.transpose(),
            "finite [rad/s]");
  }

  /// N at X, which counts along the rod.
  Matrix<3, 6> shape(const Material& X) const {
    const double s = X[0] / length();
    Matrix<3, 6> N;
    N << (1 - s) * Matrix<3, 3>::Identity(), s * Matrix<3, 3>::Identity();
    return N;
  }

  /// As `Part` asks.
  Matrix<6, 6> mass_matrix() const {
    const Matrix<3, 3> third = mass() / 3 * Matrix<3, 3>::Identity();
    return (Matrix<6, 6>() << third, third / 2, third / 2, third).finished();
  }

  /// As `Part` asks.
  static Matrix<6, 3> translation() { return Matrix<3, 3>::Identity().replicate<2, 1>(); }

  /// Phi = (|r2 - r1|^2 - L^2) / (2 L) [m]: to first order the change of length.
  Vector<1> rigidity(const Vector<6>& q) const {
    const double L = length();
    return Vector<1>(((q.tail<3>() - q.head<3>()).squaredNorm() - L * L) / (2 * L));
  }
  /// As `Body` asks.
  Matrix<1, 6> rigidity_jacobian(const Vector<6>& q) const {
    const Vector<3> e = (q.tail<3>() - q.head<3>()) / length();
    return (Matrix<1, 6>() << -e.transpose(), e.transpose()).finished();
  }
  /// As `Body` asks.
  Matrix<6, 6> rigidity_hessian(const Vector<1>& lambda) const {
    const Matrix<3, 3> h = lambda[0] / length() * Matrix<3, 3>::Identity();
    return (Matrix<6, 6>() << h, -h, -h, h).finished();
  }

  /// As `Body` asks.
  Vector<6> initial_coordinates() const { return (Vector<6>() << from, to).finished(); }
  /// As `Body` asks.
  Vector<6> initial_rates() const {
    return (Vector<6>() << velocity, velocity + angular_velocity.cross(to - from)).finished();
  }

  /// The first end.
  Material start() const { return Material(0.0); }
  /// The second end.
  Material end() const { return Material(length()); }
  /// Where its picture is at s in [0, 1].
  Material outline(double s) const { return Material(s * length()); }
};

static_assert(Body<Rod>);

}  // namespace sphmbs::mbs::ncf
