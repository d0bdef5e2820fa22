// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <sphmbs/mbs/joints/frame_conditions.hpp>
#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// Part b turns about an axis fixed in both and slides along it: 4 conditions. The axis is a vector
/// of b through its point; its direction in a, through the origin of the frame, is that at q.
/// @throws InvalidInput for an axis of no length or a frame whose vectors lie in a plane.
inline Joint<3> cylindrical(const Frame<3>& a, const Marker<3>& point_b, const Marker<3>& axis_b,
                            const VectorXd& q, std::string_view name = "") {
  const std::string title = titled("cylindrical", name);
  return named(title, [&]() -> Joint<3> {
    return {title,
            {},
            both(axis_conditions(a, axis_b, q),
                 line_conditions<3>(a, point_b, direction(axis_b, q), q))};
  });
}

/// Part b slides along a direction of a, without turning: 5 conditions in 3D, 2 in 2D. The
/// direction is a vector, of b or of the ground, at q.
/// @throws InvalidInput for a direction of no length or a frame whose vectors lie in a plane.
template <int Dim>
Joint<Dim> prismatic(const Frame<Dim>& a, const Frame<Dim>& b, const Marker<Dim>& along,
                     const VectorXd& q, std::string_view name = "") {
  const std::string title = titled("prismatic", name);
  return named(title, [&]() -> Joint<Dim> {
    return {title,
            {},
            both(orientation_conditions(a, b, q),
                 line_conditions<Dim>(a, b.origin, direction(along, q), q))};
  });
}

}  // namespace sphmbs::mbs::joints
