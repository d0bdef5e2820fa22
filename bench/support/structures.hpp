// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/grid.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

/// Structures that are timed: the cable of case 3 without its pendulum, the plates of case 4.
namespace bench {

using CableStructure =
    sphmbs::mbs::Structure<sphmbs::mbs::ancf::Cable<2>, sphmbs::mbs::joints::Joint<2>>;
using PlateStructure =
    sphmbs::mbs::Structure<sphmbs::mbs::ancf::Plate36, sphmbs::mbs::joints::Joint<3>>;

/// A cable of 4.02 m in n elements, pinned at both ends, that begins to sag.
inline CableStructure cable(int n) {
  using namespace sphmbs::mbs;
  CableStructure structure;
  structure.gravity = {0, -9.81};
  const double l = 4.02 / n;
  const ancf::Cable<2> element{.length = l,
                               .axial_stiffness = 1.41371669e6,
                               .bending_stiffness = 0.79521564,
                               .mass_per_length = 0.036815939};
  Node last = structure.add_node(Vector<4>(0, 0, 1, 0));
  for (int k = 1; k <= n; ++k) {
    const Node next = structure.add_node(Vector<4>(k * l, 0, 1, 0));
    structure.add(element, {last, next});
    last = next;
  }
  const auto& elements = structure.all<ancf::Cable<2>>();
  structure.add(joints::pinned(elements.front().start(), structure.q()));
  structure.add(joints::pinned(elements.back().end(), structure.q()));
  return structure;
}

/// Two plates of 2 m in n x n elements, hinged to the ground and to each other at three points.
inline PlateStructure plates(int n) {
  using namespace sphmbs::mbs;
  PlateStructure structure;
  structure.gravity = {0, 0, -9.81};
  const ancf::Plate36 material{.thickness = 2e-3, .density = 1000, .youngs_modulus = 1e7};
  const auto plate = [&](double x) {
    return ancf::grid(structure, ancf::GridSpec<ancf::Plate36>{.origin = {x, 0, 0},
                                                               .edge_x = {2, 0, 0},
                                                               .edge_y = {0, 2, 0},
                                                               .elements = {n, n},
                                                               .plate = material});
  };
  const auto first = plate(0), second = plate(2);
  for (const double y : {0.0, 1.0, 2.0}) {
    structure.add(joints::pinned(first.point(0, y), structure.q()));
    structure.add(joints::spherical(first.point(2, y), second.point(0, y)));
  }
  return structure;
}

}  // namespace bench
