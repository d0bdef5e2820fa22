// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs {

/// Element that can be asked for its gradients dr/dX_k where it is drawn.
template <class E>
concept Traceable = Element<E> && requires(const E element, const typename E::Material X) {
  { E::drawn } -> std::convertible_to<int>;
  { element.shape_gradient(X, 0) } -> std::same_as<Matrix<E::dim, E::dofs>>;
};

namespace detail {

/// One column for each material direction: dr/dX_k at X.
template <Traceable E>
Matrix<E::dim, E::Material::SizeAtCompileTime> gradients_at(const E& element,
                                                            const Vector<E::dofs>& q,
                                                            const typename E::Material& X) {
  Matrix<E::dim, E::Material::SizeAtCompileTime> g;
  for (int k = 0; k < g.cols(); ++k) g.col(k) = element.shape_gradient(X, k) * q;
  return g;
}

/// Ends of a line, corners of a surface.
template <Traceable E>
std::vector<typename E::Material> corners(const E& element) {
  if constexpr (E::drawn == 1)
    return {element.outline(0), element.outline(1)};
  else
    return {element.outline(0, 0), element.outline(1, 0), element.outline(1, 1),
            element.outline(0, 1)};
}

template <Traceable E>
typename E::Material middle(const E& element) {
  if constexpr (E::drawn == 1)
    return element.outline(0.5);
  else
    return element.outline(0.5, 0.5);
}

/// Sine of the angle between two gradients, or the volume that three unit ones span, right-handed.
template <class Gradients>
double spread(const Gradients& g) {
  if constexpr (Gradients::ColsAtCompileTime == 1)
    return 1;
  else if constexpr (Gradients::ColsAtCompileTime == 2)
    return g.col(0).cross(g.col(1)).norm() / (g.col(0).norm() * g.col(1).norm());
  else
    return g.colwise().normalized().determinant();
}

}  // namespace detail

/// Refuses coordinates at which an element has no shape: where a gradient has no length, gradients
/// are parallel or left-handed, or the middle runs against all corners, as it does when nodes are
/// swapped or at the same place.
/// @throws InvalidInput with the quantity and where on the element it is wrong.
template <Traceable E>
void check_placement(const E& element, const Vector<E::dofs>& q) {
  constexpr double nothing = 1e-6;
  const auto places = detail::corners(element);
  const auto middle = detail::gradients_at(element, q, detail::middle(element));
  Eigen::Array<bool, E::drawn, 1> backwards = Eigen::Array<bool, E::drawn, 1>::Constant(true);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto g = detail::gradients_at(element, q, places[i]);
    const std::string where =
        " at its node " + std::to_string(i + 1) + " of " + std::to_string(places.size());
    for (int k = 0; k < g.cols(); ++k)
      expects(g.col(k).norm() > nothing,
              "length of the gradient along X_" + std::to_string(k + 1) + where, g.col(k).norm(),
              "positive");
    expects(detail::spread(g) > nothing, "volume of the unit gradients" + where, detail::spread(g),
            "positive: gradients neither parallel nor left-handed");
    for (int k = 0; k < E::drawn; ++k)
      if (g.col(k).dot(middle.col(k)) > 0) backwards[k] = false;
  }
  for (int k = 0; k < E::drawn; ++k)
    expects(!backwards[k], "course along X_" + std::to_string(k + 1), "backwards",
            "forwards: its nodes are at the same place, or in the wrong order");
  expects(std::isfinite(element.strain_energy(q)), "strain energy of the initial shape",
          element.strain_energy(q), "finite [J]");
}

}  // namespace sphmbs::mbs
