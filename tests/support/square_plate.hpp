// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/grid.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

/// A square plate of unit side and bending stiffness D, with the edges of textbooks.
namespace test {

enum class Edges { supported, clamped, cantilever, free };

/// A vector among the coordinates of the node at (x, y): r, r_x, r_y, r_xy for k = 0 ... 3.
template <class Grid>
sphmbs::mbs::Marker<3> nodal_vector(const Grid& grid, double x, double y, int k) {
  if (k == 0) return grid.point(x, y);
  return k == 3 ? grid.twist(x, y) : grid.gradient(x, y, k - 1);
}

/// Whether edges hold the transverse part of a nodal vector. Supported ones hold w and its slope
/// along the edge, clamped ones all.
inline bool holds(Edges edges, bool at_x_end, bool at_y_end, bool at_start, int k) {
  if (edges == Edges::free) return false;
  if (edges == Edges::cantilever) return at_start;
  if (edges == Edges::clamped) return at_x_end || at_y_end;
  return (at_x_end && (k == 0 || k == 2)) || (at_y_end && k <= 1);
}

/// n x n elements of type P with a mass per area of 1. What edges do not hold, in the plane of the
/// plate, is held at two corners.
template <class P, class Structure>
sphmbs::mbs::ancf::Grid<P> square_plate(Structure& structure, int n, Edges edges,
                                        double thickness) {
  using namespace sphmbs::mbs;
  const double nu = 0.3;
  const P plate{.thickness = thickness,
                .density = 1 / thickness,
                .youngs_modulus = 12 * (1 - nu * nu) / std::pow(thickness, 3),
                .poisson_ratio = nu};
  auto grid = ancf::grid<P>(
      structure, {.edge_x = {1, 0, 0}, .edge_y = {0, 1, 0}, .elements = {n, n}, .plate = plate});
  const auto hold = [&](const Marker<3>& vector, int axis, double value = 0) {
    structure.add(joints::component(vector, Vector<3>::Unit(axis), value));
  };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      for (int k = 0; k < P::node_dofs / 3; ++k)
        if (holds(edges, i == 0 || i == n, j == 0 || j == n, i == 0, k))
          hold(nodal_vector(grid, i * grid.length() / n, j * grid.width() / n, k), 2);
  if (edges == Edges::free) return grid;
  hold(grid.corner(0, 0), 0);
  hold(grid.corner(0, 0), 1);
  hold(grid.corner(0, 1), 0);
  return grid;
}

}  // namespace test
