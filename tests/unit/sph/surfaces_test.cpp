// SPDX-License-Identifier: MIT
// Walls whose surface is known.
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/boundary/extrapolated.hpp>
#include <sphmbs/boundary/mirrored.hpp>
#include <sphmbs/reconstruction/muscl.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

namespace sph = sphmbs::sph;
namespace boundary = sphmbs::boundary;
using sphmbs::Vec;

constexpr double spacing = 0.1;
constexpr double surface = 0.4;

template <class Wall, class... Policies>
using Gas = sph::RiemannSph<sphmbs::kernels::QuinticSpline<2>, sphmbs::riemann::Acoustic,
                            sphmbs::eos::IdealGas, Wall, Policies...>;

struct Floor {
  static constexpr int dim = 2;
  double distance(Vec<2> x) const { return x[1] - surface; }
};

/// All virtual particles move with one velocity, which changes no place during a test.
struct Sliding {
  Vec<2> speed;
  template <class T>
  Vec<2, T> position(sphmbs::boundary::Mark, const Vec<2, T>& r, double, double) const {
    return r;
  }
  template <class T>
  Vec<2, T> velocity(sphmbs::boundary::Mark, const Vec<2, T>&, double) const {
    return speed.to<T>();
  }
};

/// Gas above a floor, on a lattice that goes on through it; periodic along the floor.
sphmbs::particles::Cloud<2> above_floor(std::uint64_t disorder = 0) {
  std::vector<Vec<2>> below, above;
  for (const auto& x : test::cell_centres<2>(20, spacing))
    (x[1] > surface ? above : below).push_back(x);
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(above, test::still_air<2>(), {.spacing = spacing});
  if (disorder != 0) test::disturb(cloud, spacing, disorder);
  cloud.add_virtual(below, test::still_air<2>(), {.spacing = spacing}, Floor{});
  return cloud;
}

sphmbs::geometry::Domain<2> strip() {
  sphmbs::geometry::Domain<2> domain = test::cube<2>(2, false);
  domain.periodic[0] = true;
  return domain;
}

boundary::Meeting<2, double> meeting() {
  boundary::Meeting<2, double> m{};
  m.gas = {
      .r = {}, .v = {30, -4}, .rho = 1.2, .p = 1e5, .c = 340, .h = 0.125, .m = 0.012, .shell = 0, .rest = {}};
  m.d = {0.05, -0.2};
  m.normal = {0, -1};
  m.depth = 0.15;  // the gas is 0.05 from the surface
  return m;
}

}  // namespace

TEST_CASE("gas that slips keeps its speed along the wall and meets the wall's across it",
          "[boundary]") {
  // The middle is 0.1 below the gas and 0.05 below the surface: the velocity across, 4 at the gas
  // and 1 at the surface, has gone on to -2.
  auto m = meeting();
  m.wall_velocity = {500, -1};
  const auto c = boundary::FreeSlip{}.contact(m);
  CHECK(c.v[0] == Approx(30));
  CHECK(c.v[1] == Approx(2));
}

TEST_CASE("gas that sticks meets the wall's velocity at the surface", "[boundary]") {
  auto m = meeting();
  m.wall_velocity = {10, -1};
  const auto c = boundary::NoSlip{}.contact(m);
  CHECK(c.v[0] == Approx(30 - 2 * 20));
  CHECK(c.v[1] == Approx(2));
}

TEST_CASE("the wall's pressure follows the gas's slope, and a shock where gas runs into it",
          "[boundary]") {
  auto m = meeting();
  m.slopes.p = {1000, -2000};
  m.slopes.v[1] = {0, -80};  // the gas's own slope brings the velocity across to 0 at the surface
  CHECK(boundary::FreeSlip{}.contact(m).p == Approx(1e5 + 0.5 * (50 + 400)));
  m.slopes.v[1] = {0, 0};
  m.slopes.p = {0, 0};
  CHECK(boundary::FreeSlip{}.contact(m).p == Approx(1e5 + 1.2 * 3 * 4 * 4));
  m.gas.v[1] = -1000;
  CHECK(boundary::FreeSlip{}.contact(m).p == Approx(1e5 + 1.2 * 340 * 1000));
  m.gas.v[1] = 1000;
  CHECK(boundary::FreeSlip{}.contact(m).p == Approx(1e5));
  m.slopes.p = {0, -1e9};
  CHECK(boundary::FreeSlip{}.contact(m).p == Approx(1e5 + 0.2 * 1.2 * 340 * 340));
}

TEST_CASE("gas that all but touches the wall, or is behind it, has a finite contact",
          "[boundary]") {
  for (const double depth : {0.2, 0.2 - 1e-300, 0.3}) {
    auto m = meeting();
    m.depth = depth;
    const auto c = boundary::FreeSlip{}.contact(m);
    CHECK(c.v[1] == Approx(-4 + 4 * boundary::FreeSlip{}.steepest));
  }
  auto m = meeting();
  m.d = {0.05, 0.0};
  CHECK(std::isfinite(boundary::NoSlip{}.contact(m).v[0]));
}

TEMPLATE_LIST_TEST_CASE("gas at rest on a lattice beside a wall stays at rest", "[sph]",
                        test::Policies) {
  const auto cloud = above_floor();
  const auto rates = test::rates_of<TestType, double>(
      Gas<boundary::FreeSlip, sphmbs::reconstruction::Muscl<>, sph::VolumeForm>{}, strip(), cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != sphmbs::particles::gas || cloud.r[i][1] > 1.5) continue;
    CHECK(test::length(rates.v[i]) < 1e-6);  // of 1e6 m/s^2, which one pair gives
    CHECK(std::abs(rates.rho[i]) < 1e-12);
  }
}

TEMPLATE_LIST_TEST_CASE("a flow that is linear up to the wall is compressed alike everywhere",
                        "[sph]", test::Policies) {
  // v = (a x + b (y - surface), -k (y - surface)) slips along the floor.
  auto cloud = above_floor();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.set[i] == sphmbs::particles::gas)
      cloud.v[i] = {3 * (cloud.r[i][1] - surface), -5 * (cloud.r[i][1] - surface)};
  const auto rates = test::rates_of<TestType, double>(
      Gas<boundary::FreeSlip, sphmbs::reconstruction::Muscl<>, sph::VolumeForm>{}, strip(), cloud);
  double inside = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (std::abs(cloud.r[i][1] - 1.05) < 1e-9) inside = rates.rho[i];
  CHECK(inside == Approx(5 * 1.2).epsilon(2e-3));
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.set[i] == sphmbs::particles::gas && cloud.r[i][1] < 1)
      CHECK(rates.rho[i] == Approx(inside).epsilon(1e-9));
}

TEMPLATE_TEST_CASE("what walls with a surface lose in momentum and energy the gas gains", "[sph]",
                   boundary::FreeSlip, boundary::NoSlip) {
  const auto cloud = above_floor(81);
  const Vec<2> speed{20, -35};
  const auto check = [&](auto gas) {
    sph::Fluid<decltype(gas), sphmbs::execution::OpenMP, Sliding> fluid(gas, strip(), cloud,
                                                                        Sliding{speed});
    fluid.stage(0, 0);
    fluid.rates(0);
    const auto rates = test::rates_by_id(fluid);
    test::Sum momentum[2], energy;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      for (int k = 0; k < 2; ++k) momentum[k].add(cloud.m[i] * rates.v[i][k]);
      if (cloud.set[i] != sphmbs::particles::gas) {
        CHECK(rates.rho[i] == 0);
        CHECK(rates.e[i] == 0);
        continue;
      }
      energy.add(cloud.m[i] * dot(cloud.v[i], rates.v[i]));
      energy.add(cloud.m[i] * rates.e[i]);
      energy.add(-gas.background * cloud.m[i] / (cloud.rho[i] * cloud.rho[i]) * rates.rho[i]);
    }
    for (const auto& m : momentum) CHECK(m.share() < 1e-12);
    fluid.commit(1e-6, 1e-6);
    const double given = fluid.exchange().driving_work();
    CHECK(std::abs(given - 1e-6 * energy.value) < 1e-12 * 1e-6 * energy.size);
    CHECK(fluid.exchange().wall_work() ==
          Approx(-1e-6 * dot(fluid.survey().wall_force, speed)).epsilon(1e-12));
  };
  using Muscl = sphmbs::reconstruction::Muscl<>;
  check(Gas<TestType, Muscl, sph::VolumeForm>{.background = 5e4});
  Gas<TestType, Muscl, sph::VolumeForm, sph::Newtonian> viscous{
      .stress = {.viscosity = 20, .conductivity = 1e4, .bulk = 15}};
  check(viscous);
  viscous.wall.isothermal = true;
  check(viscous);
}

TEMPLATE_LIST_TEST_CASE("the mirror's work is the gas's gain pair by pair", "[sph]",
                        test::Policies) {
  const auto cloud = above_floor(82);
  sph::Fluid<Gas<boundary::Mirrored>, TestType, Sliding> fluid({}, strip(), cloud,
                                                               Sliding{{20, -35}});
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto rates = test::rates_by_id(fluid);
  test::Sum energy;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.set[i] == sphmbs::particles::gas) {
      energy.add(cloud.m[i] * dot(cloud.v[i], rates.v[i]));
      energy.add(cloud.m[i] * rates.e[i]);
    }
  fluid.commit(1e-6, 1e-6);
  CHECK(std::abs(fluid.exchange().wall_work() - 1e-6 * energy.value) < 1e-18 * energy.size);
}

TEMPLATE_TEST_CASE("dense gas at rest beside a wall of another density stays at rest", "[sph]",
                   boundary::FreeSlip, boundary::NoSlip, boundary::Mirrored) {
  auto cloud = above_floor();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != sphmbs::particles::gas) continue;
    cloud.rho[i] *= 4;
    cloud.m[i] *= 4;
  }
  const auto check = [&](const auto& gas) {
    const auto rates = test::rates_of(gas, strip(), cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.set[i] == sphmbs::particles::gas && cloud.r[i][1] < 1.5)
        CHECK(test::length(rates.v[i]) < 1e-6);
  };
  check(Gas<TestType>{});
  check(Gas<TestType, sph::VolumeForm, sphmbs::reconstruction::Muscl<>>{});
}

TEST_CASE("virtual particles outside of the solid they are said to be in are refused", "[sph]") {
  sphmbs::particles::Cloud<2> cloud;
  CHECK_THROWS_WITH(
      cloud.add_virtual({{0.05, 0.55}}, test::still_air<2>(), {.spacing = spacing}, Floor{}),
      Catch::Contains("below its solid's surface") && Catch::Contains("outside(shape)"));
  CHECK(cloud.size() == 0);
}

TEST_CASE("walls that need a surface are refused without one", "[sph]") {
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(test::cell_centres<2>(4, spacing), test::still_air<2>(), {.spacing = spacing});
  cloud.add_virtual({{0.05, -0.05}}, test::still_air<2>(), {.spacing = spacing});
  CHECK_THROWS_WITH(sph::Fluid<Gas<boundary::FreeSlip>>({}, test::cube<2>(1, false), cloud),
                    Catch::Contains("set of virtual particles = 1") && Catch::Contains("solid"));
  struct Flat {
    double distance(Vec<2>) const { return -1; }
  };
  CHECK_THROWS_WITH(cloud.add_virtual({{0, 0}}, test::still_air<2>(), {.spacing = spacing}, Flat{}),
                    Catch::Contains("distance"));
}

TEST_CASE("parameters of walls, shifting and relaxation are checked", "[sph]") {
  CHECK_THROWS_WITH((boundary::FreeSlip{.steepest = 0.1}.check()), Catch::Contains("steepest"));
  CHECK_THROWS_WITH((boundary::NoSlip{.strength = -1}.check()), Catch::Contains("dissipation"));
  CHECK_THROWS_WITH((sph::Shifting{.strength = -1}.check()), Catch::Contains("shifting"));
  CHECK_THROWS_WITH((sph::Relaxed{.rate = 2}.check()), Catch::Contains("relaxation"));
}
