// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/cross.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>

namespace sphmbs::mbs::forces {

/// Force that turns with vectors of a part: Q = N^T (F1 e1 + F2 e2 [+ F3 e3]), e1 = u / |u|, and
///   in the plane  e2 = e1 turned by a quarter turn, counter-clockwise;
///   in space      e3 = u x w / |u x w|, e2 = e3 x e1.
/// u is a vector of a body, or a gradient: the tangent of a cable, with its normal e2. The force
/// has no potential and its tangent is not symmetric.
template <int Dim>
struct FollowerForce {
  static constexpr bool is_load = true;  ///< statics raises it step by step, see `Load`

  Marker<Dim> at = {};                              ///< point of attack
  Marker<Dim> along = {};                           ///< u
  Marker<Dim> beside = {};                          ///< w; in space, and there only for F2 and F3
  Vector<Dim> value = Vector<Dim>::Zero();          ///< F1, F2, F3 [N]
  std::function<Vector<Dim>(double)> history = {};  ///< F(t) [N]; where given, in place of value
  std::string label = "follower force";             ///< name in messages and reports
  Marker<3 * Dim> y = stacked(at, along, beside);   ///< follows from the others

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return y.index; }
  Vector<Dim> load(double t) const { return history ? history(t) : value; }

  void force(VectorIn q, VectorIn, double t, VectorOut f) const {
    Vector<3 * Dim> F = Vector<3 * Dim>::Zero();
    F.template head<Dim>() = turned(y.local(q), load(t)).force;
    add_force(y, F, f);
  }

  void tangent(VectorIn q, VectorIn, double t, MatrixOut k, MatrixOut) const {
    Matrix<3 * Dim, 3 * Dim> K = Matrix<3 * Dim, 3 * Dim>::Zero();
    K.template topRightCorner<Dim, 2 * Dim>() = turned(y.local(q), load(t)).slope;
    add_tangent(y, K, k);
  }

  double potential(VectorIn, double) const { return 0; }
  double dissipation(VectorIn, VectorIn, double) const { return 0; }
  ///@}

  /// @throws InvalidInput unless the force is finite and the vectors that it needs are given.
  void check() const {
    expects(value.allFinite(), "value", value.transpose(), "finite [N]");
    expects(at.N.size() > 0, "at", "missing", "a point of a part");
    expects(!is_zero(along), "along", "zero", "a vector that the force turns with");
    if constexpr (Dim == 3)
      expects((!history && value.template tail<2>().isZero(0.0)) || !is_zero(beside), "beside",
              "zero", "a second vector, for a force that is not along the first");
  }

 private:
  struct Turned {
    Vector<Dim> force;
    Matrix<Dim, 2 * Dim> slope;  // in u and w
  };

  Turned turned(const Vector<3 * Dim>& now, const Vector<Dim>& F) const {
    const Vector<Dim> u = now.template segment<Dim>(Dim);
    const double length = u.norm();
    needs_direction(length, label, "the vector along it");
    const Direction<Dim> e1(u, length);
    Turned result{F[0] * e1.along, Matrix<Dim, 2 * Dim>::Zero()};
    result.slope.template leftCols<Dim>() = F[0] * e1.slope;
    if constexpr (Dim == 2) {
      const Vector<2> e2 = quarter_turn(e1.along);
      result.force += F[1] * e2;
      result.slope.template leftCols<2>() -= F[1] / length * e1.along * e2.transpose();
    } else if (F[1] != 0 || F[2] != 0) {
      const Vector<3> w = now.template tail<3>(), normal = u.cross(w);
      const double area = normal.norm();
      needs_direction(area, label, "the normal of its two vectors");
      const Direction<3> e3(normal, area);
      result.force += F[1] * e3.along.cross(e1.along) + F[2] * e3.along;
      result.slope.template leftCols<3>() += F[1] * skew(e3.along) * e1.slope;
      const Matrix<3, 3> turn =
          (F[2] * Matrix<3, 3>::Identity() - F[1] * skew(e1.along)) * e3.slope;
      result.slope.template leftCols<3>() -= turn * skew(w);
      result.slope.template rightCols<3>() += turn * skew(u);
    }
    return result;
  }
};

static_assert(Load<FollowerForce<2>> && Load<FollowerForce<3>>);

}  // namespace sphmbs::mbs::forces
