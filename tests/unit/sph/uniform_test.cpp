// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/geometry/lattice.hpp>
#include <sphmbs/kernels/cubic_spline.hpp>
#include <sphmbs/kernels/wendland.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

// Forces of opposite neighbours cancel to a rounding of their separations, which is 1e-16 times the
// side of the box over the spacing.
constexpr double rounding = 1e-12;

constexpr double spacing = 0.1;

template <int Dim>
constexpr int per_side = Dim == 1   ? 21
                         : Dim == 2 ? 11
                                    : 9;

template <int Dim>
sphmbs::particles::State<Dim> moving_air() {
  sphmbs::particles::State<Dim> state{.rho = 1.2, .p = 1e5, .v = {}};
  for (int k = 0; k < Dim; ++k) state.v[k] = 20.0 - 15 * k;
  return state;
}

/// Rates are zero as shares of what a gas with jumps of the size of its state would have.
template <int Dim>
void check_zero(const test::Rates<Dim>& rates, std::size_t i, double h) {
  const auto state = moving_air<Dim>();
  const double c = std::sqrt(1.4 * state.p / state.rho);
  CHECK(test::length(rates.v[i]) < rounding * state.p / (state.rho * h));
  CHECK(std::abs(rates.rho[i]) < rounding * state.rho * c / h);
  CHECK(std::abs(rates.e[i]) < rounding * state.p / state.rho * c / h);
  CHECK(std::abs(rates.h[i]) < rounding * c);
  CHECK(test::length(rates.r[i] - state.v) < rounding * test::length(state.v));
}

template <class Kernel, class Policy>
void check_uniform() {
  constexpr int dim = Kernel::dim;
  using Gas = sphmbs::sph::RiemannSph<Kernel, sphmbs::riemann::Acoustic, sphmbs::eos::IdealGas>;
  const auto cloud = test::lattice_cloud<dim>(per_side<dim>, spacing, moving_air<dim>());
  const double side = per_side<dim> * spacing;
  const auto rates = test::rates_of<Policy, double>(Gas{}, test::cube<dim>(side, true), cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    REQUIRE(rates.pairs[i] > 1);
    check_zero(rates, i, cloud.h[i]);
  }
  const auto free = test::rates_of<Policy, double>(Gas{}, test::cube<dim>(side, false), cloud);
  std::size_t interior = 0;
  std::size_t rim = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (free.pairs[i] == rates.pairs[i]) {
      check_zero(free, i, cloud.h[i]);
      ++interior;
    } else {
      rim += test::length(free.v[i]) > 1e-3 * 1e5 / (1.2 * cloud.h[i]) ? 1 : 0;
    }
  }
  CHECK(interior > 0);
  CHECK(rim > 0);  // particles at the rim do feel that gas is missing
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a uniform gas on a lattice has zero rates with every kernel", "[sph]",
                        test::Policies) {
  using namespace sphmbs::kernels;
  SECTION("on a line") {
    check_uniform<QuinticSpline<1>, TestType>();
    check_uniform<CubicSpline<1>, TestType>();
    check_uniform<WendlandC2<1>, TestType>();
    check_uniform<WendlandC4<1>, TestType>();
    check_uniform<WendlandC6<1>, TestType>();
  }
  SECTION("in the plane") {
    check_uniform<QuinticSpline<2>, TestType>();
    check_uniform<CubicSpline<2>, TestType>();
    check_uniform<WendlandC2<2>, TestType>();
    check_uniform<WendlandC4<2>, TestType>();
    check_uniform<WendlandC6<2>, TestType>();
  }
  SECTION("in space") {
    check_uniform<QuinticSpline<3>, TestType>();
    check_uniform<CubicSpline<3>, TestType>();
    check_uniform<WendlandC2<3>, TestType>();
    check_uniform<WendlandC4<3>, TestType>();
    check_uniform<WendlandC6<3>, TestType>();
  }
}

TEMPLATE_LIST_TEST_CASE("the body force accelerates gas and nothing else", "[sph]",
                        test::Policies) {
  test::Gas<2> gas;
  gas.acceleration = {3, -9.81};
  auto cloud = test::lattice_cloud<2>(11, spacing, test::still_air<2>());
  cloud.set[7] = 1;
  const auto rates =
      test::rates_of<TestType, double>(gas, test::cube<2>(11 * spacing, true), cloud);
  const double force = rounding * 1e5 / (1.2 * cloud.h[0]);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const sphmbs::Vec<2> expected = i == 7 ? sphmbs::Vec<2>{0, 0} : sphmbs::Vec<2>{3, -9.81};
    CHECK(test::length(rates.v[i] - expected) < force);
  }
}

TEMPLATE_LIST_TEST_CASE("the density follows the divergence of a linear velocity field", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    // The sum -sum m/rho W' d d / r over a lattice is the unit tensor times 1 + this much at most:
    // for the quintic spline at h = 1.25 spacings 1.2e-3 on a line, less in the plane and in space.
    constexpr double lattice_error = 1.25e-3;
    const double gradient[3][3] = {{2, 5, -3}, {-4, 1, 7}, {6, -2, 0.5}};
    constexpr int cells = per_side<Dim>;
    auto cloud = test::lattice_cloud<Dim>(cells, spacing, test::still_air<Dim>());
    double divergence = 0;
    for (int k = 0; k < Dim; ++k) divergence += gradient[k][k];
    for (std::size_t i = 0; i < cloud.size(); ++i)
      for (int k = 0; k < Dim; ++k)
        for (int l = 0; l < Dim; ++l) cloud.v[i][k] += gradient[k][l] * cloud.r[i][l];
    const auto domain = test::cube<Dim>(cells * spacing, false);
    const auto rates = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    const std::size_t middle = cloud.size() / 2;
    const double expected = -cloud.rho[middle] * divergence;
    CHECK(std::abs(rates.rho[middle] / expected - 1) < lattice_error);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a gas that turns like a rigid body keeps its density", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    constexpr int cells = per_side<Dim>;
    constexpr double turning = 50;  // [1/s]
    auto cloud = test::lattice_cloud<Dim>(cells, spacing, test::still_air<Dim>());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      cloud.v[i][0] = -turning * cloud.r[i][1];
      cloud.v[i][1] = turning * cloud.r[i][0];
    }
    const auto domain = test::cube<Dim>(cells * spacing, false);
    const auto rates = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    const std::size_t middle = cloud.size() / 2;
    CHECK(std::abs(rates.rho[middle]) < rounding * cloud.rho[middle] * turning);
  };
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a sample of a uniform gas is its state, next to walls and borders too",
                        "[sph]", test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto state = moving_air<Dim>();
    auto cloud = test::lattice_cloud<Dim>(per_side<Dim>, spacing, state);
    std::vector<sphmbs::Vec<Dim>> wall;
    for (auto x : test::cell_centres<Dim>(per_side<Dim>, spacing)) {
      x[0] -= per_side<Dim> * spacing;
      if (x[0] > -3.9 * spacing) wall.push_back(x);
    }
    cloud.add_virtual(wall, {.rho = 3, .p = 7e5, .v = {}}, {.spacing = spacing});
    test::disturb(cloud, spacing, 31,
                  {.speed = 0, .density = 0, .pressure = 0, .smoothing = 0.1, .mass = 0.1});
    auto domain = test::cube<Dim>(per_side<Dim> * spacing, true);
    domain.periodic[0] = false;
    sphmbs::sph::Fluid<test::Gas<Dim>, TestType> fluid({}, domain, cloud);
    fluid.stage(0, 0);
    const double side = per_side<Dim> * spacing;
    for (const double share : {0.0, 0.001, 0.5, 0.77, 1.0}) {
      const auto sample = fluid.sample(sphmbs::Vec<Dim>::all(share * side));
      CHECK(sample.seen > 0);
      CHECK(sample.rho == Approx(state.rho).epsilon(rounding));
      CHECK(sample.p == Approx(state.p).epsilon(rounding));
      CHECK(test::length(sample.v - state.v) < rounding * test::length(state.v));
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEST_CASE("a sample is not a number where there is no gas", "[sph]") {
  auto cloud = test::lattice_cloud<2>(5, spacing, test::still_air<2>());
  cloud.add_virtual({{3.0, 3.0}}, test::still_air<2>(), {.spacing = spacing});
  sphmbs::sph::Fluid<test::Gas<2>> fluid({}, test::cube<2>(4, false), cloud);
  fluid.stage(0, 0);
  for (const sphmbs::Vec<2> place : {sphmbs::Vec<2>{2, 2}, sphmbs::Vec<2>{3, 3}}) {
    const auto sample = fluid.sample(place);
    CHECK(sample.seen == 0);
    CHECK(std::isnan(sample.rho));
    CHECK(std::isnan(sample.p));
    CHECK(std::isnan(sample.v[0]));
    CHECK(std::isnan(sample.v[1]));
  }
}

TEST_CASE("a sample counts the gas whose support covers the point", "[sph]") {
  const auto cloud = test::disordered_cloud<2>(12, spacing, 32);
  const auto domain = test::cube<2>(12 * spacing, true);
  sphmbs::sph::Fluid<test::Gas<2>> fluid({}, domain, cloud);
  fluid.stage(0, 0);
  const sphmbs::Vec<2> x{0.02, 0.61};
  int expected = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double dx = std::remainder(cloud.r[i][0] - x[0], 12 * spacing);
    const double dy = std::remainder(cloud.r[i][1] - x[1], 12 * spacing);
    expected += std::hypot(dx, dy) < 3 * cloud.h[i] ? 1 : 0;
  }
  CHECK(fluid.sample(x).seen == expected);
}

TEST_CASE("totals are sums over the gas", "[sph]") {
  auto cloud = test::disordered_cloud<2>(40, spacing, 33);
  cloud.add_virtual({{-1.0, -1.0}}, {.rho = 2, .p = 4e5, .v = {}}, {.spacing = spacing});
  sphmbs::sph::Fluid<test::Gas<2>> fluid({}, test::cube<2>(40 * spacing, false), cloud);
  const auto totals = fluid.totals();
  test::Sum mass, momentum, kinetic, internal;
  for (std::size_t i = 0; i < fluid.gas_count(); ++i) {
    mass.add(cloud.m[i]);
    momentum.add(cloud.m[i] * cloud.v[i][1]);
    kinetic.add(cloud.m[i] * (cloud.v[i][0] * cloud.v[i][0] + cloud.v[i][1] * cloud.v[i][1]) / 2);
    internal.add(cloud.m[i] * cloud.p[i] / (0.4 * cloud.rho[i]));
  }
  CHECK(fluid.gas_count() == 1600);
  CHECK(fluid.virtual_count() == 1);
  CHECK(std::abs(totals.mass - mass.value) < rounding * mass.size);
  CHECK(std::abs(totals.momentum[1] - momentum.value) < rounding * momentum.size);
  CHECK(std::abs(totals.kinetic - kinetic.value) < rounding * kinetic.size);
  CHECK(std::abs(totals.internal - internal.value) < rounding * internal.size);
  CHECK(totals.virtual_internal == Approx(2 * 0.01 * 4e5 / (0.4 * 2)).epsilon(rounding));
  CHECK(totals.energy() == totals.kinetic + totals.internal);
}
