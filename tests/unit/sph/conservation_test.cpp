// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

// Each pair cancels to a rounding; some thousand pairs leave some thousand roundings at most.
constexpr double rounding = 1e-12;

template <int Dim>
using Cloud = sphmbs::particles::Cloud<Dim>;

template <int Dim>
void check_momentum(const Cloud<Dim>& cloud, const test::Rates<Dim>& rates) {
  for (int k = 0; k < Dim; ++k) {
    test::Sum momentum;
    for (std::size_t i = 0; i < cloud.size(); ++i) momentum.add(cloud.m[i] * rates.v[i][k]);
    REQUIRE(momentum.size > 0);
    CHECK(momentum.share() < rounding);
  }
}

template <int Dim>
void check_angular_momentum(const Cloud<Dim>& cloud, const test::Rates<Dim>& rates) {
  for (int k = Dim == 2 ? 2 : 0; k < 3 && Dim > 1; ++k) {
    const int x = (k + 1) % 3;
    const int y = (k + 2) % 3;
    test::Sum moment;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      moment.add(cloud.m[i] * cloud.r[i][x] * rates.v[i][y]);
      moment.add(-cloud.m[i] * cloud.r[i][y] * rates.v[i][x]);
    }
    REQUIRE(moment.size > 0);
    CHECK(moment.share() < rounding);
  }
}

template <int Dim>
void check_energy(const Cloud<Dim>& cloud, const test::Rates<Dim>& rates) {
  test::Sum energy;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    energy.add(cloud.m[i] * dot(cloud.v[i], rates.v[i]));
    energy.add(cloud.m[i] * rates.e[i]);
  }
  REQUIRE(energy.size > 0);
  CHECK(energy.share() < rounding);
}

template <int Dim>
using Viscous = test::Gas<Dim, sphmbs::sph::Xsph, sphmbs::sph::Newtonian>;

/// Viscosity and conduction whose terms are as large as those of the pressure.
template <int Dim>
Viscous<Dim> viscous_gas() {
  Viscous<Dim> gas;
  gas.stress = {.viscosity = 20, .conductivity = 1e4, .bulk = 15};
  return gas;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE(
    "a free patch of disordered gas keeps its momentum, angular momentum and energy", "[sph]",
    test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, 0.1, 21);
    const auto domain = test::cube<Dim>(0.1 * test::some_hundreds<Dim>, false);
    const auto rates = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    check_momentum(cloud, rates);
    check_angular_momentum(cloud, rates);
    check_energy(cloud, rates);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a periodic disordered gas keeps its momentum and energy", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, 0.1, 22);
    const auto domain = test::cube<Dim>(0.1 * test::some_hundreds<Dim>, true);
    const auto rates = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    check_momentum(cloud, rates);
    check_energy(cloud, rates);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("viscous and conducting gas keeps its momentum and energy", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, 0.1, 23);
    const auto domain = test::cube<Dim>(0.1 * test::some_hundreds<Dim>, Dim == 2);
    const auto rates = test::rates_of<TestType, double>(viscous_gas<Dim>(), domain, cloud);
    const auto inviscid = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    check_momentum(cloud, rates);
    check_energy(cloud, rates);
    // The new terms are large enough for the sums above to notice them.
    CHECK(test::length(rates.v[5] - inviscid.v[5]) > 1e-3 * test::length(inviscid.v[5]));
    CHECK(std::abs(rates.e[5] - inviscid.e[5]) > 1e-3 * std::abs(inviscid.e[5]));
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("two particles at one point stay finite and keep momentum and energy",
                        "[sph][fault]", test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, 0.1, 24);
    const std::size_t twin = cloud.size() / 2;
    cloud.r[twin] = cloud.r[twin + 1];
    const auto domain = test::cube<Dim>(0.1 * test::some_hundreds<Dim>, false);
    const auto rates = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      REQUIRE(std::isfinite(test::length(rates.v[i])));
      REQUIRE(std::isfinite(test::length(rates.r[i])));
      REQUIRE(std::isfinite(rates.rho[i]));
      REQUIRE(std::isfinite(rates.e[i]));
    }
    check_momentum(cloud, rates);
    check_energy(cloud, rates);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEST_CASE("two particles at one point do not push each other", "[sph]") {
  auto cloud = test::disordered_cloud<2>(12, 0.1, 25);
  cloud.r = {{0.5, 0.5}, {0.5, 0.5}};
  for (auto* field : {&cloud.rho, &cloud.p, &cloud.h, &cloud.m}) field->resize(2);
  cloud.v = {{10, 0}, {-10, 4}};
  cloud.set.resize(2);
  const auto rates = test::rates_of(test::Gas<2>{}, test::cube<2>(1, false), cloud);
  CHECK(rates.pairs == std::vector<double>{1, 1});
  for (std::size_t i = 0; i < 2; ++i) CHECK(rates.v[i] == sphmbs::Vec<2>{0, 0});
}

TEST_CASE("a particle that sees nobody has no rates but its velocity", "[sph]") {
  auto cloud = test::lattice_cloud<3>(1, 0.1, {.rho = 1.2, .p = 1e5, .v = {3, 4, 5}});
  const auto rates = test::rates_of(test::Gas<3>{}, test::cube<3>(10, false), cloud);
  CHECK(rates.r[0] == sphmbs::Vec<3>{3, 4, 5});
  CHECK(rates.v[0] == sphmbs::Vec<3>{0, 0, 0});
  CHECK(rates.rho[0] == 0);
  CHECK(rates.e[0] == 0);
  CHECK(rates.h[0] == 0);
  CHECK(rates.survey.pairs == 0);
}
