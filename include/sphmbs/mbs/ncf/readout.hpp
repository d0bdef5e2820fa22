// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>

#include <Eigen/Geometry>

#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::ncf {

/// Body with axes of its own, in which its material points are given.
template <class B>
concept BodyWithAxes = Body<B> && std::same_as<typename B::Material, Vector<B::dim>>;

namespace detail {

/// The body's axes at q, or at rates v the rates of them, as columns.
template <BodyWithAxes B>
Matrix<B::dim, B::dim> axes(const Placed<B>& body, const VectorXd& q) {
  Matrix<B::dim, B::dim> R;
  for (int k = 0; k < B::dim; ++k)
    R.col(k) = body.vector(Vector<B::dim>::Zero(), Vector<B::dim>::Unit(k)).at(q);
  return R;
}

}  // namespace detail

/// Rotation matrix: its columns are the body's axes. Spatial or planar.
template <BodyWithAxes B>
Matrix<B::dim, B::dim> rotation(const Placed<B>& body, const VectorXd& q) {
  return detail::axes(body, q);
}

/// Angle of the x axis of a planar body, in (-pi, pi] [rad].
template <BodyWithAxes B>
requires(B::dim == 2) double angle(const Placed<B>& body, const VectorXd& q) {
  const Vector<2> e = detail::axes(body, q).col(0);
  return std::atan2(e[1], e[0]);
}

/// Angular velocity of a planar body [rad/s].
template <BodyWithAxes B>
requires(B::dim == 2) double angular_velocity(const Placed<B>& body, const VectorXd& q,
                                              const VectorXd& v) {
  const Vector<2> e = detail::axes(body, q).col(0), rate = detail::axes(body, v).col(0);
  return (e[0] * rate[1] - e[1] * rate[0]) / e.squaredNorm();
}

/// Angular velocity of a spatial body in global axes [rad/s]: half the sum of e x de/dt over its
/// axes, since e x (omega x e) = omega - e (e.omega).
template <BodyWithAxes B>
requires(B::dim == 3) Vector<3> angular_velocity(const Placed<B>& body, const VectorXd& q,
                                                 const VectorXd& v) {
  const Matrix<3, 3> e = detail::axes(body, q), rate = detail::axes(body, v);
  Vector<3> omega = Vector<3>::Zero();
  for (int k = 0; k < 3; ++k) omega += 0.5 * e.col(k).cross(rate.col(k));
  return omega;
}

/// The same in the body's axes [rad/s].
template <BodyWithAxes B>
requires(B::dim == 3) Vector<3> body_angular_velocity(const Placed<B>& body, const VectorXd& q,
                                                      const VectorXd& v) {
  return detail::axes(body, q).transpose() * angular_velocity(body, q, v);
}

}  // namespace sphmbs::mbs::ncf
