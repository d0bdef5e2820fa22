// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ncf {

/// Orientation of a spatial body: the rotation matrix R whose columns are the body's axes. It may
/// be given as such, as a unit quaternion, or as an axis and an angle.
struct Orientation {
  /// Columns are the axes of the body in the ground's frame.
  Matrix<3, 3> R = Matrix<3, 3>::Identity();

  Orientation() = default;
  /// From a rotation; not checked here, but by the body's check().
  Orientation(const Matrix<3, 3>& rotation) : R(rotation) {}
  /// From a rotation; not checked here, but by the body's check().
  Orientation(const Eigen::Quaterniond& q) : R(q.toRotationMatrix()) {}
  /// From a rotation; not checked here, but by the body's check().
  Orientation(const Eigen::AngleAxisd& turn) : R(turn.toRotationMatrix()) {}

  /// @throws InvalidInput unless R is a rotation, to 1e-8.
  void check() const {
    constexpr double rounding = 1e-8;
    const double off = (R.transpose() * R - Matrix<3, 3>::Identity()).cwiseAbs().maxCoeff();
    expects(off <= rounding && R.determinant() > 0, "orientation",
            R.format(Eigen::IOFormat(6, Eigen::DontAlignCols, ", ", "; ")),
            "a rotation: a matrix with R^T R = 1 and det R = 1, or a unit quaternion, or an angle "
            "about a unit axis");
  }
};

/// x axis from `origin` to `on_x`, y axis in the plane of the three points, towards `towards_y`.
/// @throws InvalidInput for points in line.
inline Orientation through_points(const Vector<3>& origin, const Vector<3>& on_x,
                                  const Vector<3>& towards_y) {
  constexpr double smallest = 1e-10;
  const Vector<3> x = on_x - origin, y = towards_y - origin, z = x.cross(y);
  const double sine = z.norm() / (x.norm() * y.norm());
  expects(sine > smallest, "sine of the angle between the points", sine, "positive: not in line");
  Matrix<3, 3> R;
  R.col(0) = x.normalized();
  R.col(2) = z.normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

}  // namespace sphmbs::mbs::ncf
