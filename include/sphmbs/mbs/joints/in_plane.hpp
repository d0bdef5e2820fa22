// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <sphmbs/mbs/joints/frame_conditions.hpp>
#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// A point of b stays on a line of a through the frame's origin: Dim - 1 conditions. The line has
/// the direction of a vector, of a or of the ground, at q.
template <int Dim>
Joint<Dim> in_line(const Frame<Dim>& a, const Marker<Dim>& point_b, const Marker<Dim>& along,
                   const VectorXd& q, std::string_view name = "") {
  const std::string title = titled("in line", name);
  return named(title, [&]() -> Joint<Dim> {
    return {title, {}, line_conditions<Dim>(a, point_b, direction(along, q), q)};
  });
}

/// A point of b stays in the plane (2D: on the line) of a through a point and perpendicular to a
/// vector of a: 1 condition.
/// @throws InvalidInput for a normal of no length.
template <int Dim>
Joint<Dim> in_plane(const Marker<Dim>& point_a, const Marker<Dim>& normal_a,
                    const Marker<Dim>& point_b, const VectorXd& q, std::string_view name = "") {
  const std::string title = titled("in plane", name);
  named(title, [&] { return direction(normal_a, q); });
  return {title,
          {},
          {Product<Dim>{.terms = {{{normal_a, Role::vector_of_a}, {point_a - point_b, Role::gap}}},
                        .scale = 1 / normal_a.at(q).norm(),
                        .label = "plane"}}};
}

}  // namespace sphmbs::mbs::joints
