// SPDX-License-Identifier: MIT
// Solids within facets against shapes of which the distance is known.
#include <cmath>
#include <limits>
#include <vector>

#include <sphmbs/geometry/ball.hpp>
#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/geometry/lattice.hpp>
#include <sphmbs/geometry/polygon.hpp>
#include <sphmbs/particles/cloud.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/meshes.hpp"
#include "support/random.hpp"

namespace {

using namespace sphmbs::geometry;
using Catch::Matchers::Contains;
using sphmbs::Vec;
using sphmbs::math::pi;

/// Closed loops as facets.
Facets<2> outlines(const std::vector<std::vector<Vec<2>>>& loops) {
  Facets<2> f;
  for (const auto& loop : loops) {
    const auto first = static_cast<std::uint32_t>(f.points.size());
    const auto n = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      f.points.push_back(loop[k]);
      f.corners.push_back({first + k, first + (k + 1) % n});
    }
  }
  return f;
}

std::vector<Vec<2>> circle(int n, double radius, double turn = 1) {
  std::vector<Vec<2>> points;
  for (int k = 0; k < n; ++k) {
    const double a = 2 * pi * turn * k / n;
    points.push_back({radius * std::cos(a), radius * std::sin(a)});
  }
  return points;
}

double torus_distance(const Vec<3>& x, double ring, double tube) {
  const double off = std::hypot(x[0], x[1]) - ring;
  return std::hypot(off, x[2]) - tube;
}

/// Slope of the distance by central differences.
template <class S>
Vec<S::dim> slope(const S& shape, const Vec<S::dim>& x, double step) {
  Vec<S::dim> slope;
  for (int k = 0; k < S::dim; ++k) {
    Vec<S::dim> ahead = x, behind = x;
    ahead[k] += step;
    behind[k] -= step;
    slope[k] = (shape.distance(ahead) - shape.distance(behind)) / (2 * step);
  }
  return slope;
}

}  // namespace

TEST_CASE("a box of triangles is the box", "[geometry]") {
  const Box<3> box{{-1, -0.5, 0.25}, {2, 1.5, 1}};
  const TriangleMesh mesh(test::box(box.lower, box.upper));
  CHECK(volume(test::box(box.lower, box.upper)) == Approx(3 * 2 * 0.75));
  CHECK(mesh.box().lower == box.lower);
  CHECK(mesh.box().upper == box.upper);
  test::Random random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto x = random.vector<3>(3);
    CHECK(std::abs(mesh.distance(x) - box.distance(x)) < 1e-14);
  }
}

TEST_CASE("distances from triangles approach those from the sphere and the torus they are cut from",
          "[geometry]") {
  // Chords lie below the surface by the square of their length.
  test::Random random(2);
  double worst_sphere[2] = {0, 0}, worst_torus[2] = {0, 0}, error_of_volume[2];
  for (int level = 0; level < 2; ++level) {
    const int n = 10 << level;
    const TriangleMesh ball(test::sphere(n, 1.5)), ring(test::torus(8 * n, 3 * n, 1, 0.4));
    error_of_volume[level] = 1 - volume(test::sphere(n, 1.5)) / (4 * pi / 3 * 1.5 * 1.5 * 1.5);
    for (int trial = 0; trial < 2000; ++trial) {
      const auto x = random.vector<3>(2);
      worst_sphere[level] = std::max(
          worst_sphere[level], std::abs(ball.distance(x) - Ball<3>{{0, 0, 0}, 1.5}.distance(x)));
      worst_torus[level] =
          std::max(worst_torus[level], std::abs(ring.distance(x) - torus_distance(x, 1, 0.4)));
    }
  }
  CHECK(worst_sphere[1] < 3e-3);
  CHECK(worst_torus[1] < 3e-3);
  CHECK(worst_sphere[0] / worst_sphere[1] == Approx(4).margin(0.8));
  CHECK(worst_torus[0] / worst_torus[1] == Approx(4).margin(0.8));
  CHECK(error_of_volume[0] / error_of_volume[1] == Approx(4).margin(0.2));
}

TEST_CASE("the nearest point of a tree is the nearest of all facets", "[geometry]") {
  test::Random random(3);
  Facets<3> soup;  // triangles of any shape and place
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto at = random.vector<3>(2);
    for (int k = 0; k < 3; ++k) soup.points.push_back(at + random.vector<3>(0.5));
    soup.corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const FacetTree<3> tree(soup);
  REQUIRE(tree.size() == 200);
  for (int trial = 0; trial < 300; ++trial) {
    const auto x = random.vector<3>(4);
    double nearest2 = 1e300, winding = 0;
    for (std::size_t i = 0; i < soup.size(); ++i) {
      // The nearest point of a triangle, told apart from every other by sampling it.
      const auto p = nearest_on(soup[i], x);
      nearest2 = std::min(nearest2, norm2(x - p));
      winding += share_of_view(soup[i], x);
      const double d2 = norm2(x - p);
      for (int u = 0; u <= 6; ++u)
        for (int v = 0; u + v <= 6; ++v) {
          const auto f = soup[i];
          const auto q = f[0] + (u / 6.0) * (f[1] - f[0]) + (v / 6.0) * (f[2] - f[0]);
          if (norm2(x - q) < d2 * (1 - 1e-12)) FAIL("another point of the triangle is nearer");
        }
    }
    CHECK(tree.nearest(x).distance2 == nearest2);
    CHECK(tree.winding(x, std::numeric_limits<double>::infinity()) ==
          Approx(winding).margin(1e-12));
  }
}

TEST_CASE("the winding by area vectors is near the exact one", "[geometry]") {
  const FacetTree<3> tree(test::torus(120, 60, 1, 0.4));
  const FacetTree<2> flat(outlines({circle(1000, 1)}));
  test::Random random(4);
  double worst = 0, worst_flat = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto x = random.vector<3>(1.5);
    const double exact = torus_distance(x, 1, 0.4) < 0 ? 1 : 0;
    if (std::abs(torus_distance(x, 1, 0.4)) > 0.01)
      worst = std::max(worst, std::abs(tree.winding(x) - exact));
    const auto y = random.vector<2>(1.5);
    if (std::abs(std::sqrt(norm2(y)) - 1) > 0.001)
      worst_flat = std::max(worst_flat, std::abs(flat.winding(y) - (norm2(y) < 1 ? 1 : 0)));
  }
  CHECK(worst < 0.1);
  CHECK(worst_flat < 0.05);
  CHECK(worst > 1e-6);  // so that it is the approximation that is measured
}

TEST_CASE("inside is told rightly away from holes where triangles are missing", "[geometry]") {
  const auto whole = test::torus(120, 60, 1, 0.4);
  const double edge = 2 * pi * 1.4 / 120;
  for (const double share : {0.01, 0.05}) {
    const TriangleMesh mesh(test::without(whole, share, 5));
    test::Random random(6);
    int tried = 0;
    for (int trial = 0; trial < 4000; ++trial) {
      const auto x = random.vector<3>(1.5);
      const double d = torus_distance(x, 1, 0.4);
      if (std::abs(d) < 0.5 * edge) continue;
      ++tried;
      if (mesh.inside(x) != (d < 0)) FAIL("wrong side at a distance of " << d << " m");
    }
    CHECK(tried > 3000);
  }
}

TEST_CASE("a surface with one large hole still has an inside", "[geometry]") {
  // A box without two of its six faces' triangles, of one face: open at the bottom.
  auto open = test::box({0, 0, 0}, {1, 1, 1});
  open.corners.erase(open.corners.begin(), open.corners.begin() + 2);
  const TriangleMesh mesh(open);
  CHECK(mesh.inside({0.5, 0.5, 0.5}));
  CHECK(mesh.inside({0.1, 0.9, 0.3}));
  CHECK_FALSE(mesh.inside({0.5, 0.5, -0.01}));
  CHECK_FALSE(mesh.inside({0.5, 0.5, 1.01}));
  CHECK_FALSE(mesh.inside({0.5, 1.2, 0.5}));
}

TEST_CASE("a surface may be inside out, and solids may overlap or be hollow", "[geometry]") {
  auto turned = test::sphere(8, 1);
  for (auto& c : turned.corners) std::swap(c[0], c[1]);
  CHECK(volume(turned) < 0);
  CHECK(TriangleMesh(turned).distance({0, 0, 0}) < -0.9);
  CHECK(TriangleMesh(turned).distance({2, 0, 0}) > 0.9);
  CHECK(TriangleMesh(turned).normal({0.9, 0.1, 0})[0] > 0.9);

  const auto joined = [](test::Triangles a, const test::Triangles& b) {
    const auto shift = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const auto& c : b.corners) a.corners.push_back({c[0] + shift, c[1] + shift, c[2] + shift});
    return a;
  };
  const TriangleMesh both(joined(test::sphere(8, 1), test::sphere(8, 1, {0.5, 0, 0})));
  CHECK(both.inside({0.25, 0, 0}));
  CHECK(both.inside({-0.7, 0, 0}));
  CHECK(both.inside({1.2, 0, 0}));
  auto hollow = test::sphere(8, 0.5);
  for (auto& c : hollow.corners) std::swap(c[0], c[1]);
  const TriangleMesh shell(joined(test::sphere(8, 1), hollow));
  CHECK(shell.distance({0, 0, 0}) > 0.45);
  CHECK(shell.distance({0.75, 0, 0}) < -0.2);
}

TEST_CASE("an outline is the polygon, and one within it is a hole whichever way round it goes",
          "[geometry]") {
  std::vector<Vec<2>> corners{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const Polygon polygon(corners);
  const Outline outline(outlines({corners}));
  std::reverse(corners.begin(), corners.end());
  const Outline backwards(outlines({corners}));
  test::Random random(7);
  for (int trial = 0; trial < 1000; ++trial) {
    const auto x = random.vector<2>(4);
    CHECK(std::abs(outline.distance(x) - polygon.distance(x)) < 1e-14);
    CHECK(std::abs(backwards.distance(x) - polygon.distance(x)) < 1e-14);
  }
  for (const double way : {1.0, -1.0}) {
    const Outline ring(outlines({circle(400, 1), circle(400, 0.5, way)}));
    CHECK(ring.distance({0, 0}) == Approx(0.5).margin(1e-4));
    CHECK(ring.distance({0.7, 0}) == Approx(-0.2).margin(1e-4));
    CHECK(ring.distance({1.2, 0}) == Approx(0.2).margin(1e-4));
  }
  const Outline filled(outlines({circle(400, 1), circle(400, 0.5)}), Fill::any);
  CHECK(filled.inside({0, 0}));
}

TEST_CASE("normals are slopes of the distance, and facets' own on the surface", "[geometry]") {
  const TriangleMesh mesh(test::torus(60, 30, 1, 0.4));
  const Outline outline(outlines({circle(100, 1)}));
  test::Random random(8);
  int kinks = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto x = random.vector<3>(1.5);
    kinks += norm2(mesh.normal(x) - slope(mesh, x, 1e-6)) > 1e-10 ? 1 : 0;
    CHECK(norm2(mesh.normal(x)) == Approx(1));
    const auto y = random.vector<2>(1.5);
    kinks += norm2(outline.normal(y) - slope(outline, y, 1e-6)) > 1e-10 ? 1 : 0;
  }
  CHECK(kinks <= 4);
  const TriangleMesh box(test::box({0, 0, 0}, {1, 1, 1}));
  CHECK(box.normal({1, 0.3, 0.4}) == Vec<3>{1, 0, 0});
  CHECK(box.normal({0.2, 0, 0.4}) == Vec<3>{0, -1, 0});
  CHECK(outside(box).normal({1, 0.3, 0.4}) == Vec<3>{-1, 0, 0});
  // In the middle all faces are as near.
  CHECK(norm2(box.normal({0.5, 0.5, 0.5})) == Approx(1));
}

TEST_CASE("particles of a sphere of triangles are those of the ball", "[geometry]") {
  const double dx = 0.1;
  const auto domain = test::cube<3>(2, false);
  const Ball<3> ball{{1.003, 0.998, 1.001}, 0.6};
  const TriangleMesh mesh(test::sphere(100, ball.radius, ball.centre));
  const Lattice<3> lattice{dx, {dx / 2, dx / 2, dx / 2}};
  CHECK(lattice.points(mesh, domain) == lattice.points(ball, domain));
  CHECK(lattice.points(domain.box - mesh, domain) == lattice.points(domain.box - ball, domain));
  sphmbs::particles::Cloud<3> exact, meshed;
  exact.add_virtual(lattice.inner_points(ball, domain), {.rho = 1, .p = 1}, {dx}, ball);
  meshed.add_virtual(lattice.inner_points(mesh, domain), {.rho = 1, .p = 1}, {dx}, mesh);
  REQUIRE(exact.size() == meshed.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CHECK(meshed.depth[i] == Approx(exact.depth[i]).margin(1e-3 * dx));
    // A triangle's normal is off by the angle that it spans.
    CHECK(norm2(meshed.normal[i] - exact.normal[i]) < 1e-3);
  }
}

TEST_CASE("points of a profile on its line of symmetry know a normal", "[geometry]") {
  // As far from above as from below, where the distance has no slope across.
  const Outline plate(outlines({{{0, 0}, {2, 0}, {2, 0.4}, {0, 0.4}}}));
  const std::vector<Vec<2>> middle{{0.5, 0.2}, {1, 0.2}, {1.5, 0.2}};
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_virtual(middle, {.rho = 1, .p = 1}, {0.1}, plate);
  for (const auto& n : cloud.normal) CHECK(std::abs(n[1]) == 1);
}

TEST_CASE("facets without extent, or that are not finite, are refused or left out", "[geometry]") {
  CHECK_THAT(test::refusal([] { TriangleMesh(Facets<3>{}); }), Contains("surface of 0 facets"));
  Facets<3> flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}};
  CHECK_THAT(test::refusal([&] { TriangleMesh{flat}; }), Contains("surface of 2 facets"));
  auto box = test::box({0, 0, 0}, {1, 1, 1});
  box.corners.push_back({0, 0, 1});
  CHECK(TriangleMesh(box).distance({0.5, 0.5, 0.25}) == -0.25);
  box.corners.push_back({0, 1, 8});
  CHECK_THAT(test::refusal([&] { TriangleMesh{box}; }),
             Contains("facet 13") && Contains("corner 8"));
  box.corners.pop_back();
  box.points[3][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(test::refusal([&] { TriangleMesh{box}; }), Contains("point 3"));
}
