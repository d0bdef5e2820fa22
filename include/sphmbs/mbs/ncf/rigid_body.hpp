// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ncf/inertia.hpp>
#include <sphmbs/mbs/ncf/orientation.hpp>
#include <sphmbs/mbs/ncf/outline.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs::ncf {

/// The axes that the components of a vector belong to.
enum class Axes { global, body };

/// Spatial rigid body in natural coordinates: a point and three orthonormal vectors,
/// q = (r0, u, v, w). A material point X, in the body's axes, is r = r0 + X1 u + X2 v + X3 w, so
/// that M = P x 1 with the 4 x 4 pseudo-inertia P = [m, m c^T; m c, integral of rho X X^T dV].
/// Each of the four may be a node shared with another body: two bodies with a common point r0 and a
/// common vector w are hinged about w, and |w| = 1 is one of their conditions twice, a redundant
/// one. Garcia de Jalon and Bayo 1994, sections 2.2 and 4.2.
struct RigidBody {
  static constexpr std::string_view label = "rigid body";  ///< what messages call it
  static constexpr int dim = 3;                            ///< dimension of space
  static constexpr int nodes = 4;                          ///< nodes that carry its coordinates
  static constexpr int node_dofs = 3;                      ///< coordinates of a node
  static constexpr int dofs = nodes * node_dofs;           ///< all its coordinates, node by node
  static constexpr int conditions = 6;  ///< algebraic conditions that keep it rigid
  static constexpr int drawn = 1;       ///< dimension of its picture: 1 a line, 2 a surface
  using Material = Vector<3>;           ///< material coordinates of a point, in its own frame [m]

  Inertia inertia;                                 ///< mass, centre and moments of inertia
  Orientation orientation = {};                    ///< at t = 0
  Vector<3> reference = Vector<3>::Zero();         ///< material point that these belong to [m]:
  Vector<3> position = Vector<3>::Zero();          ///< its place at t = 0 [m]
  Vector<3> velocity = Vector<3>::Zero();          ///< its velocity at t = 0 [m/s]
  Vector<3> angular_velocity = Vector<3>::Zero();  ///< at t = 0 [rad/s]
  Axes angular_velocity_in = Axes::global;         ///< axes in which the angular velocity is given
  std::vector<Vector<3>> outline_points = {};  ///< drawn polyline; none: box of equal inertia [m]

  /// @throws InvalidInput unless the mass properties make sense, the orientation is a rotation and
  /// all is finite.
  void check() const {
    inertia.check();
    orientation.check();
    expects(reference.allFinite(), "reference", reference.transpose(), "finite [m]");
    expects(position.allFinite(), "position", position.transpose(), "finite [m]");
    expects(velocity.allFinite(), "velocity", velocity.transpose(), "finite [m/s]");
    expects(angular_velocity.allFinite(), "angular_velocity", angular_velocity.transpose(),
            "finite [rad/s]");
    expects(outline_points.size() != 1, "outline_points", "1 point", "none, or two and more");
  }

  /// N at X, in the frame of the body.
  Matrix<3, 12> shape(const Material& X) const {
    const Matrix<3, 3> one = Matrix<3, 3>::Identity();
    return (Matrix<3, 12>() << one, X[0] * one, X[1] * one, X[2] * one).finished();
  }

  /// As `Part` asks.
  Matrix<12, 12> mass_matrix() const {
    Matrix<4, 4> P;
    P << inertia.mass, inertia.mass * inertia.centre.transpose(), inertia.mass * inertia.centre,
        inertia.second_moments();
    Matrix<12, 12> M;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) M.block<3, 3>(3 * i, 3 * j) = P(i, j) * Matrix<3, 3>::Identity();
    return M;
  }

  /// As `Part` asks.
  static Matrix<12, 3> translation() { return Matrix<12, 3>::Identity(); }

  /// Phi = ((u.u - 1) / 2, (v.v - 1) / 2, (w.w - 1) / 2, v.w, w.u, u.v) [-].
  Vector<6> rigidity(const Vector<12>& q) const {
    Vector<6> phi;
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = pairs[static_cast<std::size_t>(c)];
      const double product = q.segment<3>(i).dot(q.segment<3>(j));
      phi[c] = i == j ? (product - 1) / 2 : product;
    }
    return phi;
  }
  /// As `Body` asks.
  Matrix<6, 12> rigidity_jacobian(const Vector<12>& q) const {
    Matrix<6, 12> phi_q = Matrix<6, 12>::Zero();
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = pairs[static_cast<std::size_t>(c)];
      phi_q.block<1, 3>(c, i) = q.segment<3>(j).transpose();
      phi_q.block<1, 3>(c, j) = q.segment<3>(i).transpose();
    }
    return phi_q;
  }
  /// As `Body` asks.
  Matrix<12, 12> rigidity_hessian(const Vector<6>& lambda) const {
    Matrix<12, 12> h = Matrix<12, 12>::Zero();
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = pairs[static_cast<std::size_t>(c)];
      h.block<3, 3>(i, j) = h.block<3, 3>(j, i) = lambda[c] * Matrix<3, 3>::Identity();
    }
    return h;
  }

  /// As `Body` asks.
  Vector<12> initial_coordinates() const {
    const Matrix<3, 3>& R = orientation.R;
    return (Vector<12>() << position - R * reference, R.col(0), R.col(1), R.col(2)).finished();
  }
  /// As `Body` asks.
  Vector<12> initial_rates() const {
    const Matrix<3, 3>& R = orientation.R;
    const Vector<3> omega =
        angular_velocity_in == Axes::body ? R * angular_velocity : angular_velocity;
    return (Vector<12>() << velocity - omega.cross(R * reference), omega.cross(R.col(0)),
            omega.cross(R.col(1)), omega.cross(R.col(2)))
        .finished();
  }

  /// Where its picture is at s in [0, 1].
  Material outline(double s) const {
    if (!outline_points.empty()) return along(outline_points, s);
    const Eigen::SelfAdjointEigenSolver<Matrix<3, 3>> axes(inertia.central_moments() /
                                                           inertia.mass);
    const Vector<3> half = (3 * axes.eigenvalues()).cwiseMax(0).cwiseSqrt();
    // All edges of a box in one line: its bottom, then its sides and its top.
    static const std::vector<Vector<3>> edges{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                              {-1, -1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1},
                                              {1, -1, 1},   {1, 1, 1},   {1, 1, -1}, {1, 1, 1},
                                              {-1, 1, 1},   {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}};
    return inertia.centre + axes.eigenvectors() * half.cwiseProduct(along(edges, s));
  }

 private:
  // Where the two vectors of each condition begin in q.
  static constexpr std::array<std::pair<int, int>, 6> pairs{
      {{3, 3}, {6, 6}, {9, 9}, {6, 9}, {9, 3}, {3, 6}}};
};

static_assert(Body<RigidBody>);

}  // namespace sphmbs::mbs::ncf
