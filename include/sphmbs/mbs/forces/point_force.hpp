// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>

namespace sphmbs::mbs::forces {

/// Dead load F at a point: Q = N^T F, for a force that keeps its direction. On a marker of Dim
/// coordinates (`coordinates({k})`) it is a generalized force.
template <int Dim>
struct PointForce {
  static constexpr bool is_load = true;  ///< statics raises it step by step, see `Load`

  Marker<Dim> at = {};                              ///< point of attack
  Vector<Dim> value = Vector<Dim>::Zero();          ///< F [N]
  std::function<Vector<Dim>(double)> history = {};  ///< F(t) [N]; where given, in place of value
  std::string label = "point force";                ///< name in messages and reports

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return at.index; }
  Vector<Dim> load(double t) const { return history ? history(t) : value; }

  void force(VectorIn, VectorIn, double t, VectorOut f) const { add_force<Dim>(at, load(t), f); }
  void tangent(VectorIn, VectorIn, double, MatrixOut, MatrixOut) const {}

  /// V = -F . x of a constant force; one that changes in time has none.
  bool conservative() const { return !history; }
  double potential(VectorIn q, double) const { return history ? 0.0 : -value.dot(at.local(q)); }
  double dissipation(VectorIn, VectorIn, double) const { return 0; }
  ///@}

  /// @throws InvalidInput unless the force is finite and at a point that can move.
  void check() const {
    expects(value.allFinite(), "value", value.transpose(), "finite [N]");
    expects(at.N.size() > 0, "at", "missing", "a point of a part");
  }
};

static_assert(Load<PointForce<1>> && Load<PointForce<2>> && Load<PointForce<3>>);

}  // namespace sphmbs::mbs::forces
