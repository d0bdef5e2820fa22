// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <sphmbs/mbs/ancf/grid.hpp>
#include <sphmbs/mbs/structure.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"

using namespace sphmbs::mbs;
using ancf::Plate36;
using ancf::Plate48;

namespace {

constexpr double rounding = 1e-12;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr double thickness = 0.002, density = 1000;

/// A rectangle of 1.5 m x 0.8 m, somewhere in space, moving.
template <class P>
ancf::GridSpec<P> some_spec() {
  const Matrix<3, 3> R =
      Eigen::AngleAxisd(1.1, Vector<3>(1, -2, 0.5).normalized()).toRotationMatrix();
  return {.origin = {1, 2, 3},
          .edge_x = 1.5 * R.col(0),
          .edge_y = 0.8 * R.col(1),
          .elements = {3, 2},
          .plate = {.thickness = thickness, .density = density, .youngs_modulus = 1e7},
          .velocity = {0.5, -1, 2},
          .angular_velocity = {3, 1, -2}};
}

template <class P>
ancf::GridSpec<P> unit_square(int n) {
  return {.edge_x = {1, 0, 0},
          .edge_y = {0, 1, 0},
          .elements = {n, n},
          .plate = {.thickness = thickness, .density = density, .youngs_modulus = 1e7}};
}

template <class Change>
std::string refusal(Change&& change) {
  auto spec = some_spec<Plate36>();
  change(spec);
  Structure<Plate36> structure;
  const std::string complaint = test::refusal([&] { ancf::grid(structure, spec); });
  if (!complaint.empty()) CHECK(structure.coordinates() == 0);
  return complaint;
}

}  // namespace

TEMPLATE_TEST_CASE("A grid of plates covers its rectangle and moves as told", "[mbs]", Plate36,
                   Plate48) {
  const auto spec = some_spec<TestType>();
  Structure<TestType> structure;
  const auto plate = ancf::grid(structure, spec);
  REQUIRE(plate.elements.size() == 6);
  CHECK(structure.coordinates() == 12 * TestType::node_dofs);
  CHECK(plate.length() == Approx(1.5).epsilon(rounding));
  CHECK(plate.width() == Approx(0.8).epsilon(rounding));

  const VectorXd q = structure.q(), v = structure.v();
  const Vector<3> along_x = spec.edge_x.normalized(), along_y = spec.edge_y.normalized();
  test::Random random(1);
  const auto check = [&](double x, double y) {
    INFO("x " << x << " y " << y);
    const auto point = plate.point(x, y);
    const Vector<3> r = spec.origin + x * along_x + y * along_y;
    CHECK((point.at(q) - r).norm() < rounding);
    const Vector<3> omega = spec.angular_velocity;
    CHECK((point.rate(v) - spec.velocity - omega.cross(r - spec.origin)).norm() < rounding);
    CHECK((plate.gradient(x, y, 0).at(q) - along_x).norm() < rounding);
    CHECK((plate.gradient(x, y, 1).at(q) - along_y).norm() < rounding);
    CHECK((plate.gradient(x, y, 1).rate(v) - omega.cross(along_y)).norm() < rounding);
  };
  for (int n = 0; n < 20; ++n) check(1.5 * random.unit(), 0.8 * random.unit());
  for (const double x : {0.0, 0.5, 1.0, 1.5})
    for (const double y : {0.0, 0.4, 0.8}) check(x, y);
  CHECK((plate.corner(1, 1).at(q) - spec.origin - spec.edge_x - spec.edge_y).norm() < rounding);
  CHECK((plate.corner(0, 1).at(q) - spec.origin - spec.edge_y).norm() < rounding);

  double mass = 0;
  for (const auto& element : plate.elements) {
    const auto T = TestType::translation();
    mass += (T.transpose() * element.part.mass_matrix() * T).trace() / 3;
    const double membrane = 1e7 * thickness * 1.5 * 0.8;
    CHECK(element.part.strain_energy(element.local(q)) < rounding * membrane);
  }
  CHECK(mass == Approx(density * thickness * 1.5 * 0.8).epsilon(rounding));
}

TEMPLATE_TEST_CASE("Neighbours in a grid of plates share their nodes", "[mbs]", Plate36, Plate48) {
  Structure<TestType> structure;
  const auto plate = ancf::grid(structure, some_spec<TestType>());
  const VectorXd q = structure.q();
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 3; ++i) {
      const Node node = plate.node(i, j);
      CHECK(node.size == TestType::node_dofs);
      CHECK((q.segment<3>(node.offset) - plate.raster.node(i, j)).norm() < rounding);
      const auto point = plate.point(0.5 * i, 0.4 * j);
      CHECK(point.index == Index{node.offset, node.offset + 1, node.offset + 2});
      for (int k = 0; k < 4; ++k) {
        const int column = i - (k == 1 || k == 2), row = j - (k >= 2);
        if (column < 0 || column > 2 || row < 0 || row > 1) continue;
        CHECK(plate.element(column, row).nodes[static_cast<std::size_t>(k)].offset == node.offset);
      }
    }
  // A surface moved at random stays whole across the edge between two elements.
  test::Random random(2);
  VectorXd moved(structure.coordinates());
  for (double& x : moved) x = random.between(-1, 1);
  const auto& left = plate.element(0, 0);
  const auto& right = plate.element(1, 0);
  for (const double t : {0.1, 0.5, 0.8}) {
    const Vector<3> gap = left.point(left.part.outline(1, t)).at(moved) -
                          right.point(right.part.outline(0, t)).at(moved);
    CHECK(gap.norm() < rounding);
  }
}

TEST_CASE("A grid of plates beside another shares the nodes of their common edge", "[mbs]") {
  Structure<Plate36> structure;
  const auto first = ancf::grid(structure, unit_square<Plate36>(3));
  auto spec = unit_square<Plate36>(3);
  spec.origin = {1, 0, 0};
  spec.beside = &first;
  const auto second = ancf::grid(structure, spec);
  CHECK(structure.coordinates() == (2 * 16 - 4) * 9);
  for (int j = 0; j <= 3; ++j) CHECK(second.node(0, j).offset == first.node(3, j).offset);
  CHECK(second.node(1, 0).offset != first.node(3, 0).offset);

  // Without `beside`, grids in the same place are two plates.
  spec.beside = nullptr;
  const auto apart = ancf::grid(structure, spec);
  CHECK(apart.node(0, 0).offset != first.node(3, 0).offset);
}

TEST_CASE("A grid of plates refuses a grid beside it that does not fit", "[mbs]") {
  Structure<Plate36> structure;
  const auto first = ancf::grid(structure, unit_square<Plate36>(4));
  const auto complaint = [&](int n, const Vector<3>& origin, const Vector<3>& edge_x) {
    auto spec = unit_square<Plate36>(n);
    spec.origin = origin;
    spec.edge_x = edge_x;
    spec.beside = &first;
    const int before = structure.coordinates();
    const std::string text = test::refusal([&] { ancf::grid(structure, spec); });
    CHECK(structure.coordinates() == before);
    return text;
  };
  const Vector<3> x{1, 0, 0}, z{0, 0, 1};
  const auto meets = Catch::Contains("must be off the other grid or at one of its nodes");
  CHECK_THAT(complaint(2, x, x), meets);
  CHECK_THAT(complaint(8, x, x), meets);
  CHECK_THAT(complaint(4, x + 0.1 * Vector<3>::UnitY(), x), meets);
  CHECK_THAT(complaint(4, 2 * x, x), Catch::Contains("nodes shared = 0: must be two or more"));
  CHECK_THAT(complaint(4, x + 0.1 * z, x), Catch::Contains("nodes shared = 0"));
  CHECK_THAT(complaint(4, x, z),
             Catch::Contains("must be 0: grids that share nodes have the same"));
}

TEST_CASE("A grid of plates can be asked for in one expression", "[mbs]") {
  Structure<Plate36, Plate48> structure;
  const auto coarse =
      ancf::grid(structure, {.edge_x = {2, 0, 0},
                             .edge_y = {0, 1, 0},
                             .plate = {.thickness = 2e-3, .density = 1000, .youngs_modulus = 1e7}});
  const auto bicubic = ancf::grid<Plate48>(
      structure, {.edge_x = {2, 0, 0},
                  .edge_y = {0, 1, 0},
                  .elements = {2, 1},
                  .plate = {.thickness = 2e-3, .density = 1000, .youngs_modulus = 1e7}});
  CHECK(structure.coordinates() == 4 * 9 + 6 * 12);
  CHECK(coarse.element(0, 0).part.length == 2);
  CHECK(bicubic.element(1, 0).part.length == 1);
}

TEST_CASE("A grid of plates refuses bad input and adds nothing then", "[mbs]") {
  const Vector<3> none = Vector<3>::Zero();
  CHECK(refusal([](auto&) {}).empty());
  CHECK(refusal([&](auto& s) { s.edge_x = none; }) ==
        "grid of plates: edge_x = 0 0 0: must be finite and not of zero length [m]");
  CHECK_THAT(refusal([&](auto& s) { s.edge_y = none; }),
             Catch::Contains("edge_y = 0 0 0: must be"));
  CHECK_THAT(refusal([](auto& s) { s.edge_y += 0.1 * s.edge_x; }),
             Catch::Contains("cosine between edge_x and edge_y = 0.18") &&
                 Catch::Contains("must be 0: plates are rectangles"));
  CHECK(refusal([](auto& s) { s.elements[0] = 0; }) ==
        "grid of plates: elements along x = 0: must be 1 or more");
  CHECK_THAT(refusal([](auto& s) { s.elements[1] = -3; }),
             Catch::Contains("elements along y = -3: must be 1 or more"));
  CHECK_THAT(refusal([](auto& s) { s.origin[1] = not_a_number; }), Catch::Contains("origin = "));
  CHECK_THAT(refusal([](auto& s) { s.edge_x[1] = not_a_number; }), Catch::Contains("edge_x = "));
  CHECK_THAT(refusal([](auto& s) { s.velocity[1] = not_a_number; }),
             Catch::Contains("velocity = "));
  CHECK_THAT(refusal([](auto& s) { s.angular_velocity[2] = not_a_number; }),
             Catch::Contains("angular_velocity = "));
  CHECK(refusal([](auto& s) { s.plate.thickness = -1; }) ==
        "grid of plates: thickness = -1: must be positive [m]");
  CHECK_THAT(refusal([](auto& s) { s.plate.density = -2; }), Catch::Contains("density = -2"));
  CHECK_THAT(refusal([](auto& s) { s.plate.youngs_modulus = 0; }),
             Catch::Contains("youngs_modulus = 0"));
  CHECK_THAT(refusal([](auto& s) { s.plate.poisson_ratio = 0.5; }),
             Catch::Contains("poisson_ratio = 0.5: must be between -1 and 0.5"));
}

TEST_CASE("A grid of plates has no points off its rectangle", "[mbs]") {
  Structure<Plate36> structure;
  const auto plate = ancf::grid(structure, some_spec<Plate36>());
  CHECK(test::refusal([&] { plate.point(1.6, 0); }) ==
        "point of a grid: x = 1.6: must be from 0 to 1.500000 [m]");
  CHECK_THAT(test::refusal([&] { plate.point(0, -0.1); }), Catch::Contains("y = -0.1: must be"));
  CHECK_THAT(test::refusal([&] { plate.gradient(not_a_number, 0, 0); }),
             Catch::Contains("x = nan"));
}

TEST_CASE("A plate that two nodes of a structure cannot carry is refused by name", "[mbs]") {
  Structure<Plate36> structure;
  const auto plate = ancf::grid(structure, some_spec<Plate36>());
  auto thin = plate.element(0, 0).part;
  thin.thickness = 0;
  CHECK(test::refusal([&] { structure.add(thin, plate.element(1, 0).nodes); }) ==
        "plate 6 (nodes 1, 2, 6, 5): thickness = 0: must be positive [m]");
}
