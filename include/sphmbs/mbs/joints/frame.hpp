// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::joints {

/// Where a joint sits on a part: a point, and as many vectors of the part, not in a plane, as the
/// space has dimensions. They need not be unit nor perpendicular: gradients serve as well as the
/// vectors of a rigid body.
template <int Dim>
struct Frame {
  Marker<Dim> origin;  ///< a point
  /// Orthonormal, and turning with the body.
  std::array<Marker<Dim>, static_cast<std::size_t>(Dim)> vectors;
};

/// The frame of a rigid body at X, along the body's axes.
template <Body B>
requires std::same_as<typename B::Material, Vector<B::dim>> Frame<B::dim> frame(
    const Placed<B>& body, const Vector<B::dim>& X = Vector<B::dim>::Zero()) {
  Frame<B::dim> f{.origin = body.point(X), .vectors = {}};
  for (int k = 0; k < B::dim; ++k)
    f.vectors[static_cast<std::size_t>(k)] =
        body.vector(Vector<B::dim>::Zero(), Vector<B::dim>::Unit(k));
  return f;
}

/// The frame of a fully parameterised element at X, along its gradients.
template <Element E>
requires std::same_as<typename E::Material, Vector<E::dim>> Frame<E::dim> frame(
    const Placed<E>& element, const Vector<E::dim>& X) {
  Frame<E::dim> f{.origin = element.point(X), .vectors = {}};
  for (int k = 0; k < E::dim; ++k) f.vectors[static_cast<std::size_t>(k)] = element.gradient(X, k);
  return f;
}

/// The ground's frame at a place.
template <int Dim>
Frame<Dim> ground_frame(const Vector<Dim>& place) {
  Frame<Dim> f{.origin = ground<Dim>(place), .vectors = {}};
  for (int k = 0; k < Dim; ++k)
    f.vectors[static_cast<std::size_t>(k)] = ground<Dim>(Vector<Dim>::Unit(k));
  return f;
}

/// The vector of the frame's part that is `direction` at q.
/// @throws InvalidInput where the frame's vectors do not span the space.
template <int Dim>
Marker<Dim> fixed_to(const Frame<Dim>& frame, const Vector<Dim>& direction, const VectorXd& q) {
  constexpr double flat = 1e-8, nothing = 1e-14;
  Matrix<Dim, Dim> vectors;
  double volume = 1;
  for (int k = 0; k < Dim; ++k) {
    vectors.col(k) = frame.vectors[static_cast<std::size_t>(k)].at(q);
    volume *= vectors.col(k).norm();
  }
  const double share = std::abs(vectors.determinant()) / volume;
  expects(share > flat, "volume between the unit vectors of the frame", share,
          "positive: the vectors are parallel or in a plane");
  const Vector<Dim> c = vectors.inverse() * direction;
  Marker<Dim> sum;
  for (int k = 0; k < Dim; ++k)
    if (std::abs(c[k]) > nothing * c.cwiseAbs().maxCoeff())
      sum = combined(sum, c[k], frame.vectors[static_cast<std::size_t>(k)]);
  return sum;
}

/// The direction of a vector at q.
/// @throws InvalidInput for a vector of no length.
template <int Dim>
Vector<Dim> direction(const Marker<Dim>& vector, const VectorXd& q) {
  const Vector<Dim> x = vector.at(q);
  expects(x.norm() > 0 && x.allFinite(), "length of the axis", x.norm(), "positive");
  return x.normalized();
}

/// Vectors of the frame's part that are, at q, unit vectors perpendicular to the unit vector d and
/// to each other; with d as the last one they are right-handed in 3D.
template <int Dim>
std::array<Marker<Dim>, static_cast<std::size_t>(Dim - 1)> across(const Frame<Dim>& frame,
                                                                  const Vector<Dim>& d,
                                                                  const VectorXd& q) {
  const Vector<Dim> first = d.unitOrthogonal();
  if constexpr (Dim == 2) {
    return {fixed_to<Dim>(frame, first, q)};
  } else {
    return {fixed_to<Dim>(frame, first, q), fixed_to<Dim>(frame, d.cross(first), q)};
  }
}

/// What `make` returns; names the joint where it complains of bad input.
template <class Make>
auto named(const std::string& joint, Make&& make) {
  try {
    return make();
  } catch (const InvalidInput& error) {
    throw InvalidInput(joint + ": " + error.what());
  }
}

}  // namespace sphmbs::mbs::joints
