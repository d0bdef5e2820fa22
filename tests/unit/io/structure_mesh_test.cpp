// SPDX-License-Identifier: MIT
#include "sphmbs/io/structure_mesh.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/mbs/ncf/rigid_body.hpp>
#include <sphmbs/mbs/structure.hpp>

#include "support/catch.hpp"

namespace {

using namespace sphmbs;
using mbs::Matrix;
using mbs::Vector;

/// Sheet without mass or stiffness whose points follow r = (x, y, q x y), so that it is curved.
struct Sheet {
  static constexpr std::string_view label = "sheet";
  static constexpr int dim = 3, nodes = 1, node_dofs = 1, dofs = 1, drawn = 2;
  using Material = Vector<2>;

  void check() const {}
  Matrix<1, 1> mass_matrix() const { return Matrix<1, 1>::Zero(); }
  Matrix<3, 1> shape(const Material& X) const { return {0, 0, X[0] * X[1]}; }
  static Matrix<1, 3> translation() { return {0, 0, 0}; }
  double strain_energy(const Vector<1>&) const { return 0; }
  Vector<1> internal_force(const Vector<1>&, const Vector<1>&) const { return Vector<1>(0.0); }
  Matrix<1, 1> tangent(const Vector<1>&, const Vector<1>&, double) const {
    return Matrix<1, 1>::Zero();
  }
  double dissipation(const Vector<1>&, const Vector<1>&) const { return 0; }
  Material outline(double s, double t) const { return {2 * s, 3 * t}; }
};

/// Line r = (x, q x^2) that says how much it is stretched.
struct Arc {
  static constexpr std::string_view label = "arc";
  static constexpr int dim = 2, nodes = 1, node_dofs = 1, dofs = 1, drawn = 1;
  using Material = Vector<1>;

  void check() const {}
  Matrix<1, 1> mass_matrix() const { return Matrix<1, 1>::Zero(); }
  Matrix<2, 1> shape(const Material& X) const { return {0, X[0] * X[0]}; }
  static Matrix<1, 2> translation() { return {0, 0}; }
  double strain_energy(const Vector<1>&) const { return 0; }
  Vector<1> internal_force(const Vector<1>&, const Vector<1>&) const { return Vector<1>(0.0); }
  Matrix<1, 1> tangent(const Vector<1>&, const Vector<1>&, double) const {
    return Matrix<1, 1>::Zero();
  }
  double dissipation(const Vector<1>&, const Vector<1>&) const { return 0; }
  Material outline(double s) const { return Material(s); }
  double axial_strain(const Vector<1>& q, const Material& X) const { return q[0] * X[0]; }
};

/// The same without an outline.
struct Unseen : Arc {
  static constexpr int drawn = 0;
};

template <class Structure>
mbs::State state_of(const Structure& structure) {
  return {.t = 0, .q = structure.q(), .v = structure.v(), .vdot = {}, .lambda = {}};
}

template <class T>
const std::vector<T>& array(const io::Mesh& mesh, const std::string& name) {
  for (const io::PointArray& array : mesh.arrays)
    if (array.name == name) return std::get<std::vector<T>>(array.values);
  throw std::runtime_error("no array " + name);
}

}  // namespace

TEST_CASE("a bar is drawn by its two ends, with their velocities", "[io]") {
  mbs::Structure<mbs::ncf::Bar> structure;
  structure.add(
      mbs::ncf::Bar{.from = {1, 2}, .to = {1, 4}, .density = 1, .area = 1, .angular_velocity = 3});
  structure.add(mbs::ncf::Bar{.from = {0, 0}, .to = {5, 0}, .density = 1, .area = 1});
  const io::Mesh mesh = io::structure_mesh(structure, state_of(structure));
  CHECK(mesh.points == std::vector<double>{1, 2, 0, 1, 4, 0, 0, 0, 0, 5, 0, 0});
  CHECK(mesh.lines.connectivity == std::vector<std::int64_t>{0, 1, 2, 3});
  CHECK(mesh.lines.offsets == std::vector<std::int64_t>{2, 4});
  CHECK(mesh.polygons.size() == 0);
  const auto& velocity = array<float>(mesh, "velocity [m/s]");
  REQUIRE(velocity.size() == 12);
  CHECK(velocity[3] == Approx(-6));  // omega x r
  CHECK(velocity[4] == Approx(0).margin(1e-6));
  CHECK(array<std::int32_t>(mesh, "number") == std::vector<std::int32_t>{0, 0, 1, 1});
  CHECK(mesh.arrays.size() == 3);  // nothing says how much it is stretched
}

TEST_CASE("the corners of a body's outline are drawn, and nothing between them", "[io]") {
  mbs::Structure<mbs::ncf::PlanarBody> structure;
  for (const int corners : {3, 4, 5, 8}) {
    std::vector<Vector<2>> outline;
    for (int k = 0; k <= corners; ++k)
      outline.push_back({std::cos(2 * k * std::acos(-1.0) / corners), k % 2 == 0 ? 0.5 : 1.0 + k});
    structure.add(
        mbs::ncf::PlanarBody{.inertia = {.mass = 1, .polar = 1}, .outline_points = outline});
  }
  const io::Mesh mesh = io::structure_mesh(structure, state_of(structure));
  REQUIRE(mesh.lines.size() == 4);
  CHECK(mesh.lines.offsets == std::vector<std::int64_t>{4, 9, 15, 24});

  // A box whose line runs along some edges twice, there and back.
  mbs::Structure<mbs::ncf::RigidBody> room;
  room.add(mbs::ncf::RigidBody{.inertia = mbs::ncf::box(1, {1, 2, 3}), .position = {1, 1, 1}});
  const io::Mesh box = io::structure_mesh(room, state_of(room));
  CHECK(box.size() == 16);
  Vector<3> low = Vector<3>::Constant(9), high = -low;
  for (std::size_t k = 0; k < box.size(); ++k) {
    const Vector<3> x = Vector<3>::Map(box.points.data() + 3 * k);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  CHECK((low - Vector<3>(0.5, 0, -0.5)).norm() < 1e-12);
  CHECK((high - Vector<3>(1.5, 2, 2.5)).norm() < 1e-12);
}

TEST_CASE("a surface is drawn by polygons that lie on it", "[io]") {
  mbs::Structure<Sheet> structure;
  const auto node = structure.add_node(Vector<1>(0.5), Vector<1>(2.0));
  structure.add(Sheet{}, {node});
  const io::Mesh mesh = io::structure_mesh(structure, state_of(structure), {.surface = 3});
  CHECK(mesh.size() == 16);
  CHECK(mesh.polygons.size() == 9);
  CHECK(mesh.lines.size() == 0);
  const auto& velocity = array<float>(mesh, "velocity [m/s]");
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    const double x = 2 * (static_cast<double>(k % 4) / 3), y = 3 * (static_cast<double>(k / 4) / 3);
    CHECK(mesh.points[3 * k + 2] == Approx(0.5 * x * y));
    CHECK(static_cast<double>(velocity[3 * k + 2]) == Approx(2 * x * y));
  }
  // Each polygon is one of the nine, its corners in order around it.
  for (std::size_t k = 0; k < 9; ++k) {
    const std::int64_t* c = mesh.polygons.connectivity.data() + 4 * k;
    CHECK(c[1] == c[0] + 1);
    CHECK(c[2] == c[1] + 4);
    CHECK(c[3] == c[0] + 4);
  }
}

TEST_CASE("lines are drawn curved, with their strain, and parts without an outline are left out",
          "[io]") {
  mbs::Structure<Unseen, Arc, mbs::ncf::Bar> structure;
  const auto node = structure.add_node(Vector<1>(2.0));
  structure.add(Unseen{}, {node});
  structure.add(Arc{}, {node});
  structure.add(mbs::ncf::Bar{.from = {0, 0}, .to = {5, 0}, .density = 1, .area = 1});
  const io::Mesh mesh = io::structure_mesh(structure, state_of(structure), {.curve = 10});
  REQUIRE(mesh.lines.size() == 2);
  CHECK(mesh.size() == 11 + 2);
  const auto& strain = array<float>(mesh, "axial strain [-]");
  for (std::size_t k = 0; k <= 10; ++k) {
    const double X = static_cast<double>(k) / 10;
    CHECK(mesh.points[3 * k + 1] == Approx(2 * X * X));
    CHECK(static_cast<double>(strain[k]) == Approx(2 * X));
  }
  CHECK(std::isnan(strain[11]));
  std::vector<std::int32_t> types(11, 1);
  types.insert(types.end(), 2, 2);
  CHECK(array<std::int32_t>(mesh, "type") == types);
}
