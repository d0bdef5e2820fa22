// SPDX-License-Identifier: MIT
// Gas at rest around a body from triangles or an outline stays as much at rest as around a ball.
#include <cmath>

#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/io/path_text.hpp>
#include <sphmbs/io/stl.hpp>
#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/meshes.hpp"

namespace {

using namespace sphmbs;

constexpr double radius = 0.3, side = 1.2;  // [m]

struct Unrest {
  std::size_t gas;
  double speed;  // root of the gas's mean square [m/s]
  double force;  // on the body [N], [N/m]
};

/// What has come of gas at rest around a body in the middle of a periodic box, in the time in which
/// sound crosses it.
template <int dim, class Solid>
Unrest unrest(const Solid& body, double dx) {
  using Gas = sph::SmoothScheme<dim>;
  const auto domain = test::cube<dim>(side, true);
  const geometry::Lattice<dim> lattice{.spacing = dx, .origin = Vec<dim>::all(dx / 2)};
  const particles::State<dim> still{.rho = 1, .p = 1 / 1.4};  // sound of 1 m/s
  particles::Cloud<dim> cloud;
  cloud.add_gas(lattice.points(domain.box - body, domain), still, {dx});
  const int set = cloud.add_virtual(lattice.inner_points(body, domain), still, {dx}, body);
  const Gas gas{.eos = {.gamma = 1.4}};  // without background, so that a gap would be felt
  sph::Fluid<Gas, execution::OpenMP> fluid(gas, domain, std::move(cloud));
  run(fluid, time::PredictorCorrector{}, {.until = side}, no_report);
  const auto totals = fluid.totals();
  return {fluid.gas_count(), std::sqrt(2 * totals.kinetic / totals.mass),
          std::sqrt(norm2(fluid.force_on(set)))};
}

}  // namespace

TEST_CASE("gas at rest around a sphere of triangles stays as it does around the ball",
          "[geometry]") {
  const double dx = 0.1;
  const Vec<3> middle = Vec<3>::all(side / 2);
  const auto exact = unrest<3>(geometry::Ball<3>{middle, radius}, dx);
  const auto file = test::binary_stl(
      geometry::mapped(test::sphere(40, radius, middle), [](auto x) { return 1000.0 * x; }));
  const auto triangles = io::parse_stl(file, "sphere.stl", io::millimetre);
  const auto meshed = unrest<3>(geometry::TriangleMesh(triangles), dx);
  const auto torn = unrest<3>(geometry::TriangleMesh(test::without(triangles, 0.02, 1)), dx);
  CAPTURE(exact.speed, meshed.speed, torn.speed, exact.force, meshed.force, torn.force);
  for (const Unrest& found : {exact, meshed, torn}) {
    CHECK(found.gas == exact.gas);
    CHECK(found.speed < 1e-10);  // of 1 m/s, the speed of sound
    CHECK(found.force < 1e-10);
  }
}

TEST_CASE("gas at rest around a circle of arcs stays as it does around the ball", "[geometry]") {
  const double dx = 0.05;
  const auto exact = unrest<2>(geometry::Ball<2>{{side / 2, side / 2}, radius}, dx);
  const geometry::Outline circle(
      io::parse_path("M 0.9 0.6 A 0.3 0.3 0 0 1 0.3 0.6 A 0.3 0.3 0 0 1 0.9 0.6 Z", "circle.txt"));
  const auto drawn = unrest<2>(circle, dx);
  CAPTURE(exact.speed, drawn.speed, exact.force, drawn.force);
  for (const Unrest& found : {exact, drawn}) {
    CHECK(found.gas == exact.gas);
    CHECK(found.speed < 1e-10);
    CHECK(found.force < 1e-10);
  }
}
