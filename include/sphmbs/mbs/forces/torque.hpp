// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/turn.hpp>

namespace sphmbs::mbs::forces {

/// Moment M on a vector of a part, a rigid body's or a cable's tangent: virtual work M times the
/// angle through which the vector turns. In the plane Q = N^T M J u / |u|^2, counter-clockwise; in
/// space about an axis of the ground or of a part, Q = N^T M a x u / |u|^2 for u across a unit axis
/// (forces/turn.hpp has the general formula). With `against`, a vector of another part takes -M.
template <int Dim>
struct Torque {
  static constexpr bool is_load = true;  ///< statics raises it step by step, see `Load`

  Marker<Dim> on = {};                         ///< u
  Marker<Dim> against = {};                    ///< takes the reaction; the ground does by default
  Marker<Dim> axis = {};                       ///< a, in space
  double value = 0;                            ///< M [N m]
  std::function<double(double)> history = {};  ///< M(t) [N m]; where given, in place of value
  std::string label = "torque";                ///< name in messages and reports
  /// Vectors that turn, on all their coordinates; follows from the others.
  Marker<2 * Turn<Dim>::size> y = stacked(Turn<Dim>::y(axis, on), Turn<Dim>::y(axis, against));

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return y.index; }
  double load(double t) const { return history ? history(t) : value; }

  void force(VectorIn q, VectorIn, double t, VectorOut f) const {
    const Vector<2 * half> now = y.local(q);
    Vector<2 * half> Q = Vector<2 * half>::Zero();
    Q.template head<half>() = load(t) * Turn<Dim>::moment(now.template head<half>(), label);
    if (reacts())
      Q.template tail<half>() = -load(t) * Turn<Dim>::moment(now.template tail<half>(), label);
    add_force(y, Q, f);
  }

  void tangent(VectorIn q, VectorIn, double t, MatrixOut k, MatrixOut) const {
    const Vector<2 * half> now = y.local(q);
    Matrix<2 * half, 2 * half> K = Matrix<2 * half, 2 * half>::Zero();
    K.template topLeftCorner<half, half>() = load(t) * Turn<Dim>::slope(now.template head<half>());
    if (reacts())
      K.template bottomRightCorner<half, half>() =
          -load(t) * Turn<Dim>::slope(now.template tail<half>());
    add_tangent(y, K, k);
  }

  double potential(VectorIn, double) const { return 0; }  ///< its work grows with every turn
  double dissipation(VectorIn, VectorIn, double) const { return 0; }
  ///@}

  /// @throws InvalidInput unless the moment is finite, and the vector and the axis are given.
  void check() const {
    expects(std::isfinite(value), "value", value, "finite [N m]");
    expects(!is_zero(on), "on", "zero", "a vector of a part");
    if constexpr (Dim == 3) expects(!is_zero(axis), "axis", "zero", "a vector");
  }

 private:
  static constexpr int half = Turn<Dim>::size;
  bool reacts() const { return !is_zero(against); }
};

static_assert(Load<Torque<2>> && Load<Torque<3>>);

}  // namespace sphmbs::mbs::forces
