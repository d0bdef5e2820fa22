// SPDX-License-Identifier: MIT
#include <sphmbs/sph/probe.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <sphmbs/geometry/samples.hpp>
#include <sphmbs/sph/probe_fields.hpp>

#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

namespace sph = sphmbs::sph;
using sphmbs::Vec;
using sphmbs::execution::OpenMP;
using sphmbs::execution::Serial;

constexpr double spacing = 0.1;

template <int Dim, class Policy = Serial, class T = double>
using Fluid = sph::Fluid<test::Gas<Dim>, Policy, sphmbs::boundary::Fixed, T>;

/// Gas at all points of a lattice, from a function of the place.
template <int Dim, class State>
sphmbs::particles::Cloud<Dim> cloud_of(int per_side, double dx, const State& state) {
  auto cloud = test::lattice_cloud<Dim>(per_side, dx, test::still_air<Dim>());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const sphmbs::particles::State<Dim> s = state(cloud.r[i]);
    cloud.rho[i] = s.rho;
    cloud.p[i] = s.p;
    cloud.v[i] = s.v;
    cloud.m[i] = s.rho * std::pow(dx, Dim);
  }
  return cloud;
}

/// Eq. (8) by its words: all particles and all their images, one after the other.
template <int Dim>
sph::LocalGas<Dim> direct(const sphmbs::particles::Cloud<Dim>& cloud,
                          const sphmbs::geometry::Domain<Dim>& domain, const Vec<Dim>& x) {
  using Kernel = sphmbs::kernels::QuinticSpline<Dim>;
  sph::LocalGas<Dim> sum{};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (int image = 0; image < sphmbs::math::power<Dim>(5); ++image) {
      Vec<Dim> d = cloud.r[i] - x;
      bool is_one = true;
      for (int k = 0, code = image; k < Dim; ++k, code /= 5) {
        const int shift = code % 5 - 2;
        is_one = is_one && (shift == 0 || domain.periodic[static_cast<std::size_t>(k)]);
        d[k] += shift * domain.box.length(k);
      }
      const double weight = cloud.m[i] / cloud.rho[i] *
                            sphmbs::kernels::value<Kernel>(std::sqrt(norm2(d)), 1 / cloud.h[i]);
      if (!is_one || !(weight > 0)) continue;
      sum.share += weight;
      sum.rho += weight * cloud.rho[i];
      sum.p += weight * cloud.p[i];
      sum.v += weight * cloud.v[i];
      ++sum.seen;
    }
  sum.rho /= sum.share;
  sum.p /= sum.share;
  sum.v = 1 / sum.share * sum.v;
  return sum;
}

template <int Dim>
void check_against_direct(bool periodic) {
  CAPTURE(Dim, periodic);
  const int n = Dim == 3 ? 9 : 14;
  const double side = n * spacing;
  const auto domain = test::cube<Dim>(side, periodic);
  auto cloud = test::disordered_cloud<Dim>(n, spacing, 7);
  domain.wrap(cloud.r);
  Fluid<Dim> fluid(test::Gas<Dim>{}, domain, cloud);
  test::Random random(11);
  std::vector<Vec<Dim>> points;
  for (int i = 0; i < 40; ++i)
    points.push_back(Vec<Dim>::all(side / 2) + random.vector<Dim>(side / 2));
  const auto found = sph::gas_at(fluid, std::span<const Vec<Dim>>(points));
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto expected = direct(cloud, domain, points[p]);
    CAPTURE(p);
    CHECK(found[p].seen == expected.seen);
    CHECK(found[p].share == Approx(expected.share).epsilon(1e-12));
    CHECK(found[p].rho == Approx(expected.rho).epsilon(1e-12));
    CHECK(found[p].p == Approx(expected.p).epsilon(1e-12));
    CHECK(found[p].e == Approx(expected.p / (0.4 * expected.rho)).epsilon(0.2));
    for (int k = 0; k < Dim; ++k) CHECK(found[p].v[k] == Approx(expected.v[k]).margin(1e-10));
  }
}

bool all_nan(const sph::LocalGas<2>& gas) {
  return std::isnan(gas.rho) && std::isnan(gas.p) && std::isnan(gas.e) && std::isnan(gas.v[0]) &&
         std::isnan(gas.v[1]);
}

}  // namespace

TEST_CASE("a probe meets what the sum over all particles and images gives", "[sph]") {
  for (const bool periodic : {false, true}) {
    check_against_direct<1>(periodic);
    check_against_direct<2>(periodic);
    check_against_direct<3>(periodic);
  }
}

TEMPLATE_LIST_TEST_CASE("a uniform field is met at any point, walls or not", "[sph]",
                        test::Policies) {
  const auto check = [](auto number, double tolerance) {
    auto cloud = test::disordered_cloud<2>(
        14, spacing, 3, {.speed = 0, .density = 0, .pressure = 0, .smoothing = 0.2, .mass = 0.1});
    std::vector<Vec<2>> wall;
    for (const auto& x : test::cell_centres<2>(14, spacing)) wall.push_back(x - Vec<2>{0, 1.4});
    for (Vec<2>& v : cloud.v) v = {30, -40};
    cloud.add_virtual(wall, {.rho = 7, .p = 3, .v = {9, 9}}, {.spacing = spacing});
    Fluid<2, TestType, decltype(number)> fluid(test::Gas<2>{}, test::cube<2>(1.4, false), cloud);
    for (const Vec<2>& x :
         {Vec<2>{0.7, 0.7}, Vec<2>{0, 0}, Vec<2>{0.31, 0.001}, Vec<2>{1.4, 0.5}}) {
      const auto gas = sph::gas_at(fluid, x);
      CHECK(gas.rho == Approx(1.2).epsilon(tolerance));
      CHECK(gas.p == Approx(1e5).epsilon(tolerance));
      CHECK(gas.e == Approx(1e5 / (0.4 * 1.2)).epsilon(tolerance));
      CHECK(gas.v[0] == Approx(30).epsilon(tolerance));
      CHECK(gas.v[1] == Approx(-40).epsilon(tolerance));
      CHECK(gas.seen > 0);
    }
    CHECK(sph::gas_at(fluid, Vec<2>{0.7, 0.7}).share == Approx(1).epsilon(0.1));
    CHECK(sph::gas_at(fluid, Vec<2>{0.7, 0.0}).share == Approx(0.5).epsilon(0.1));
  };
  SECTION("double") { check(double{}, 1e-12); }
  SECTION("float") { check(float{}, 3e-7); }
}

TEST_CASE("a probe is second-order accurate, and exact for linear fields by symmetry", "[sph]") {
  const auto error = [](int n, auto field) {
    const double dx = 1.0 / n;
    Fluid<2> fluid(test::Gas<2>{}, test::cube<2>(1, false),
                   cloud_of<2>(n, dx, [&](const Vec<2>& x) {
                     return sphmbs::particles::State<2>{.rho = 1, .p = field(x), .v = {}};
                   }));
    double worst = 0;
    for (const auto& x : sphmbs::geometry::points_along<2>({0.31, 0.42}, {0.64, 0.55}, 23))
      worst = std::max(worst, std::abs(sph::gas_at(fluid, x).p - field(x)));
    return worst;
  };
  const auto linear = [](const Vec<2>& x) { return 5 + 2 * x[0] - 3 * x[1]; };
  const auto wave = [](const Vec<2>& x) { return 5 + std::sin(3 * x[0]) * std::cos(2 * x[1]); };
  CHECK(error(20, linear) < 1e-3 / 20);  // a thousandth of the change over a spacing
  CHECK(error(20, wave) / error(40, wave) == Approx(4).epsilon(0.05));
}

TEST_CASE("a probe that sees no gas is NaN, near virtual particles too", "[sph]") {
  auto cloud = test::lattice_cloud<2>(6, spacing, test::still_air<2>());
  std::vector<Vec<2>> wall;
  for (const auto& x : test::cell_centres<2>(6, spacing)) wall.push_back(x + Vec<2>{1.4, 0});
  cloud.add_virtual(wall, test::still_air<2>(), {.spacing = spacing});
  Fluid<2> fluid(test::Gas<2>{}, test::cube<2>(2, false), cloud);
  const std::vector<Vec<2>> points{{1.7, 0.3}, {0.3, 0.3}, {1, 1.9}};
  const auto found = sph::gas_at(fluid, std::span<const Vec<2>>(points));
  for (const std::size_t p : {0u, 2u}) {
    CHECK(found[p].seen == 0);
    CHECK(found[p].share == 0);
    CHECK(all_nan(found[p]));
  }
  CHECK(found[1].seen > 20);
  CHECK(found[1].p == Approx(1e5));
  const auto inside = sph::gas_inside(fluid, {.lower = {1.4, 0}, .upper = {2, 0.6}});
  CHECK(inside.particles == 0);
  CHECK(inside.mass == 0);
  CHECK(all_nan(inside.mean));
}

TEST_CASE("boxes that fill the domain add up to its totals", "[sph]") {
  const auto domain = test::cube<2>(1.4, true);
  auto cloud = test::disordered_cloud<2>(14, spacing, 5);
  Fluid<2> fluid(test::Gas<2>{}, domain, cloud);
  const auto totals = fluid.totals();
  // Shifted by a third of the domain: two of the boxes reach across its border.
  double mass = 0, volume = 0, kinetic = 0, internal = 0, force = 0;
  Vec<2> momentum{};
  std::uint64_t particles = 0;
  for (const Vec<2>& corner : {Vec<2>{0.5, 0.4}, Vec<2>{1.1, 0.4}}) {
    const auto part = sph::gas_inside(fluid, {corner, {corner[0] == 0.5 ? 1.1 : 1.9, 0.4 + 1.4}});
    particles += part.particles;
    mass += part.mass;
    volume += part.volume;
    momentum += part.momentum;
    kinetic += part.kinetic;
    internal += part.internal;
    force += part.volume * part.mean.p;
    CHECK(part.particles > 60);
    CHECK(part.mean.rho * part.volume == Approx(part.mass).epsilon(1e-12));
  }
  CHECK(particles == 14 * 14);
  CHECK(mass == Approx(totals.mass).epsilon(1e-12));
  CHECK(volume == Approx(totals.volume).epsilon(1e-12));
  CHECK(kinetic == Approx(totals.kinetic).epsilon(1e-12));
  CHECK(internal == Approx(totals.internal).epsilon(1e-12));
  CHECK(internal == Approx(force / 0.4).epsilon(1e-12));
  for (int k = 0; k < 2; ++k) CHECK(momentum[k] == Approx(totals.momentum[k]).epsilon(1e-12));
  CHECK_THROWS_AS(sph::gas_inside(fluid, {{0, 0}, {2, 1}}), sphmbs::InvalidInput);
  CHECK_THROWS_AS(sph::gas_inside(fluid, {{0, 0}, {0, 1}}), sphmbs::InvalidInput);
}

TEST_CASE("a probe has the same bits in any number of threads, and for any order of particles",
          "[sph]") {
  const auto domain = test::cube<3>(1.4, true);
  const auto cloud = test::disordered_cloud<3>(14, spacing, 9);
  const auto points = sphmbs::geometry::points_across<3>({{0, 0.2, 0.7}, {1.4, 1.1, 0.7}}, 15);
  CHECK(points.rows == 10);
  const auto sample = [&](auto policy, bool sorted) {
    Fluid<3, decltype(policy)> fluid(test::Gas<3>{}, domain, cloud);
    if (sorted) fluid.stage(0, 0);
    std::vector<double> numbers;
    for (const auto& gas : sph::gas_at(fluid, std::span<const Vec<3>>(points.points)))
      numbers.insert(numbers.end(), {gas.rho, gas.p, gas.e, gas.v[0], gas.v[1], gas.v[2]});
    if (sorted) {
      const auto inside = sph::gas_inside(fluid, {{0.2, 0.1, 0.3}, {1.1, 0.9, 1.5}});
      numbers.insert(numbers.end(), {inside.mass, inside.kinetic, inside.mean.p});
    }
    return numbers;
  };
  const auto expected = sample(Serial{}, true);
  for (const int count : {1, 2, 4}) {
    const test::Threads threads(count);
    CHECK(test::same_bits(sample(OpenMP{}, true), expected));
  }
  auto unsorted = sample(Serial{}, false);
  CHECK(test::same_bits(unsorted, {expected.begin(), expected.end() - 3}));
}

TEST_CASE("fields of the local gas, by name", "[sph]") {
  const test::Gas<2> scheme{};
  const std::vector<std::string> names{"p", "rho", "e", "v", "speed", "c", "T", "mach"};
  const auto fields = sph::probe_fields(scheme, std::span<const std::string>(names));
  const sph::LocalGas<2> gas{.rho = 1.2, .p = 1e5, .e = 2e5, .v = {30, 40}, .share = 1, .seen = 9};
  const double c = std::sqrt(1.4 * 1e5 / 1.2);
  const std::vector<double> expected{1e5,   1.2, 2e5, 30, 40, 50, c, 1e5 / 1.2 * 0.02895 / 8.314,
                                     50 / c};
  const std::vector<std::string> heads{"p", "rho", "e", "v_x", "v_y", "speed", "c", "T", "mach"};
  REQUIRE(fields.size() == expected.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    CHECK(fields[f].name == heads[f]);
    CHECK(!fields[f].unit.empty());
    CHECK(fields[f].value(gas) == Approx(expected[f]).epsilon(1e-14));
  }
  const std::vector<std::string> wrong{"p", "vx"};
  CHECK_THROWS_WITH(sph::probe_fields(scheme, std::span<const std::string>(wrong)),
                    Catch::Contains("\"vx\": must be one of p, rho"));
}

TEST_CASE("points along lines and across planes", "[geometry]") {
  namespace geometry = sphmbs::geometry;
  const auto line = geometry::points_along<3>({0, 1, 2}, {3, 1, 0}, 4);
  REQUIRE(line.size() == 4);
  CHECK(line.front() == Vec<3>{0, 1, 2});
  CHECK(line.back() == Vec<3>{3, 1, 0});
  CHECK(line[1][0] == Approx(1));
  const auto plane = geometry::points_across<3>({{0, 5, 1}, {1, 5, 3}}, 5);
  CHECK(plane.along_row == 3);
  CHECK(plane.rows == 5);
  REQUIRE(plane.points.size() == 15);
  CHECK(plane.points.back() == Vec<3>{1, 5, 3});
  CHECK(plane.points[1] == Vec<3>{0.5, 5, 1});
  CHECK_THROWS_AS(geometry::points_across<3>({{0, 0, 0}, {1, 1, 1}}, 5), sphmbs::InvalidInput);
  CHECK_THROWS_AS(geometry::points_across<2>({{0, 0}, {1, 0}}, 5), sphmbs::InvalidInput);
  CHECK_THROWS_AS(geometry::points_along<2>({0, 0}, {1, 0}, 1), sphmbs::InvalidInput);
}
