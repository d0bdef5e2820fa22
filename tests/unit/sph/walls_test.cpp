// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

constexpr double rounding = 1e-12;
constexpr double spacing = 0.1;

template <int Dim>
using Cloud = sphmbs::particles::Cloud<Dim>;
template <class Wall>
using WalledGas = test::Gas<2, sphmbs::sph::Xsph, sphmbs::sph::Inviscid, Wall>;

/// A wall of no state of its own: the gas meets its mirror image.
struct Mirror {
  static constexpr bool evolves = false;
  static constexpr bool surfaces = false;
  static constexpr bool slips = false;
  void check() const {}
  template <class N>
  sphmbs::riemann::State<N> facing(const sphmbs::riemann::State<N>& gas,
                                   const sphmbs::riemann::State<N>& stored) const {
    return {.rho = gas.rho, .u = N(2) * stored.u - gas.u, .p = gas.p, .c = gas.c};
  }
};

/// All virtual particles move with one velocity, which changes no place during a test.
struct Sliding {
  sphmbs::Vec<2> speed;
  template <class T>
  sphmbs::Vec<2, T> position(sphmbs::boundary::Mark, const sphmbs::Vec<2, T>& r, double,
                             double) const {
    return r;
  }
  template <class T>
  sphmbs::Vec<2, T> velocity(sphmbs::boundary::Mark, const sphmbs::Vec<2, T>&, double) const {
    return speed.to<T>();
  }
};

/// Virtual particles slide along x the faster the higher they are, without changing their places.
struct Shearing {
  double gradient;
  template <class T>
  sphmbs::Vec<2, T> position(sphmbs::boundary::Mark, const sphmbs::Vec<2, T>& r, double,
                             double) const {
    return r;
  }
  template <class T>
  sphmbs::Vec<2, T> velocity(sphmbs::boundary::Mark, const sphmbs::Vec<2, T>& r, double) const {
    return {static_cast<T>(gradient) * r[1], T(0)};
  }
};

/// Gas in the upper part of a cube and two sets of virtual particles in the lower one.
Cloud<2> gas_above_walls(std::uint64_t seed) {
  std::vector<sphmbs::Vec<2>> left, right, above;
  for (const auto& x : test::cell_centres<2>(20, spacing))
    (x[1] > 0.4 ? above : x[0] < 1 ? left : right).push_back(x);
  Cloud<2> cloud;
  cloud.add_virtual(left, test::still_air<2>(), {.spacing = spacing});
  cloud.add_gas(above, test::still_air<2>(), {.spacing = spacing});
  cloud.add_virtual(right, test::still_air<2>(), {.spacing = spacing});
  test::disturb(cloud, spacing, seed);
  return cloud;
}

/// One gas particle at the origin and one virtual particle beside it.
Cloud<2> gas_beside_wall() {
  Cloud<2> cloud;
  cloud.add_gas({{0.0, 0.0}}, {.rho = 1.2, .p = 1e5, .v = {30, 10}}, {.spacing = spacing});
  cloud.add_virtual({{0.09, 0.12}}, {.rho = 5, .p = 9e5, .v = {}}, {.spacing = spacing});
  return cloud;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("pairs of virtual particles carry no load but evolve their state", "[sph]",
                        test::Policies) {
  auto cloud = test::disordered_cloud<2>(10, spacing, 51);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.set[i] = static_cast<std::uint8_t>(1 + i % 2);
  cloud.sets = 2;
  const auto rates =
      test::rates_of<TestType, double>(test::Gas<2>{}, test::cube<2>(1, false), cloud);
  test::Sum density;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    CHECK(rates.v[i] == sphmbs::Vec<2>{0, 0});
    density.add(rates.rho[i]);
  }
  CHECK(density.size > 0);
}

TEMPLATE_LIST_TEST_CASE("the forces on walls are what the gas loses in momentum", "[sph]",
                        test::Policies) {
  test::Gas<2> gas;
  gas.acceleration = {3000, -9810};
  const auto cloud = gas_above_walls(52);
  sphmbs::sph::Fluid<test::Gas<2>, TestType> fluid(gas, test::cube<2>(2, false), cloud);
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto rates = test::rates_by_id(fluid);
  for (int k = 0; k < 2; ++k) {
    test::Sum momentum;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.set[i] == sphmbs::particles::gas)
        momentum.add(cloud.m[i] * (rates.v[i][k] - gas.acceleration[k]));
    const double force = fluid.force_on(1)[k] + fluid.force_on(2)[k];
    CHECK(std::abs(force + momentum.value) < rounding * momentum.size);
    CHECK(std::abs(force) > 1e-6 * momentum.size);
  }
  CHECK(fluid.force_on(3) == sphmbs::Vec<2>{0, 0});
}

TEMPLATE_LIST_TEST_CASE("the force on a set is the sum over its particles alone", "[sph]",
                        test::Policies) {
  const auto cloud = gas_above_walls(53);
  sphmbs::sph::Fluid<test::Gas<2>, TestType> fluid({}, test::cube<2>(2, false), cloud);
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto rates = test::rates_by_id(fluid);
  for (int set = 1; set <= 2; ++set) {
    test::Sum force[2];
    for (std::size_t i = 0; i < cloud.size(); ++i)
      for (int k = 0; k < 2; ++k)
        if (cloud.set[i] == set) force[k].add(cloud.m[i] * rates.v[i][k]);
    for (int k = 0; k < 2; ++k)
      CHECK(std::abs(fluid.force_on(set)[k] - force[k].value) < rounding * force[k].size);
  }
}

TEMPLATE_LIST_TEST_CASE("the power of the gas on moving walls is their force times their velocity",
                        "[sph]", test::Policies) {
  const sphmbs::Vec<2> speed{20, -35};
  sphmbs::sph::Fluid<test::Gas<2>, TestType, Sliding> fluid({}, test::cube<2>(2, false),
                                                            gas_above_walls(54), Sliding{speed});
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto force = fluid.force_on(1) + fluid.force_on(2);
  const double expected = dot(force, speed);
  CHECK(fluid.survey().wall_power == Approx(expected).epsilon(rounding));
  CHECK(test::length(fluid.survey().wall_force - force) < rounding * test::length(force));
  fluid.commit(1e-6, 1e-6);
  CHECK(fluid.exchange().wall_work() == Approx(-1e-6 * expected).epsilon(rounding));
}

TEMPLATE_LIST_TEST_CASE("walls at rest do no work", "[sph]", test::Policies) {
  sphmbs::sph::Fluid<test::Gas<2>, TestType> fluid({}, test::cube<2>(2, false),
                                                   gas_above_walls(55));
  fluid.stage(0, 0);
  fluid.rates(0);
  fluid.commit(1e-6, 1e-6);
  CHECK(fluid.exchange().wall_work() == 0);
  CHECK(fluid.exchange().driving_work() == 0);
  CHECK(fluid.exchange().impulse() != sphmbs::Vec<2>{0, 0});
}

TEMPLATE_LIST_TEST_CASE(
    "gas and walls gain the energy that the drive of the walls and the body force spend", "[sph]",
    test::Policies) {
  test::Gas<2> gas;
  gas.acceleration = {3000, -9810};
  auto cloud = gas_above_walls(59);
  const Shearing motion{70};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.set[i] != sphmbs::particles::gas)
      cloud.v[i] = motion.velocity({1, 0}, cloud.r[i], 0.0);
  sphmbs::sph::Fluid<test::Gas<2>, TestType, Shearing> fluid(gas, test::cube<2>(2, false), cloud,
                                                             motion);
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto rates = test::rates_by_id(fluid);
  test::Sum gain;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    gain.add(cloud.m[i] * rates.e[i]);
    if (cloud.set[i] == sphmbs::particles::gas) gain.add(cloud.m[i] * dot(cloud.v[i], rates.v[i]));
  }
  fluid.commit(1e-6, 1e-6);
  const auto& exchange = fluid.exchange();
  CHECK(exchange.driving_work() != exchange.wall_work());
  CHECK(std::abs(exchange.driving_work() + exchange.body_work() - 1e-6 * gain.value) <
        rounding * 1e-6 * gain.size);
}

TEMPLATE_LIST_TEST_CASE("the impulse of walls and body force is the change of the gas's momentum",
                        "[sph]", test::Policies) {
  test::Gas<2> gas;
  gas.acceleration = {3000, -9810};
  sphmbs::sph::Fluid<test::Gas<2>, TestType> fluid(gas, test::cube<2>(2, false),
                                                   gas_above_walls(60));
  const auto before = fluid.totals().momentum;
  const auto check = [&](const auto& integrator) {
    for (int step = 0; step < 5; ++step) integrator.step(fluid, [] { return 1e-6; });
    const auto gained = fluid.totals().momentum - before;
    CHECK(test::length(gained) > 0);
    CHECK(test::length(gained - fluid.exchange().impulse()) < 1e-10 * test::length(gained));
  };
  SECTION("predictor-corrector") { check(sphmbs::time::PredictorCorrector{}); }
  SECTION("Heun") { check(sphmbs::time::Heun{}); }
  SECTION("Shu and Osher") { check(sphmbs::time::ShuOsher{}); }
}

TEMPLATE_LIST_TEST_CASE("gas meets the state that a wall model of one's own gives", "[sph]",
                        test::Policies) {
  const sphmbs::Vec<2> speed{-4, 8};
  const auto cloud = gas_beside_wall();
  const auto rates = test::rates_of<TestType, double>(WalledGas<Mirror>{}, test::cube<2>(1, false),
                                                      cloud, Sliding{speed});
  // A gas and its mirror image: u* is the wall's velocity and p* = p + rho c (u - u_wall).
  const double h = 1.25 * spacing;
  const sphmbs::Vec<2> n{0.6, 0.8};
  const double u = dot(cloud.v[0], n);
  const double u_wall = dot(speed, n);
  const double p_star = 1e5 + 1.2 * std::sqrt(1.4 * 1e5 / 1.2) * (u - u_wall);
  const double slope = sphmbs::kernels::derivative<sphmbs::kernels::QuinticSpline<2>>(0.15, 1 / h);
  // The virtual particle has the volume of its own mass and density, whatever the gas's.
  const double volume = cloud.m[1] / 5;
  const double push = volume * slope * p_star * 2 / 1.2;
  CHECK(rates.rho[0] == Approx(2 * 1.2 * volume * slope * (u_wall - u)).epsilon(rounding));
  CHECK(rates.e[0] == Approx(push * (u_wall - u)).epsilon(rounding));
  CHECK(rates.v[0][0] == Approx(push * n[0]).epsilon(rounding));
  CHECK(rates.v[0][1] == Approx(push * n[1]).epsilon(rounding));
}

TEMPLATE_LIST_TEST_CASE("virtual particles of a wall model without evolution keep their state",
                        "[sph]", test::Policies) {
  const auto cloud = gas_above_walls(56);
  const auto domain = test::cube<2>(2, false);
  sphmbs::sph::Fluid<WalledGas<Mirror>, TestType> fluid({}, domain, cloud);
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto rates = test::rates_by_id(fluid);
  test::Sum momentum;
  test::Sum gas_density;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    momentum.add(cloud.m[i] * rates.v[i][1]);
    if (cloud.set[i] == sphmbs::particles::gas) {
      gas_density.add(rates.rho[i]);
      continue;
    }
    REQUIRE(rates.rho[i] == 0);
    REQUIRE(rates.e[i] == 0);
    REQUIRE(rates.h[i] == 0);
  }
  CHECK(momentum.share() < rounding);  // gas and wall meet the same p* and the same densities
  CHECK(gas_density.size > 0);
}

TEMPLATE_LIST_TEST_CASE("a wall model does not come between two particles of gas", "[sph]",
                        test::Policies) {
  const auto cloud = test::disordered_cloud<2>(14, spacing, 57);
  const auto domain = test::cube<2>(14 * spacing, true);
  const auto evolved = test::rates_of<TestType, double>(test::Gas<2>{}, domain, cloud);
  const auto mirror = test::rates_of<TestType, double>(WalledGas<Mirror>{}, domain, cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    CHECK(test::length(mirror.v[i] - evolved.v[i]) <= rounding * test::length(evolved.v[i]));
    CHECK(std::abs(mirror.e[i] - evolved.e[i]) <= rounding * std::abs(evolved.e[i]));
    CHECK(std::abs(mirror.rho[i] - evolved.rho[i]) <= rounding * std::abs(evolved.rho[i]));
  }
}

TEMPLATE_LIST_TEST_CASE("only the prescribed motion moves virtual particles", "[sph]",
                        test::Policies) {
  const auto cloud = gas_above_walls(58);
  sphmbs::sph::Fluid<test::Gas<2>, TestType> fluid({}, test::cube<2>(2, false), cloud);
  fluid.stage(0, 0);
  fluid.rates(0);
  fluid.commit(1e-5, 1e-5);
  const auto fields = fluid.particles().fields();
  const auto x = test::by_id<TestType>(fields.r[0], fields.id, cloud.size());
  const auto v = test::by_id<TestType>(fields.v[0], fields.id, cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] == sphmbs::particles::gas) {
      CHECK(x[i] != cloud.r[i][0]);
    } else {
      CHECK(x[i] == cloud.r[i][0]);
      CHECK(v[i] == 0);
    }
  }
}
