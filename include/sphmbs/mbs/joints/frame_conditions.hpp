// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <sphmbs/mbs/joints/condition.hpp>
#include <sphmbs/mbs/joints/frame.hpp>

namespace sphmbs::mbs::joints {

/// u.axis = 0 for the Dim - 1 vectors u of a that are perpendicular to the axis of b at q: a vector
/// of b keeps its direction in a.
template <int Dim>
std::vector<Product<Dim>> axis_conditions(const Frame<Dim>& a, const Marker<Dim>& axis,
                                          const VectorXd& q) {
  const double scale = 1 / axis.at(q).norm();
  std::vector<Product<Dim>> products;
  for (const Marker<Dim>& u : across<Dim>(a, direction(axis, q), q))
    products.push_back(Product<Dim>{.terms = {{{u, Role::vector_of_a}, {axis, Role::vector_of_b}}},
                                    .scale = scale,
                                    .label = "axis " + std::to_string(products.size() + 1)});
  return products;
}

/// u.(point_a - point_b) = 0 for the Dim - 1 vectors u of a that are perpendicular to d at q: the
/// point of b stays on a line of a.
template <int Dim>
std::vector<Product<Dim>> line_conditions(const Frame<Dim>& a, const Marker<Dim>& point_b,
                                          const Vector<Dim>& d, const VectorXd& q) {
  const Marker<Dim> gap = a.origin - point_b;
  std::vector<Product<Dim>> products;
  for (const Marker<Dim>& u : across<Dim>(a, d, q))
    products.push_back({.terms = {{{u, Role::vector_of_a}, {gap, Role::gap}}},
                        .label = "line " + std::to_string(products.size() + 1)});
  return products;
}

/// u1.w2 = 0, u2.w3 = 0, u3.w1 = 0 with the vectors u of a and w of b that are one orthonormal set
/// at q: b keeps its orientation in a. In 2D u1.w2 = 0. The derivative by a small rotation is the
/// unit matrix.
template <int Dim>
std::vector<Product<Dim>> orientation_conditions(const Frame<Dim>& a, const Frame<Dim>& b,
                                                 const VectorXd& q) {
  constexpr int rotations = Dim == 2 ? 1 : 3;
  std::vector<Product<Dim>> products;
  for (int k = 0; k < rotations; ++k)
    products.push_back(
        {.terms = {{{fixed_to<Dim>(a, Vector<Dim>::Unit(k), q), Role::vector_of_a},
                    {fixed_to<Dim>(b, Vector<Dim>::Unit((k + 1) % Dim), q), Role::vector_of_b}}},
         .label = "rotation " + std::to_string(k + 1)});
  return products;
}

/// The conditions of both.
template <int Dim>
std::vector<Product<Dim>> both(std::vector<Product<Dim>> a, const std::vector<Product<Dim>>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace sphmbs::mbs::joints
