// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::forces {

/// Element that knows the generalized force of a load along its line or over its surface.
template <class E>
concept Loadable = Part<E> && requires(const E e, const Vector<E::dim> f) {
  requires requires {
    { e.line_load(f) } -> std::convertible_to<Vector<E::dofs>>;
  } || requires {
    { e.surface_load(f) } -> std::convertible_to<Vector<E::dofs>>;
  };
};

/// Element that knows the force of a unit pressure that follows its surface, and its derivative.
template <class E>
concept Pressable = Part<E> && requires(const E e, const Vector<E::dofs> q) {
  { e.pressure_force(q) } -> std::convertible_to<Vector<E::dofs>>;
  { e.pressure_tangent(q) } -> std::convertible_to<Matrix<E::dofs, E::dofs>>;
};

/// Dead load spread evenly over an element: Q = int N^T f dX, per unstrained length of a cable or a
/// beam, per unstrained area of a plate.
template <Loadable E>
struct DistributedLoad {
  static constexpr bool is_load = true;  ///< statics raises it step by step, see `Load`

  Placed<E> on;                                        ///< the loaded element
  Vector<E::dim> value = Vector<E::dim>::Zero();       ///< f [N/m] or [N/m^2]
  std::function<Vector<E::dim>(double)> history = {};  ///< f(t); where given, in place of value
  std::string label = "distributed load";              ///< name in messages and reports
  Index own = on.index();                              ///< follows from the others

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return own; }

  void force(VectorIn, VectorIn, double t, VectorOut f) const {
    f += generalized(history ? history(t) : value);
  }
  void tangent(VectorIn, VectorIn, double, MatrixOut, MatrixOut) const {}

  /// V = -Q . q of a constant load; one that changes in time has none.
  bool conservative() const { return !history; }
  double potential(VectorIn q, double) const { return history ? 0.0 : -generalized(value).dot(q); }
  double dissipation(VectorIn, VectorIn, double) const { return 0; }
  ///@}

  /// @throws InvalidInput unless the load is finite.
  void check() const {
    expects(value.allFinite(), "value", value.transpose(), "finite [N/m] or [N/m^2]");
  }

 private:
  Vector<E::dofs> generalized(const Vector<E::dim>& f) const {
    if constexpr (requires { on.part.line_load(f); })
      return on.part.line_load(f);
    else
      return on.part.surface_load(f);
  }
};

/// Pressure that stays across the surface of a plate while it deforms, along the normal r_x x r_y
/// where positive: Q = p int N^T (r_x x r_y) dx dy.
template <Pressable E>
struct FollowerPressure {
  static constexpr bool is_load = true;  ///< statics raises it step by step, see `Load`

  Placed<E> on;                                ///< the loaded element
  double value = 0;                            ///< p [Pa]
  std::function<double(double)> history = {};  ///< p(t) [Pa]; where given, in place of value
  std::string label = "follower pressure";     ///< name in messages and reports
  Index own = on.index();                      ///< follows from the others

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return own; }
  double pressure(double t) const { return history ? history(t) : value; }

  void force(VectorIn q, VectorIn, double t, VectorOut f) const {
    f += pressure(t) * on.part.pressure_force(Vector<E::dofs>(q));
  }
  void tangent(VectorIn q, VectorIn, double t, MatrixOut k, MatrixOut) const {
    k += pressure(t) * on.part.pressure_tangent(Vector<E::dofs>(q));
  }

  double potential(VectorIn, double) const { return 0; }
  double dissipation(VectorIn, VectorIn, double) const { return 0; }
  ///@}

  /// @throws InvalidInput unless the pressure is finite.
  void check() const { expects(std::isfinite(value), "value", value, "finite [Pa]"); }
};

}  // namespace sphmbs::mbs::forces
