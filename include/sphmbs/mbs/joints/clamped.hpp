// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/mbs/joints/frame_conditions.hpp>
#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// Part b neither slides nor turns in a: 6 conditions in 3D, 3 in 2D. Deformable parts are held by
/// `clamped`, which also holds the lengths of gradients and the angles between them.
template <int Dim>
Joint<Dim> rigid(const Frame<Dim>& a, const Frame<Dim>& b, const VectorXd& q,
                 std::string_view name = "") {
  const std::string title = titled("rigid", name);
  return {title, {Held<Dim>{.a = a.origin, .b = b.origin}}, named(title, [&] {
            return orientation_conditions(a, b, q);
          })};
}

/// A point and vectors keep their values at q: Dim (1 + vectors) linear conditions. For elements
/// whose gradients are coordinates; of a rigid body, whose vectors are already held by rigidity,
/// some would be redundant: use `rigid`.
template <int Dim>
Joint<Dim> clamped(const Marker<Dim>& point, const std::vector<Marker<Dim>>& vectors,
                   const VectorXd& q, std::string_view name = "") {
  std::vector<Held<Dim>> held{Held<Dim>{.a = point, .b = ground<Dim>(point.at(q))}};
  for (const Marker<Dim>& vector : vectors)
    held.push_back({.a = vector,
                    .b = ground<Dim>(vector.at(q)),
                    .points = false,
                    .label = "vector " + std::to_string(held.size())});
  return {titled("clamped", name), std::move(held)};
}

/// A point and vectors of an element stay fixed to a rigid body, as they are at q:
/// Dim (1 + vectors) linear conditions.
/// @throws InvalidInput for a frame whose vectors lie in a plane.
template <int Dim>
Joint<Dim> clamped(const Marker<Dim>& point, const std::vector<Marker<Dim>>& vectors,
                   const Frame<Dim>& body, const VectorXd& q, std::string_view name = "") {
  const std::string title = titled("clamped", name);
  std::vector<Held<Dim>> held{Held<Dim>{.a = point, .b = body.origin}};
  for (const Marker<Dim>& vector : vectors)
    held.push_back({.a = vector,
                    .b = named(title, [&] { return fixed_to<Dim>(body, vector.at(q), q); }),
                    .points = false,
                    .label = "vector " + std::to_string(held.size())});
  return {title, std::move(held)};
}

/// A vector of b, such as the slope of a cable, keeps the direction in a that it has at q, free in
/// its length: Dim - 1 conditions.
/// @throws InvalidInput for a vector of no length or a frame whose vectors lie in a plane.
template <int Dim>
Joint<Dim> aligned(const Frame<Dim>& a, const Marker<Dim>& vector_b, const VectorXd& q,
                   std::string_view name = "") {
  const std::string title = titled("aligned", name);
  return {title, {}, named(title, [&] { return axis_conditions(a, vector_b, q); })};
}

}  // namespace sphmbs::mbs::joints
