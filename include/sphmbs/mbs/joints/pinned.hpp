// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// The point keeps its place at q: Dim conditions.
template <int Dim>
Joint<Dim> pinned(const Marker<Dim>& point, const VectorXd& q, std::string_view name = "") {
  return {titled("pinned", name), {Held<Dim>{.a = point, .b = ground<Dim>(point.at(q))}}};
}

/// Two points stay together, or a point stays at one of the ground: Dim conditions. In 2D this is a
/// revolute joint, in 3D a spherical one.
template <int Dim>
Joint<Dim> coincident(const Marker<Dim>& a, const Marker<Dim>& b, std::string_view name = "") {
  return {titled("coincident", name), {Held<Dim>{.a = a, .b = b}}};
}
/// Two points of space stay together: a ball joint, 3 conditions.
template <int Dim>
requires(Dim == 3) Joint<Dim> spherical(const Marker<Dim>& a, const Marker<Dim>& b,
                                        std::string_view name = "") {
  return {titled("spherical", name), {Held<Dim>{.a = a, .b = b}}};
}

/// The point follows a path: Dim rheonomic conditions.
template <int Dim>
Joint<Dim> driven(const Marker<Dim>& point, const Path<Dim>& path, std::string_view name = "") {
  return {titled("driven", name), {Held<Dim>{.a = point, .path = path}}};
}

/// A component of a point or vector has a given value: axis.x = value(t), one condition.
/// @throws InvalidInput unless the axis is a unit vector.
template <int Dim>
Joint<Dim> component(const Marker<Dim>& x, const std::type_identity_t<Vector<Dim>>& axis,
                     const TimeFunction& value, std::string_view name = "") {
  constexpr double rounding = 1e-8;
  const std::string title = titled("component", name);
  expects(std::abs(axis.norm() - 1) <= rounding, title + ": length of the axis", axis.norm(), "1");
  return {title,
          {},
          {Product<Dim>{.terms = {{{ground<Dim>(axis), Role::fixed}, {x, Role::gap}}},
                        .c = value,
                        .label = "component"}}};
}

}  // namespace sphmbs::mbs::joints
