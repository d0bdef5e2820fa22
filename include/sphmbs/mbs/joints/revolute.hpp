// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include <sphmbs/mbs/joints/frame_conditions.hpp>
#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// Two parts turn about a common point of the plane: 2 conditions.
inline Joint<2> revolute(const Marker<2>& a, const Marker<2>& b, std::string_view name = "") {
  return {titled("revolute", name), {Held<2>{.a = a, .b = b}}};
}

/// Part b turns about an axis fixed in a and in b: 5 conditions. The axis is a vector of b, such as
/// `body.vector(X0, X1)` or a gradient; its direction in a is the one that it has at q.
/// @throws InvalidInput for an axis of no length or a frame whose vectors lie in a plane.
template <int Dim>
requires(Dim == 3) Joint<Dim> revolute(const Frame<Dim>& a, const Marker<Dim>& point_b,
                                       const Marker<Dim>& axis_b, const VectorXd& q,
                                       std::string_view name = "") {
  const std::string title = titled("revolute", name);
  return {title, {Held<Dim>{.a = a.origin, .b = point_b}}, named(title, [&] {
            return axis_conditions(a, axis_b, q);
          })};
}

/// Two shafts stay in one point, and a vector of one perpendicular to a vector of the other (the
/// cross of a Cardan joint): 4 conditions.
/// @throws InvalidInput unless the two are perpendicular at q, to 0.1.
template <int Dim>
requires(Dim == 3) Joint<Dim> universal(const Marker<Dim>& point_a, const Marker<Dim>& axis_a,
                                        const Marker<Dim>& point_b, const Marker<Dim>& axis_b,
                                        const VectorXd& q, std::string_view name = "") {
  constexpr double largest = 0.1;
  const std::string title = titled("universal", name);
  const double cosine =
      named(title, [&] { return direction(axis_a, q).dot(direction(axis_b, q)); });
  expects(std::abs(cosine) <= largest, title + ": cosine between the axes", cosine,
          "0: they are the two arms of the cross");
  return {title,
          {Held<Dim>{.a = point_a, .b = point_b}},
          {Product<Dim>{.terms = {{{axis_a, Role::vector_of_a}, {axis_b, Role::vector_of_b}}},
                        .scale = 1 / (axis_a.at(q).norm() * axis_b.at(q).norm()),
                        .label = "cross"}}};
}

}  // namespace sphmbs::mbs::joints
