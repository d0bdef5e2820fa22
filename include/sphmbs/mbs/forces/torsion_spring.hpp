// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/turn.hpp>

namespace sphmbs::mbs::forces {

/// Torsion spring and damper: M = -(k (theta - theta0) + c theta') on the angle theta from a vector
/// of one part to a vector of another, counter-clockwise in the plane, about an axis in space (that
/// of a revolute joint; the vectors need not lie across it). The deflection theta - theta0 is taken
/// in (-pi, pi]: a spring wound beyond half a turn jumps to the other side.
template <int Dim>
struct TorsionSpring {
  Marker<Dim> from = {};                 ///< vector that the angle is counted from
  Marker<Dim> to = {};                   ///< vector that turns
  Marker<Dim> axis = {};                 ///< in space
  double stiffness = 0;                  ///< k [N m/rad]
  double damping = 0;                    ///< c [N m s/rad]
  double natural_angle = 0;              ///< theta0 [rad]
  std::string label = "torsion spring";  ///< name in messages and reports
  /// Both vectors, on all their coordinates; follows from the others.
  Marker<2 * Turn<Dim>::size> y = stacked(Turn<Dim>::y(axis, from), Turn<Dim>::y(axis, to));

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return y.index; }

  /// theta - theta0 in (-pi, pi] [rad].
  double deflection(VectorIn q) const {
    const Vector<2 * half> now = y.local(q);
    const double turned =
        Turn<Dim>::angle(now.template head<half>(), now.template tail<half>()) - natural_angle;
    const double folded = std::remainder(turned, 2 * std::numbers::pi);
    return folded == -std::numbers::pi ? std::numbers::pi : folded;
  }

  void force(VectorIn q, VectorIn v, double, VectorOut f) const {
    const Vector<2 *half> g = gradient(y.local(q)), velocity = y.N * v;
    add_force<2 * half>(y, -(stiffness * deflection(q) + damping * g.dot(velocity)) * g, f);
  }

  void tangent(VectorIn q, VectorIn v, double, MatrixOut k, MatrixOut c) const {
    const Vector<2 *half> now = y.local(q), velocity = y.N * v, g = gradient(now);
    Matrix<2 * half, 2 * half> H = Matrix<2 * half, 2 * half>::Zero();
    H.template topLeftCorner<half, half>() = -Turn<Dim>::slope(now.template head<half>());
    H.template bottomRightCorner<half, half>() = Turn<Dim>::slope(now.template tail<half>());
    // By the transpose: in space H is symmetric only after both ends have met on the axis.
    const Vector<2 * half> rate_slope = H.transpose() * velocity;
    const double moment = stiffness * deflection(q) + damping * g.dot(velocity);
    const Matrix<2 * half, 2 * half> stiff =
        -g * (stiffness * g + damping * rate_slope).transpose() - moment * H;
    const Matrix<2 * half, 2 * half> viscous = -damping * g * g.transpose();
    add_tangent(y, stiff, k);
    add_tangent(y, viscous, c);
  }

  bool conservative() const { return true; }
  double potential(VectorIn q, double) const {
    const double turned = deflection(q);
    return 0.5 * stiffness * turned * turned;
  }
  double dissipation(VectorIn q, VectorIn v, double) const {
    const double rate = gradient(y.local(q)).dot(y.N * v);
    return damping * rate * rate;
  }
  ///@}

  /// @throws InvalidInput for a stiffness or damping below zero, or a vector or axis not given.
  void check() const {
    expects(!is_zero(from), "from", "zero", "a vector");
    expects(!is_zero(to), "to", "zero", "a vector");
    if constexpr (Dim == 3) expects(!is_zero(axis), "axis", "zero", "a vector");
    expects(std::isfinite(stiffness) && stiffness >= 0, "stiffness", stiffness,
            "zero or positive [N m/rad]");
    expects(std::isfinite(damping) && damping >= 0, "damping", damping,
            "zero or positive [N m s/rad]");
    expects(std::isfinite(natural_angle), "natural_angle", natural_angle, "finite [rad]");
  }

 private:
  static constexpr int half = Turn<Dim>::size;

  Vector<2 * half> gradient(const Vector<2 * half>& now) const {
    Vector<2 * half> g;
    g << -Turn<Dim>::moment(now.template head<half>(), label),
        Turn<Dim>::moment(now.template tail<half>(), label);
    return g;
  }
};

static_assert(Force<TorsionSpring<2>> && Force<TorsionSpring<3>>);

}  // namespace sphmbs::mbs::forces
