// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <string>
#include <string_view>

#include <sphmbs/mbs/joints/frame.hpp>
#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// vector.(cos(angle) e2 - sin(angle) e1) / length = 0 with e1 and e2 turning with a: the sine of
/// the error in the angle from e1 to the vector. It is regular for all angles, and also 0 half a
/// turn further on: the start decides.
template <int Dim>
Product<Dim> angle_condition(const Factor<Dim>& e1, const Factor<Dim>& e2,
                             const Factor<Dim>& vector, const TimeFunction& angle, double length) {
  constexpr double quarter = std::numbers::pi / 2;
  return {
      .terms = {{e2, vector, cosine_of(angle, 1, 0)}, {e1, vector, cosine_of(angle, -1, -quarter)}},
      .scale = 1 / length,
      .label = "angle"};
}

/// A vector in the plane has a given angle from the x axis [rad]: 1 rheonomic condition.
/// @throws InvalidInput for a vector of no length at q.
inline Joint<2> driven_angle(const Marker<2>& vector, const TimeFunction& angle, const VectorXd& q,
                             std::string_view name = "") {
  const std::string title = titled("driven angle", name);
  named(title, [&] { return direction(vector, q); });
  return {title,
          {},
          {angle_condition<2>({ground<2>({1, 0}), Role::fixed}, {ground<2>({0, 1}), Role::fixed},
                              {vector, Role::vector_of_a}, angle, vector.at(q).norm())}};
}

/// Part b turns in the plane against a by a given angle since q [rad]: 1 rheonomic condition.
/// @param vector_b any vector of b
/// @throws InvalidInput for a vector of no length or a frame whose vectors are parallel.
inline Joint<2> driven_rotation(const Frame<2>& a, const Marker<2>& vector_b,
                                const TimeFunction& angle, const VectorXd& q,
                                std::string_view name = "") {
  const std::string title = titled("driven rotation", name);
  return named(title, [&]() -> Joint<2> {
    const Vector<2> e1 = direction(vector_b, q), e2(-e1[1], e1[0]);
    return {title,
            {},
            {angle_condition<2>({fixed_to<2>(a, e1, q), Role::vector_of_a},
                                {fixed_to<2>(a, e2, q), Role::vector_of_a},
                                {vector_b, Role::vector_of_b}, angle, vector_b.at(q).norm())}};
  });
}

/// Part b turns against a about an axis by a given angle since q [rad]: 1 rheonomic condition,
/// beside a revolute or cylindrical joint with that axis.
/// @param axis the axis at q; its length does not matter
/// @param vector_b a vector of b that is not parallel to it
/// @throws InvalidInput for an axis of no length, a vector parallel to it or a frame whose vectors
/// lie in a plane.
inline Joint<3> driven_rotation(const Frame<3>& a, const Marker<3>& axis, const Marker<3>& vector_b,
                                const TimeFunction& angle, const VectorXd& q,
                                std::string_view name = "") {
  constexpr double parallel = 1e-3;
  const std::string title = titled("driven rotation", name);
  return named(title, [&]() -> Joint<3> {
    const Vector<3> n = direction(axis, q), w = vector_b.at(q), e = w - n * n.dot(w);
    const double sine = e.norm() / w.norm();
    expects(sine > parallel, "sine between axis and vector", sine, "positive: they are parallel");
    const Vector<3> e1 = e.normalized();
    return {title,
            {},
            {angle_condition<3>({fixed_to<3>(a, e1, q), Role::vector_of_a},
                                {fixed_to<3>(a, n.cross(e1), q), Role::vector_of_a},
                                {vector_b, Role::vector_of_b}, angle, e.norm())}};
  });
}

}  // namespace sphmbs::mbs::joints
