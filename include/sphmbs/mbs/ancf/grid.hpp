// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ancf/plate.hpp>
#include <sphmbs/mbs/ancf/raster.hpp>
#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::ancf {

/// A rectangle of plate elements in a structure. x and y are material coordinates of the rectangle,
/// from 0 to length() and to width().
template <class P>
struct Grid {
  Raster raster;                    ///< where it was added
  std::vector<Placed<P>> elements;  ///< row by row: x first

  /// Along the first axis, undeformed [m].
  double length() const { return raster.count[0] * raster.cell[0]; }
  /// Along the second axis, undeformed [m].
  double width() const { return raster.count[1] * raster.cell[1]; }

  /// Element in column i and row j, from 0.
  /// @throws InvalidInput for one that is not there.
  const Placed<P>& element(int i, int j) const {
    expects(i >= 0 && i < raster.count[0], "element of a grid: column", i,
            "from 0 to " + std::to_string(raster.count[0] - 1));
    expects(j >= 0 && j < raster.count[1], "element of a grid: row", j,
            "from 0 to " + std::to_string(raster.count[1] - 1));
    return elements.at(static_cast<std::size_t>(j * raster.count[0] + i));
  }
  /// Node in column i and row j, from 0 to the number of elements.
  Node node(int i, int j) const {
    const int column = std::min(i, raster.count[0] - 1), row = std::min(j, raster.count[1] - 1);
    const int corner = j == row ? i - column : 3 - (i - column);
    return element(column, row).nodes[static_cast<std::size_t>(corner)];
  }

  /// The material point (x, y) [m].
  /// @throws InvalidInput for a point off the rectangle.
  Marker<3> point(double x, double y) const {
    const auto [element, X] = at(x, y);
    return element->point(X);
  }
  /// The gradient r_x (k = 0) or r_y (k = 1) there.
  Marker<3> gradient(double x, double y, int k) const {
    const auto [element, X] = at(x, y);
    return element->gradient(X, k);
  }
  /// r_xy there, which a clamped edge of plates of 48 coordinates holds too.
  Marker<3> twist(double x, double y) const {
    const auto [element, X] = at(x, y);
    return element->twist(X);
  }
  /// A corner: i = 0 or 1 at either end along x, j along y.
  Marker<3> corner(int i, int j) const { return point(i * length(), j * width()); }

  /// The element that holds a point, and the point's place in it.
  std::pair<const Placed<P>*, typename P::Material> at(double x, double y) const {
    const auto [i, u] = cell_of(x, 0, "x");
    const auto [j, v] = cell_of(y, 1, "y");
    return {&element(i, j), {u * raster.cell[0], v * raster.cell[1]}};
  }

 private:
  // Points next to a node are the node itself, so that rounding couples no more nodes than needed.
  std::pair<int, double> cell_of(double x, int axis, const char* name) const {
    constexpr double tolerance = 1e-9;
    const int count = raster.count[static_cast<std::size_t>(axis)];
    double cells = x / raster.cell[axis];
    if (std::abs(cells - std::round(cells)) < tolerance) cells = std::round(cells);
    expects(cells >= 0 && cells <= count, std::string("point of a grid: ") + name, x,
            "from 0 to " + std::to_string(count * raster.cell[axis]) + " [m]");
    const int cell = std::min(static_cast<int>(cells), count - 1);
    return {cell, cells - cell};
  }
};

/// A flat rectangle of equal, unstressed plate elements anywhere in space.
template <class P = Plate36>
struct GridSpec {
  Vector<3> origin = Vector<3>::Zero();            ///< corner (0, 0) [m]
  Vector<3> edge_x = Vector<3>::Zero();            ///< from there along x: length and direction [m]
  Vector<3> edge_y = Vector<3>::Zero();            ///< along y, orthogonal to edge_x [m]
  std::array<int, 2> elements = {1, 1};            ///< along x and y
  P plate = {};                                    ///< of every element; its sizes are set here
  Vector<3> velocity = Vector<3>::Zero();          ///< of the origin [m/s]
  Vector<3> angular_velocity = Vector<3>::Zero();  ///< about the origin [rad/s]
  const Grid<P>* beside = nullptr;  ///< in the same plane: nodes in the same place are shared
};

namespace detail {

template <class P>
Raster checked_raster(const GridSpec<P>& spec) {
  const Vector<2> edges(spec.edge_x.norm(), spec.edge_y.norm());
  expects(spec.origin.allFinite(), "origin", spec.origin.transpose(), "finite [m]");
  expects(std::isfinite(edges[0]) && edges[0] > 0, "edge_x", spec.edge_x.transpose(),
          "finite and not of zero length [m]");
  expects(std::isfinite(edges[1]) && edges[1] > 0, "edge_y", spec.edge_y.transpose(),
          "finite and not of zero length [m]");
  constexpr double square = 1e-9;
  const double cosine = spec.edge_x.dot(spec.edge_y) / (edges[0] * edges[1]);
  expects(std::abs(cosine) < square, "cosine between edge_x and edge_y", cosine,
          "0: plates are rectangles");
  expects(spec.elements[0] > 0, "elements along x", spec.elements[0], "1 or more");
  expects(spec.elements[1] > 0, "elements along y", spec.elements[1], "1 or more");
  expects(spec.velocity.allFinite(), "velocity", spec.velocity.transpose(), "finite [m/s]");
  expects(spec.angular_velocity.allFinite(), "angular_velocity", spec.angular_velocity.transpose(),
          "finite [rad/s]");
  Raster raster{.origin = spec.origin,
                .axes = {},
                .cell = {edges[0] / spec.elements[0], edges[1] / spec.elements[1]},
                .count = spec.elements};
  raster.axes << spec.edge_x / edges[0], spec.edge_y / edges[1];
  return raster;
}

/// @throws InvalidInput where a node of one grid is on the other but at none of its nodes, where
/// the axes differ, or where fewer than two nodes are shared.
inline void expect_conforming(const Raster& a, const Raster& b) {
  constexpr double parallel = 1e-9;
  const double turn = (a.axes - b.axes).norm();
  expects(turn < parallel, "beside: difference of the axes", turn,
          "0: grids that share nodes have the same axes");
  int shared = 0;
  const auto look = [&shared](const Raster& from, const Raster& to) {
    from.for_each_node([&](int i, int j) {
      const Vector<3> r = from.node(i, j);
      if (!to.covers(r)) return;
      expects(to.node_at(r).has_value(), "beside: node at", r.transpose(),
              "off the other grid or at one of its nodes");
      ++shared;
    });
  };
  look(a, b);
  look(b, a);
  expects(shared >= 4, "beside: nodes shared", shared / 2, "two or more");
}

/// Coordinates and rates of node (i, j): r and its slopes.
template <class P>
std::array<VectorXd, 2> node_state(const GridSpec<P>& spec, const Raster& raster, int i, int j) {
  VectorXd q = VectorXd::Zero(P::node_dofs), v = q;
  const Vector<3> arm = raster.node(i, j) - spec.origin;
  q.head<3>() = raster.node(i, j);
  v.head<3>() = spec.velocity + spec.angular_velocity.cross(arm);
  for (int k = 0; k < 2; ++k) {
    q.segment<3>(3 + 3 * k) = raster.axes.col(k);
    v.segment<3>(3 + 3 * k) = spec.angular_velocity.cross(raster.axes.col(k));
  }
  return {q, v};
}

}  // namespace detail

/// Adds nodes and elements to a structure:
///
///   auto plate = ancf::grid(structure, {.edge_x = {2, 0, 0}, .edge_y = {0, 2, 0},
///       .elements = {10, 10}, .plate = {.thickness = 2e-3, .density = 1000, .youngs_modulus =
///       1e7}});
///   auto finer = ancf::grid<ancf::Plate48>(structure, {...});
///
/// @throws InvalidInput, before anything is added, for edges that are not orthogonal or have no
/// length, for counts below 1, for what Plate::check refuses, and for numbers that are not finite.
template <class P = Plate36, class Structure>
Grid<P> grid(Structure& structure, const GridSpec<P>& spec) {
  P plate = spec.plate;
  Raster raster;
  try {
    raster = detail::checked_raster(spec);
    plate.length = raster.cell[0];
    plate.width = raster.cell[1];
    plate.check();
    if (spec.beside != nullptr) detail::expect_conforming(raster, spec.beside->raster);
  } catch (const InvalidInput& e) {
    throw InvalidInput(std::string("grid of plates: ") + e.what());
  }
  std::vector<Node> nodes;
  raster.for_each_node([&](int i, int j) {
    if (spec.beside != nullptr)
      if (const auto other = spec.beside->raster.node_at(raster.node(i, j))) {
        nodes.push_back(spec.beside->node((*other)[0], (*other)[1]));
        return;
      }
    const auto [q, v] = detail::node_state(spec, raster, i, j);
    nodes.push_back(structure.add_node(q, v));
  });
  Grid<P> grid{.raster = raster, .elements = {}};
  const auto node = [&](int i, int j) {
    return nodes[static_cast<std::size_t>(j * (raster.count[0] + 1) + i)];
  };
  for (int j = 0; j < raster.count[1]; ++j)
    for (int i = 0; i < raster.count[0]; ++i)
      grid.elements.push_back(
          structure.add(plate, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}));
  return grid;
}

}  // namespace sphmbs::mbs::ancf
