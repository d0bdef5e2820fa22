// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::double_pendulum;
using test::PlanarMechanism;
using test::thin_bar;

TEST_CASE("parts that are added own consecutive coordinates", "[mbs]") {
  PlanarMechanism mechanism;
  const auto first = mechanism.add(thin_bar({0, 0}, {1, 0}));
  const auto second = mechanism.add(thin_bar({1, 0}, {1, 2}));
  CHECK(mechanism.coordinates() == 8);
  CHECK(first.index() == Index{0, 1, 2, 3});
  CHECK(second.index() == Index{4, 5, 6, 7});
  CHECK(second.number == 1);
  CHECK(second.end().at(mechanism.q()) == Vector<2>(1, 2));
  CHECK(mechanism.name_of(second) == "bar 1 (nodes 2, 3)");
}

TEST_CASE("parts share the nodes that they are given", "[mbs]") {
  PlanarMechanism mechanism;
  const Node a = mechanism.add_node(Vector<2>(0, 0)), b = mechanism.add_node(Vector<2>(1, 0)),
             c = mechanism.add_node(Vector<2>(1, 1));
  const auto first = mechanism.add(thin_bar({0, 0}, {1, 0}), {a, b});
  const auto second = mechanism.add(thin_bar({1, 0}, {1, 1}), {b, c});
  CHECK(mechanism.coordinates() == 6);
  CHECK(first.end().index == second.start().index);
}

TEST_CASE("a marker leaves out coordinates that do not move it", "[mbs]") {
  PlanarMechanism mechanism;
  const auto bar = mechanism.add(thin_bar({0, 0}, {2, 0}));
  CHECK(bar.start().index == Index{0, 1});
  CHECK(bar.point({1, 0}).index == Index{0, 1, 2, 3});
}

TEST_CASE("bad nodes and parts are refused by name", "[mbs]") {
  PlanarMechanism mechanism;
  CHECK(test::mentions(test::refusal([&] { mechanism.add_node(Vector<2>(0, std::nan(""))); }),
                       {"node 0: coordinates = ", "finite"}));
  CHECK(test::mentions(
      test::refusal([&] { mechanism.add_node(VectorXd::Zero(2), VectorXd::Zero(3)); }),
      {"number of rates = 3"}));
  CHECK(test::mentions(test::refusal([&] {
                         mechanism.add(thin_bar({0, 0}, {1, 0}), {Node{0, 2}, Node{2, 2}});
                       }),
                       {"bar 0 (nodes 0, 0): size of its nodes"}));
  CHECK(test::mentions(
      test::refusal([&] {
        mechanism.add(ncf::Bar{.from = {0, 0}, .to = {0, 0}, .density = 1, .area = 1});
      }),
      {"bar 0: length = 0: must be positive [m]"}));
  CHECK(mechanism.coordinates() == 0);
}

TEST_CASE("a joint with markers of another structure is refused", "[mbs]") {
  PlanarMechanism other = double_pendulum(), mechanism;
  mechanism.add(thin_bar({0, 0}, {1, 0}));
  const auto bar = other.all<ncf::Bar>()[1];
  CHECK(test::mentions(
      test::refusal([&] { mechanism.add(joints::pinned(bar.end(), other.q(), "lost")); }),
      {"pinned 'lost': coordinate = 6", "of this structure"}));
}

TEST_CASE("a structure starts from coordinates that are set", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  CHECK(test::mentions(test::refusal([&] { mechanism.start_from(VectorXd::Zero(3)); }),
                       {"number of coordinates = 3"}));
  const VectorXd q = mechanism.q() * 2, v = VectorXd::Ones(8);
  mechanism.start_from(q, v);
  CHECK(mechanism.q() == q);
  CHECK(mechanism.v() == v);
}
