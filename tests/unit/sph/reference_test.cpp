// SPDX-License-Identifier: MIT
#include "support/reference_rates.hpp"

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"

namespace {

// Sums of some hundred terms differ by the order of summation: a few hundred roundings.
constexpr double rounding = 1e-12;
// In single precision separations are differences of numbers 20 times larger, and the slope of the
// kernel multiplies their error by about 5.
constexpr double single_rounding = 2e-5;

/// A disordered gas between two sets of virtual particles, which are disordered too and move.
template <int Dim>
sphmbs::particles::Cloud<Dim> gas_between_walls(double spacing, std::uint64_t seed) {
  const int per_side = test::some_hundreds<Dim>;
  const double side = per_side * spacing;
  std::vector<sphmbs::Vec<Dim>> below, inside, above;
  for (const auto& x : test::cell_centres<Dim>(per_side, spacing))
    (x[0] < 0.2 * side ? below : x[0] > 0.8 * side ? above : inside).push_back(x);
  sphmbs::particles::Cloud<Dim> cloud;
  cloud.add_gas(inside, test::still_air<Dim>(), {.spacing = spacing});
  cloud.add_virtual(below, test::still_air<Dim>(), {.spacing = spacing});
  cloud.add_virtual(above, test::still_air<Dim>(), {.spacing = spacing});
  test::disturb(cloud, spacing, seed);
  return cloud;
}

/// Lets virtual particles keep the velocity of the cloud.
template <int Dim>
struct Keeping {
  sphmbs::Vec<Dim> velocity_of_all;
  template <class T>
  sphmbs::Vec<Dim, T> position(sphmbs::boundary::Mark, const sphmbs::Vec<Dim, T>& r, double,
                               double) const {
    return r;
  }
  template <class T>
  sphmbs::Vec<Dim, T> velocity(sphmbs::boundary::Mark, const sphmbs::Vec<Dim, T>&, double) const {
    return velocity_of_all.template to<T>();
  }
};

template <int Dim>
auto gas_with_gravity() {
  test::Gas<Dim> gas;
  for (int k = 0; k < Dim; ++k) gas.acceleration[k] = 3000.0 * (k + 1);
  return gas;
}

template <int Dim>
test::ReferenceGas reference_with_gravity() {
  test::ReferenceGas gas;
  for (int k = 0; k < Dim; ++k) gas.acceleration.push_back(3000.0 * (k + 1));
  return gas;
}

template <class Policy, class T, int Dim>
double difference_from_reference(bool periodic, std::uint64_t seed) {
  const double spacing = 0.1;
  const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, spacing, seed);
  const auto domain = test::cube<Dim>(test::some_hundreds<Dim> * spacing, periodic);
  const auto expected = test::reference_rates(reference_with_gravity<Dim>(), domain, cloud);
  const auto found = test::rates_of<Policy, T>(gas_with_gravity<Dim>(), domain, cloud);
  return test::largest_difference(found, expected.value, expected);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("rates are those of the printed equations summed over all pairs", "[sph]",
                        test::Policies) {
  const bool periodic = GENERATE(false, true);
  CAPTURE(periodic);
  SECTION("in double precision") {
    CHECK(difference_from_reference<TestType, double, 1>(periodic, 1) < rounding);
    CHECK(difference_from_reference<TestType, double, 2>(periodic, 2) < rounding);
    CHECK(difference_from_reference<TestType, double, 3>(periodic, 3) < rounding);
  }
  SECTION("in single precision") {
    CHECK(difference_from_reference<TestType, float, 1>(periodic, 4) < single_rounding);
    CHECK(difference_from_reference<TestType, float, 2>(periodic, 5) < single_rounding);
    CHECK(difference_from_reference<TestType, float, 3>(periodic, 6) < single_rounding);
  }
}

TEMPLATE_LIST_TEST_CASE("rates of gas and of moving walls are those of the printed equations",
                        "[sph]", test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const double spacing = 0.1;
    const sphmbs::Vec<Dim> wall_velocity = sphmbs::Vec<Dim>::all(7.0);
    auto cloud = gas_between_walls<Dim>(spacing, 7);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.set[i] != sphmbs::particles::gas) cloud.v[i] = wall_velocity;
    const auto domain = test::cube<Dim>(test::some_hundreds<Dim> * spacing, false);
    const auto expected = test::reference_rates(reference_with_gravity<Dim>(), domain, cloud);
    const auto found = test::rates_of<TestType, double>(gas_with_gravity<Dim>(), domain, cloud,
                                                        Keeping<Dim>{wall_velocity});
    CHECK(test::largest_difference(found, expected.value, expected) < rounding);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("the survey counts the pairs inside the support", "[sph]", test::Policies) {
  const bool periodic = GENERATE(false, true);
  const double spacing = 0.1;
  const auto check = [&]<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, spacing, 8);
    const auto domain = test::cube<Dim>(test::some_hundreds<Dim> * spacing, periodic);
    const auto expected = test::reference_rates(test::ReferenceGas{}, domain, cloud);
    const auto found = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    CHECK(found.survey.pairs == expected.pairs);
    CHECK(found.pairs == expected.value.pairs);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEST_CASE("without XSPH every particle moves with its own velocity", "[sph]") {
  const auto cloud = test::disordered_cloud<2>(12, 0.1, 9);
  const auto found =
      test::rates_of(test::Gas<2, sphmbs::sph::NoXsph>{}, test::cube<2>(1.2, true), cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) CHECK(found.r[i] == cloud.v[i]);
}

TEST_CASE("XSPH with zeta 0 is no XSPH, and its drift is proportional to zeta", "[sph]") {
  const auto cloud = test::disordered_cloud<2>(12, 0.1, 10);
  const auto domain = test::cube<2>(1.2, true);
  test::Gas<2> gas;
  gas.smoothing.zeta = 0;
  const auto none = test::rates_of(gas, domain, cloud);
  gas.smoothing.zeta = 0.25;
  const auto some = test::rates_of(gas, domain, cloud);
  gas.smoothing.zeta = 1;
  const auto all = test::rates_of(gas, domain, cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    CHECK(none.r[i] == cloud.v[i]);
    const auto drift = all.r[i] - cloud.v[i];
    CHECK(test::length(some.r[i] - cloud.v[i] - 0.25 * drift) <= 1e-14 * test::length(all.r[i]));
    CHECK(some.v[i] == all.v[i]);
    CHECK(some.e[i] == all.e[i]);
  }
}

TEMPLATE_LIST_TEST_CASE("smoothing lengths follow the density by eq. 23, walls' too", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = gas_between_walls<Dim>(0.1, 11);
    const auto domain = test::cube<Dim>(test::some_hundreds<Dim> * 0.1, false);
    const auto found = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    constexpr double few_roundings = 1e-15;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double expected = -cloud.h[i] / (Dim * cloud.rho[i]) * found.rho[i];
      REQUIRE(std::abs(found.h[i] - expected) <= few_roundings * std::abs(expected));
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}
