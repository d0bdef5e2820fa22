// SPDX-License-Identifier: MIT
// Every execution policy of a build gives what one thread of the host gives, up to the order of
// rounding, and the same bits when it is asked again.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"
#include "support/state.hpp"

namespace {

using namespace sphmbs;

/// What is simulated: particles, where, by which equations.
template <class SchemeType, class MotionType = boundary::Fixed>
struct Setup {
  using Scheme = SchemeType;
  using Motion = MotionType;
  Scheme scheme{};
  geometry::Domain<Scheme::dim> domain;
  particles::Cloud<Scheme::dim> cloud;
  Motion motion{};

  template <class Policy>
  sph::Fluid<Scheme, Policy, Motion> fluid() const {
    return {scheme, domain, cloud, motion};
  }
};

/// A periodic cube of disordered gas.
template <class Scheme>
Setup<Scheme> cube(int per_side) {
  constexpr int dim = Scheme::dim;
  return {{}, test::cube<dim>(per_side * 0.1, true), test::disordered_cloud<dim>(per_side, 0.1, 7)};
}

struct Channel {
  double distance(Vec<2> x) const { return std::min(x[1] - 0.6, 2.4 - x[1]); }
};

/// Gas between walls and around a thin plate, under a body force.
template <class Scheme>
Setup<Scheme> channel() {
  Setup<Scheme> setup;
  setup.domain = test::cube<2>(3, true);
  setup.domain.periodic[1] = false;
  std::vector<Vec<2>> gas, wall, plate;
  for (const auto& x : test::cell_centres<2>(30, 0.1)) {
    const bool on_plate = std::abs(x[1] - 1.55) < 0.01 && x[0] > 0.9 && x[0] < 2.1;
    (x[1] < 0.6 || x[1] > 2.4 ? wall : on_plate ? plate : gas).push_back(x);
  }
  const auto air = test::still_air<2>();
  setup.cloud.add_gas(gas, air, {.spacing = 0.1});
  test::disturb(setup.cloud, 0.1, 5,
                {.place = 0.1, .speed = 10, .density = 0.05, .pressure = 0.05});
  setup.cloud.add_virtual(wall, air, {.spacing = 0.1}, Channel{});
  setup.cloud.add_sheet(plate, std::vector<Vec<2>>(plate.size(), Vec<2>{0, 1}), air,
                        {.spacing = 0.1});
  setup.scheme.acceleration = {100, 0};
  return setup;
}

/// Gas that comes in at one end and goes out at the other.
Setup<sph::SmoothScheme<2>> stream() {
  Setup<sph::SmoothScheme<2>> setup;
  const double dx = 0.1;
  const particles::State<2> far{.rho = 1.2, .p = 1e5, .v = {100, 0}};
  const geometry::Box<2> inside{{0, 0}, {4, 1.2}};
  setup.domain = {{{-1, 0}, {5, 1.2}}, {false, true}};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
  setup.cloud.add_gas(lattice.inner_points(inside, setup.domain), far, {dx});
  const auto open = [&](double from, double to, int side) {
    const geometry::Box<2> zone{{from, 0}, {to, 1.2}};
    setup.cloud.add_opening({.lower = zone.lower,
                             .upper = zone.upper,
                             .axis = 0,
                             .side = side,
                             .far = far,
                             .distance = 4},
                            lattice.inner_points(zone, setup.domain), {dx});
  };
  open(-0.8, 0, 1);
  open(4, 4.8, -1);
  return setup;
}

/// Gas in a cavity whose walls close in.
Setup<test::Gas<2>, boundary::Contraction> cavity() {
  Setup<test::Gas<2>, boundary::Contraction> setup;
  setup.motion = {.length = 2, .speed = 10};
  setup.domain = {{{-3, -3}, {3, 3}}, {false, false}};
  const geometry::Lattice<2> lattice{.spacing = 0.1, .origin = {0.05, 0.05}};
  const geometry::Box<2> inside{{-1, -1}, {1, 1}};
  const particles::State<2> air = test::still_air<2>();
  setup.cloud.add_gas(lattice.inner_points(inside, setup.domain), air, {0.1});
  setup.cloud.add_virtual(lattice.inner_points(inside.grown(0.5) - inside, setup.domain, 0.6), air,
                          {0.1});
  return setup;
}

/// Largest difference of two columns as a share of the largest number of the second one.
template <class Column>
double difference(const Column& a, const Column& b) {
  double most = 0, size = 1e-300;
  for (std::size_t i = 0; i < b.size(); ++i) {
    double apart = 0;
    if constexpr (std::is_same_v<typename Column::value_type, double>) {
      apart = std::abs(a[i] - b[i]);
      size = std::max(size, std::abs(b[i]));
    } else {
      apart = test::length(a[i] - b[i]);
      size = std::max(size, test::length(b[i]));
    }
    REQUIRE(std::isfinite(apart));
    most = std::max(most, apart);
  }
  return most / size;
}

template <class Policy, class Setup>
auto rates(const Setup& setup) {
  auto fluid = setup.template fluid<Policy>();
  fluid.stage(0, 0);
  fluid.rates(0);
  return test::rates_by_id(fluid);
}

template <class Setup>
constexpr double step_of(const Setup&) {
  return 2e-5;  // about a quarter of what stability allows
}

template <class Policy, class Setup>
auto hundred_steps(const Setup& setup) {
  auto fluid = setup.template fluid<Policy>();
  test::take_steps(fluid, time::PredictorCorrector{}, 100, step_of(setup));
  CHECK(fluid.statistics().rebuilds > 1);
  return test::state_of(fluid);
}

template <class Policy, class Setup>
void check(const Setup& setup) {
  const auto expected = rates<execution::Serial>(setup);
  const auto found = rates<Policy>(setup);
  CHECK(difference(found.r, expected.r) <= 1e-12);
  CHECK(difference(found.v, expected.v) <= 1e-12);
  CHECK(difference(found.rho, expected.rho) <= 1e-12);
  CHECK(difference(found.e, expected.e) <= 1e-12);
  CHECK(difference(found.h, expected.h) <= 1e-12);
  CHECK(found.pairs == expected.pairs);
  CHECK(found.survey.courant.id == expected.survey.courant.id);

  const auto end = hundred_steps<execution::Serial>(setup);
  const auto here = hundred_steps<Policy>(setup);
  REQUIRE(here.size() == end.size());
  CHECK(difference(here.r, end.r) <= 1e-9);
  CHECK(difference(here.v, end.v) <= 1e-9);
  CHECK(difference(here.rho, end.rho) <= 1e-9);
  CHECK(difference(here.e, end.e) <= 1e-9);
  CHECK(difference(here.h, end.h) <= 1e-9);
  CHECK(same_bits(hundred_steps<Policy>(setup), here));
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("policies agree: the paper's gas in one, two and three dimensions",
                        "[policies]", test::Policies) {
  check<TestType>(cube<test::Gas<1>>(60));
  check<TestType>(cube<test::Gas<2>>(24));
  check<TestType>(cube<test::Gas<3>>(12));
}

TEMPLATE_LIST_TEST_CASE("policies agree: MUSCL, relaxed density, friction", "[policies]",
                        test::Policies) {
  check<TestType>(cube<sph::SmoothScheme<2, sph::Newtonian>>(24));
  check<TestType>(cube<sph::ShockScheme<3>>(12));
}

TEMPLATE_LIST_TEST_CASE("policies agree: walls, a thin plate, moving walls", "[policies]",
                        test::Policies) {
  check<TestType>(channel<sph::SmoothScheme<2>>());
  check<TestType>(cavity());
}

TEMPLATE_LIST_TEST_CASE("policies agree: gas that comes in and goes out", "[policies]",
                        test::Policies) {
  const auto setup = stream();
  auto fluid = setup.template fluid<TestType>();
  auto serial = setup.template fluid<execution::Serial>();
  test::take_steps(fluid, time::PredictorCorrector{}, 100, 1e-4);
  test::take_steps(serial, time::PredictorCorrector{}, 100, 1e-4);
  CHECK(serial.traffic()[0].in.particles > 0);
  CHECK(fluid.size() == serial.size());
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(fluid.traffic()[k].in.particles == serial.traffic()[k].in.particles);
    CHECK(fluid.traffic()[k].out.particles == serial.traffic()[k].out.particles);
  }
  const auto here = fluid.totals(), there = serial.totals();
  CHECK(here.mass == Approx(there.mass).epsilon(1e-12));
  CHECK(here.energy() == Approx(there.energy()).epsilon(1e-9));
  CHECK(test::length(here.momentum - there.momentum) <= 1e-9 * test::length(there.momentum));
}

TEMPLATE_LIST_TEST_CASE("between outputs a gas step sends a few numbers over the bus", "[policies]",
                        test::Policies) {
  if constexpr (execution::on_host<TestType>) {
    SUCCEED("the host has no bus");
  } else {
    const auto per_step = [](auto setup) {
      auto fluid = setup.template fluid<TestType>();
      test::take_steps(fluid, time::PredictorCorrector{}, 2, step_of(setup));
      const auto before = TestType::bus();
      test::take_steps(fluid, time::PredictorCorrector{}, 50, step_of(setup));
      CHECK(fluid.statistics().rebuilds > 1);
      return static_cast<double>(TestType::bus().bytes() - before.bytes()) / 50;
    };
    CHECK(per_step(cube<test::Gas<2>>(24)) < 1000);
    // However many particles there are.
    CHECK(per_step(cube<test::Gas<2>>(48)) < 1000);
  }
}
