// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include <sphmbs/mbs/placed.hpp>
#include <sphmbs/particles/cloud.hpp>

namespace sphmbs::coupling {

/// A vector of gas as one of a structure in the plane or in space; what is missing is zero.
template <int Space, int Dim>
mbs::Vector<Space> in_space(const Vec<Dim>& x) {
  mbs::Vector<Space> y = mbs::Vector<Space>::Zero();
  for (int k = 0; k < Dim; ++k) y[k] = x[k];
  return y;
}

/// What a virtual particle rides on: the material point `at` of a body, or one off it along the
/// surface's normal.
template <int Space>
struct WettedPoint {
  mbs::Marker<Space> at;           ///< [m]
  mbs::Marker<Space> normal = {};  ///< of the surface, out of the body, of any length; may be empty
  double offset = 0;               ///< of the particle from `at` along the normal [m]
  /// In space, in place of a normal: two vectors along the surface, whose product a x b it is.
  std::array<mbs::Marker<Space>, 2> along = {};

  /// Normal of the surface at coordinates q, of any length.
  mbs::Vector<Space> normal_at(const mbs::VectorXd& q) const {
    if constexpr (Space == 3)
      return normal.at(q) + along[0].at(q).cross(along[1].at(q));
    else
      return normal.at(q);
  }
};

/// The points of a rigid body where a set's particles are at the start, with the normals that the
/// cloud has for them.
/// @param body  whose material coordinates are as many as the structure has dimensions
/// @param q     coordinates of the structure
template <mbs::Part Body, int Dim>
requires(Body::Material::RowsAtCompileTime == Body::dim)
    std::vector<WettedPoint<Body::dim>> points_of(const mbs::Placed<Body>& body,
                                                  const mbs::VectorXd& q,
                                                  const particles::Cloud<Dim>& cloud, int set) {
  using Material = typename Body::Material;
  using Vector = mbs::Vector<Body::dim>;
  const Vector origin = body.point(Material::Zero()).at(q);
  mbs::Matrix<Body::dim, Body::dim> axes;
  for (int k = 0; k < Body::dim; ++k)
    axes.col(k) = body.vector(Material::Zero(), Material::Unit(k)).at(q);
  const mbs::Matrix<Body::dim, Body::dim> back = axes.inverse();
  std::vector<WettedPoint<Body::dim>> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != set) continue;
    const Material X = back * (in_space<Body::dim>(cloud.r[i]) - origin);
    WettedPoint<Body::dim> point{.at = body.point(X)};
    if (norm2(cloud.normal[i]) > 0)
      point.normal = body.vector(Material::Zero(), back * in_space<Body::dim>(cloud.normal[i]));
    points.push_back(std::move(point));
  }
  return points;
}

/// The points of a body that does not turn: the set's particles keep their way from one of its
/// points, and their normals.
/// @param q  coordinates of the structure
template <int Space, int Dim>
std::vector<WettedPoint<Space>> points_beside(const mbs::Marker<Space>& point,
                                              const mbs::VectorXd& q,
                                              const particles::Cloud<Dim>& cloud, int set) {
  std::vector<WettedPoint<Space>> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != set) continue;
    WettedPoint<Space> own{.at = point, .normal = {.x0 = in_space<Space>(cloud.normal[i])}};
    own.at.x0 += in_space<Space>(cloud.r[i]) - point.at(q);
    points.push_back(std::move(own));
  }
  return points;
}

}  // namespace sphmbs::coupling
