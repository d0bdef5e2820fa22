// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/cross.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>

namespace sphmbs::mbs::forces {

/// Couple m, a vector of fixed direction, on a spatial part that turns with two of its vectors u
/// and w (a rigid body's, or gradients): virtual work m . delta phi, phi the turning of the triad
/// of u, u x w and their product. With n = u x w and g = n / |n|^2,
///   Q_u = m x u / |u|^2 - (m . u) (u . w) / |u|^2 g,    Q_w = (m . u) g,
/// whose moment u x Q_u + w x Q_w is m. The part of m along n acts on u alone: where u and w may
/// shear against each other, as the directors of a beam's end do, take two couples of half the
/// moment on (u, w) and on (w, u). With the second pair, another part takes -m.
struct Couple {
  static constexpr bool is_load = true;  ///< statics raises it step by step, see `Load`
  static constexpr int dim = 3;          ///< dimension of space

  Marker<3> u = {};                     ///< a vector of the part
  Marker<3> w = {};                     ///< another one, not along u
  Marker<3> against_u = {};             ///< takes the reaction; the ground does by default
  Marker<3> against_w = {};             ///< the second vector of what takes it
  Vector<3> value = Vector<3>::Zero();  ///< m [N m]
  std::function<Vector<3>(double)> history = {};  ///< m(t) [N m]; where given, in place of value
  std::string label = "couple";                   ///< name in messages and reports
  Marker<12> y = stacked(u, w, against_u, against_w);  ///< follows from the others

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return y.index; }
  Vector<3> load(double t) const { return history ? history(t) : value; }

  void force(VectorIn q, VectorIn, double t, VectorOut f) const {
    const Vector<12> now = y.local(q);
    Vector<12> Q = Vector<12>::Zero();
    Q.head<6>() = on_pair(now.head<6>(), load(t));
    if (reacts()) Q.tail<6>() = on_pair(now.tail<6>(), -load(t));
    add_force(y, Q, f);
  }

  void tangent(VectorIn q, VectorIn, double t, MatrixOut k, MatrixOut) const {
    const Vector<12> now = y.local(q);
    Matrix<12, 12> K = Matrix<12, 12>::Zero();
    K.topLeftCorner<6, 6>() = slope(now.head<6>(), load(t));
    if (reacts()) K.bottomRightCorner<6, 6>() = slope(now.tail<6>(), -load(t));
    add_tangent(y, K, k);
  }

  double potential(VectorIn, double) const { return 0; }  ///< its work depends on the way
  double dissipation(VectorIn, VectorIn, double) const { return 0; }
  ///@}

  /// @throws InvalidInput unless the couple is finite and the vectors are given in pairs.
  void check() const {
    expects(value.allFinite(), "value", value.transpose(), "finite [N m]");
    expects(!is_zero(u) && !is_zero(w), "u, w", "zero", "two vectors of a part");
    expects(is_zero(against_u) == is_zero(against_w), "against_u, against_w", "one of them zero",
            "two vectors of a part, or none");
  }

 private:
  bool reacts() const { return !is_zero(against_u); }

  Vector<6> on_pair(const Vector<6>& pair, const Vector<3>& m) const {
    const Vector<3> a = pair.head<3>(), b = pair.tail<3>(), n = a.cross(b);
    needs_direction(n.norm(), label, "the product of its two vectors");
    const Vector<3> g = n / n.squaredNorm();
    const double a2 = a.squaredNorm(), along = m.dot(a);
    Vector<6> Q;
    Q << (m.cross(a) - along * a.dot(b) * g) / a2, along * g;
    return Q;
  }

  static Matrix<6, 6> slope(const Vector<6>& pair, const Vector<3>& m) {
    const Vector<3> a = pair.head<3>(), b = pair.tail<3>(), n = a.cross(b);
    const double n2 = n.squaredNorm(), a2 = a.squaredNorm(), along = m.dot(a);
    const Vector<3> g = n / n2;
    const Matrix<3, 3> dg_dn = Matrix<3, 3>::Identity() / n2 - 2 * g * g.transpose();
    Matrix<3, 6> dg;
    dg << -dg_dn * skew(b), dg_dn * skew(a);
    const double share = a.dot(b) / a2;
    Vector<6> dshare;
    dshare << (b - 2 * share * a) / a2, a / a2;
    Matrix<6, 6> K;
    K << -along * (share * dg + g * dshare.transpose()), along * dg;
    K.topLeftCorner<3, 3>() +=
        skew(m) / a2 - 2 / (a2 * a2) * m.cross(a) * a.transpose() - share * g * m.transpose();
    K.bottomLeftCorner<3, 3>() += g * m.transpose();
    return K;
  }
};

static_assert(Load<Couple>);

}  // namespace sphmbs::mbs::forces
