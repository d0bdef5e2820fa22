// SPDX-License-Identifier: MIT
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/beam.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/plate.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

using namespace sphmbs::mbs;
using ancf::Beam, ancf::Cable, ancf::Plate36;
using test::mentions, test::refusal;

namespace {

using Flexible = Structure<Cable<3>, Plate36, Beam>;

/// A node of 3 k numbers: its place and k - 1 gradients.
Node node(Flexible& structure, std::initializer_list<Vector<3>> vectors) {
  VectorXd q(3 * static_cast<int>(vectors.size()));
  int at = 0;
  for (const Vector<3>& vector : vectors) {
    q.segment<3>(at) = vector;
    at += 3;
  }
  return structure.add_node(q);
}

const Vector<3> O(0, 0, 0), X(1, 0, 0), Y(0, 1, 0), Z(0, 0, 1);
const Cable<3> cable{
    .length = 1, .axial_stiffness = 1, .bending_stiffness = 1, .mass_per_length = 1};
const Plate36 plate{.length = 1, .width = 1, .thickness = 0.1, .density = 1, .youngs_modulus = 1};
const Beam beam{.length = 1, .width = 0.1, .height = 0.1, .density = 1, .youngs_modulus = 1};

}  // namespace

TEST_CASE("a cable without length or run backwards is refused, with its nodes", "[mbs][fault]") {
  Flexible structure;
  const Node a = node(structure, {O, X}), b = node(structure, {X, X}), c = node(structure, {O, O});
  CHECK(mentions(refusal([&] {
                   structure.add(cable, {a, a});
                 }),
                 {"cable 0 (nodes 0, 0): course along X_1 = backwards", "same place", "order"}));
  CHECK(mentions(refusal([&] {
                   structure.add(cable, {b, a});
                 }),
                 {"cable 0 (nodes 1, 0): course along X_1 = backwards"}));
  CHECK(
      mentions(refusal([&] {
                 structure.add(cable, {c, b});
               }),
               {"cable 0 (nodes 2, 1): length of the gradient along X_1 at its node 1 of 2 = 0"}));
  CHECK(structure.all<Cable<3>>().empty());
  structure.add(cable, {a, b});
  CHECK(structure.all<Cable<3>>().size() == 1);
}

TEST_CASE("a plate whose nodes are in the wrong order is refused, with its nodes", "[mbs][fault]") {
  Flexible structure;
  const std::array<Node, 4> n{node(structure, {O, X, Y}), node(structure, {X, X, Y}),
                              node(structure, {X + Y, X, Y}), node(structure, {Y, X, Y})};
  structure.add(plate, n);
  CHECK(mentions(refusal([&] {
                   structure.add(plate, {n[1], n[0], n[3], n[2]});
                 }),
                 {"plate 1 (nodes 1, 0, 3, 2): course along X_1 = backwards", "order"}));
  CHECK(mentions(refusal([&] {
                   structure.add(plate, {n[0], n[1], n[1], n[0]});
                 }),
                 {"course along X_2 = backwards"}));
  const Node flat = node(structure, {O, X, 2 * X});
  CHECK(mentions(refusal([&] {
                   structure.add(plate, {flat, n[1], n[2], n[3]});
                 }),
                 {"plate 1 (nodes 4, 1, 2, 3)", "at its node 1 of 4 = 0", "parallel"}));
}

TEST_CASE("a beam turned inside out is refused, with its nodes", "[mbs][fault]") {
  Flexible structure;
  const Node a = node(structure, {O, X, Y, Z}), b = node(structure, {X, X, Y, Z}),
             inverted = node(structure, {X, X, Y, -Z});
  structure.add(beam, {a, b});
  CHECK(mentions(refusal([&] {
                   structure.add(beam, {a, inverted});
                 }),
                 {"beam 1 (nodes 0, 2)", "at its node 2 of 2 = -1", "left-handed"}));
  CHECK(mentions(refusal([&] { structure.add(beam, {b, a}); }), {"backwards"}));
}
