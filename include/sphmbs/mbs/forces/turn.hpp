// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include <sphmbs/mbs/forces/cross.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>

namespace sphmbs::mbs::forces {

/// How a vector turns about an axis: its rate of turning is g . dy/dt, and a unit moment on it is
/// the generalized force g.
///   y(axis, u), size   what it looks at, and how long that is
///   moment(y)          g, @throws NumericalFailure where u has no direction across the axis
///   slope(y)           dg/dy
///   angle(from, to)    between two vectors about the same axis, in (-pi, pi]
template <int Dim>
struct Turn;

/// In the plane, y = u and g = J u / |u|^2, J the quarter turn: the gradient of the angle of u.
template <>
struct Turn<2> {
  ///@{ See the template.
  static constexpr int size = 2;

  static Marker<2> y(const Marker<2>&, const Marker<2>& u) { return u; }

  static Vector<2> moment(const Vector<2>& u, const std::string& name) {
    needs_direction(u.norm(), name, "a vector that it turns");
    return quarter_turn(u) / u.squaredNorm();
  }

  static Matrix<2, 2> slope(const Vector<2>& u) {
    const double u2 = u.squaredNorm();
    return (quarter_turn() - 2 / u2 * quarter_turn(u) * u.transpose()) / u2;
  }

  static double angle(const Vector<2>& from, const Vector<2>& to) {
    return std::atan2(quarter_turn(from).dot(to), from.dot(to));
  }
  ///@}
};

/// In space, about an axis a, y = (a, u): p = a x u, h = |a| p / |p|^2 turns u, and the axis, where
/// it can move, takes what u has along it: g = (-(a . u) / |a|^2 h, h). The total moment
/// a x g_a + u x g_u is a / |a| for every a and u, and with two vectors g_2 - g_1 is the gradient
/// of the angle between them, seen along the axis.
template <>
struct Turn<3> {
  ///@{ See the template.
  static constexpr int size = 6;

  static Marker<6> y(const Marker<3>& axis, const Marker<3>& u) { return stacked(axis, u); }

  static Vector<6> moment(const Vector<6>& y, const std::string& name) {
    const Vector<3> a = y.head<3>(), u = y.tail<3>(), p = a.cross(u);
    needs_direction(p.norm(), name, "the part across its axis of a vector that it turns");
    const Vector<3> h = a.norm() / p.squaredNorm() * p;
    Vector<6> g;
    g << -a.dot(u) / a.squaredNorm() * h, h;
    return g;
  }

  static Matrix<6, 6> slope(const Vector<6>& y) {
    const Vector<3> a = y.head<3>(), u = y.tail<3>(), p = a.cross(u);
    const double a2 = a.squaredNorm(), length = std::sqrt(a2), p2 = p.squaredNorm();
    const Vector<3> h = length / p2 * p;
    const Matrix<3, 3> by_p = length / p2 * (Matrix<3, 3>::Identity() - 2 / p2 * p * p.transpose());
    Matrix<3, 6> dh;
    dh << p * a.transpose() / (length * p2) - by_p * skew(u), by_p * skew(a);
    const double share = a.dot(u) / a2;
    Vector<6> dshare;
    dshare << (u - 2 * share * a) / a2, a / a2;
    Matrix<6, 6> K;
    K << -share * dh - h * dshare.transpose(), dh;
    return K;
  }

  static double angle(const Vector<6>& from, const Vector<6>& to) {
    const Vector<3> a = from.head<3>(), p = a.cross(from.tail<3>());
    return std::atan2(a.norm() * p.dot(to.tail<3>()), p.dot(a.cross(to.tail<3>())));
  }
  ///@}
};

}  // namespace sphmbs::mbs::forces
