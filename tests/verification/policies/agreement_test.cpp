// SPDX-License-Identifier: MIT
// Every execution policy of a build gives what one thread of the host gives, up to the order of
// rounding, and the same bits when it is asked again.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"
#include "support/setups.hpp"
#include "support/state.hpp"

namespace {

using namespace sphmbs;

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
  check<TestType>(test::cube_setup<test::Gas<1>>(60));
  check<TestType>(test::cube_setup<test::Gas<2>>(24));
  check<TestType>(test::cube_setup<test::Gas<3>>(12));
}

TEMPLATE_LIST_TEST_CASE("policies agree: MUSCL, relaxed density, friction", "[policies]",
                        test::Policies) {
  check<TestType>(test::cube_setup<sph::SmoothScheme<2, sph::Newtonian>>(24));
  check<TestType>(test::cube_setup<sph::ShockScheme<3>>(12));
}

TEMPLATE_LIST_TEST_CASE("policies agree: walls, a thin plate, moving walls", "[policies]",
                        test::Policies) {
  check<TestType>(test::channel_setup<sph::SmoothScheme<2>>());
  check<TestType>(test::cavity_setup());
}

TEMPLATE_LIST_TEST_CASE("policies agree: gas that comes in and goes out", "[policies]",
                        test::Policies) {
  const auto setup = test::stream_setup();
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
    CHECK(per_step(test::cube_setup<test::Gas<2>>(24)) < 1000);
    // However many particles there are.
    CHECK(per_step(test::cube_setup<test::Gas<2>>(48)) < 1000);
  }
}
