// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <sphmbs/coupling/wetted_point.hpp>
#include <sphmbs/mbs/ancf/grid.hpp>

namespace sphmbs::coupling {

/// Material coordinates of the point of a grid of plates that is nearest to r [m], by
/// Gauss-Newton's method from the nearest node on.
template <class Plate>
mbs::Vector<2> nearest_on(const mbs::ancf::Grid<Plate>& grid, const mbs::VectorXd& q,
                          const mbs::Vector<3>& r) {
  using Vector2 = mbs::Vector<2>;
  const Vector2 size{grid.length(), grid.width()};
  const auto distance = [&](const Vector2& X) { return (grid.point(X[0], X[1]).at(q) - r).norm(); };
  const auto& cells = grid.raster.count;
  Vector2 best = Vector2::Zero();
  for (int i = 0; i <= cells[0]; ++i)
    for (int j = 0; j <= cells[1]; ++j)
      if (const Vector2 node{size[0] * i / cells[0], size[1] * j / cells[1]};
          distance(node) < distance(best))
        best = node;
  for (int k = 0; k < 20; ++k) {
    mbs::Matrix<3, 2> J;
    for (const int axis : {0, 1}) J.col(axis) = grid.gradient(best[0], best[1], axis).at(q);
    const mbs::Vector<3> way = r - grid.point(best[0], best[1]).at(q);
    const Vector2 step = (J.transpose() * J).inverse() * (J.transpose() * way);
    const Vector2 next = (best + step).cwiseMax(Vector2::Zero()).cwiseMin(size);
    const bool rests = (next - best).norm() < 1e-14 * size.norm();
    best = next;
    if (rests) break;
  }
  return best;
}

/// The points of a grid of plates that a set's particles ride on: each at its distance from the
/// plates' middle surface, along the normal on the side that the cloud's normal is on. A particle
/// without a normal rides on the surface itself.
/// @param q  coordinates of the structure
template <class Plate>
std::vector<WettedPoint<3>> points_of(const mbs::ancf::Grid<Plate>& grid, const mbs::VectorXd& q,
                                      const particles::Cloud<3>& cloud, int set) {
  std::vector<WettedPoint<3>> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != set) continue;
    const mbs::Vector<3> r = in_space<3>(cloud.r[i]);
    const mbs::Vector<2> X = nearest_on(grid, q, r);
    WettedPoint<3> point{.at = grid.point(X[0], X[1])};
    if (norm2(cloud.normal[i]) > 0) {
      point.along = {grid.gradient(X[0], X[1], 0), grid.gradient(X[0], X[1], 1)};
      if (point.normal_at(q).dot(in_space<3>(cloud.normal[i])) < 0)
        std::swap(point.along[0], point.along[1]);
      point.offset = (r - point.at.at(q)).dot(point.normal_at(q).normalized());
    }
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace sphmbs::coupling
