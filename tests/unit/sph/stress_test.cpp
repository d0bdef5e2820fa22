// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

using sphmbs::sph::Newtonian;

constexpr double spacing = 0.1;

template <int Dim>
test::Gas<Dim, sphmbs::sph::Xsph, Newtonian> newtonian_gas(const Newtonian& stress) {
  test::Gas<Dim, sphmbs::sph::Xsph, Newtonian> gas;
  gas.stress = stress;
  return gas;
}

/// What viscosity and conduction add to the rates.
template <class Policy, int Dim>
test::Rates<Dim> added(const Newtonian& stress, const sphmbs::geometry::Domain<Dim>& domain,
                       const sphmbs::particles::Cloud<Dim>& cloud) {
  auto rates = test::rates_of<Policy, double>(newtonian_gas<Dim>(stress), domain, cloud);
  const auto inviscid = test::rates_of<Policy, double>(test::Gas<Dim>{}, domain, cloud);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    rates.v[i] = rates.v[i] - inviscid.v[i];
    rates.e[i] -= inviscid.e[i];
    rates.rho[i] -= inviscid.rho[i];
  }
  return rates;
}

/// Lattice of still air with room for the support around its middle particle, which sees so many
/// neighbours that sums over them are nearly integrals.
template <int Dim>
sphmbs::particles::Cloud<Dim> still_lattice() {
  sphmbs::particles::Cloud<Dim> cloud;
  cloud.add_gas(test::cell_centres<Dim>(13, spacing), test::still_air<Dim>(),
                {.spacing = spacing, .smoothing_ratio = 2});
  return cloud;
}
template <int Dim>
sphmbs::geometry::Domain<Dim> free_space() {
  return test::cube<Dim>(3, false);
}

// Second derivatives by the quintic spline at h = 2 spacings on a lattice are this exact: the sums'
// integrand n n r^2 F has no derivatives at the particle itself.
constexpr double lattice_error = 3e-3;

}  // namespace

TEMPLATE_LIST_TEST_CASE("heat flows from hot to cold and none is lost", "[sph]", test::Policies) {
  auto cloud = test::lattice_cloud<3>(2, spacing, test::still_air<3>());
  cloud.rho[3] = 0.6;  // hot, at the same pressure
  const auto rates =
      added<TestType>(Newtonian{.viscosity = 0, .conductivity = 0.7}, free_space<3>(), cloud);
  test::Sum energy;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i == 3)
      CHECK(rates.e[i] < 0);
    else
      CHECK(rates.e[i] > 0);
    energy.add(cloud.m[i] * rates.e[i]);
  }
  CHECK(energy.share() < 1e-12);
}

TEMPLATE_LIST_TEST_CASE("no heat flows where the temperature is uniform", "[sph]", test::Policies) {
  auto cloud = test::disordered_cloud<2>(12, spacing, 61);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.p[i] = 8e4 * cloud.rho[i];
  const auto without = test::rates_of<TestType, double>(newtonian_gas<2>({.viscosity = 0.1}),
                                                        free_space<2>(), cloud);
  const auto with = test::rates_of<TestType, double>(
      newtonian_gas<2>({.viscosity = 0.1, .conductivity = 1e3}), free_space<2>(), cloud);
  // Temperatures are equal to some roundings of 280 K; a difference of 1 K would bring this much.
  const double one_kelvin = 1e3 / (1.2 * cloud.h[0] * cloud.h[0]);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    CHECK(std::abs(with.e[i] - without.e[i]) < 1e-9 * one_kelvin);
}

TEMPLATE_LIST_TEST_CASE("viscous dissipation is never negative", "[sph]", test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, spacing, 62);
    // So viscous that the pressure's heating, from which it is told by a difference, is small.
    for (const double bulk : {0.0, 1000.0, 5000.0 / 3}) {
      const auto rates =
          added<TestType>(Newtonian{.viscosity = 1000, .bulk = bulk}, free_space<Dim>(), cloud);
      for (std::size_t i = 0; i < cloud.size(); ++i) REQUIRE(rates.e[i] > 0);
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a uniform stream has no viscous force", "[sph]", test::Policies) {
  auto cloud = test::disordered_cloud<2>(12, spacing, 63);
  for (auto& v : cloud.v) v = {40, -30};
  const auto rates = added<TestType>(Newtonian{.viscosity = 1}, free_space<2>(), cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    CHECK(rates.v[i] == sphmbs::Vec<2>{0, 0});
    CHECK(rates.e[i] == 0);
    CHECK(rates.rho[i] == 0);
  }
}

TEMPLATE_LIST_TEST_CASE("viscous forces are mu lap v + (zeta + mu/3) grad div v", "[sph]",
                        test::Policies) {
  constexpr double mu = 50;
  constexpr double zeta = 30;
  constexpr double curvature = 6;  // of the velocity profile [1/(m s)]
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    for (int along = 0; along < Dim; ++along) {
      for (int across = 0; across < Dim; ++across) {
        if (Dim == 3 && along == 1) continue;  // the other pairs of axes say it all
        auto cloud = still_lattice<Dim>();
        for (std::size_t i = 0; i < cloud.size(); ++i)
          cloud.v[i][along] = curvature / 2 * cloud.r[i][across] * cloud.r[i][across];
        const auto rates =
            added<TestType>(Newtonian{.viscosity = mu, .bulk = zeta}, free_space<Dim>(), cloud);
        const std::size_t middle = cloud.size() / 2;
        const double factor = along == across ? 4 * mu / 3 + zeta : mu;
        const double expected = factor * curvature / cloud.rho[middle];
        CAPTURE(Dim, along, across);
        for (int k = 0; k < Dim; ++k)
          CHECK(std::abs(rates.v[middle][k] - (k == along ? expected : 0)) <
                lattice_error * (4 * mu / 3 + zeta) * curvature / cloud.rho[middle]);
      }
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("heat conduction is k lap T", "[sph]", test::Policies) {
  constexpr double k = 1e3;
  constexpr double curvature = 20;  // of the temperature profile [K/m^2]
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    auto cloud = still_lattice<Dim>();
    const sphmbs::eos::IdealGas air;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double temperature = 300 + curvature / 2 * cloud.r[i][0] * cloud.r[i][0];
      cloud.p[i] = cloud.rho[i] * air.gas_constant / air.molar_mass * temperature;
    }
    const auto without = test::rates_of<TestType, double>(newtonian_gas<Dim>({.viscosity = 0}),
                                                          free_space<Dim>(), cloud);
    const auto with = test::rates_of<TestType, double>(
        newtonian_gas<Dim>({.viscosity = 0, .conductivity = k}), free_space<Dim>(), cloud);
    const std::size_t middle = cloud.size() / 2;
    CHECK(with.e[middle] - without.e[middle] ==
          Approx(k * curvature / cloud.rho[middle]).epsilon(lattice_error));
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEST_CASE("a pair of virtual particles conducts heat but carries no viscous load", "[sph]") {
  auto cloud = test::disordered_cloud<2>(6, spacing, 64);
  for (auto& set : cloud.set) set = 1;
  const auto rates = test::rates_of(newtonian_gas<2>({.viscosity = 10, .conductivity = 100}),
                                    free_space<2>(), cloud);
  test::Sum heat;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    CHECK(rates.v[i] == sphmbs::Vec<2>{0, 0});
    heat.add(rates.e[i]);
  }
  CHECK(heat.size > 0);
}

TEST_CASE("the diffusivity is the larger one of momentum and heat", "[sph]") {
  const sphmbs::eos::IdealGas gas;
  const Newtonian viscous{.viscosity = 3, .conductivity = 2000, .bulk = 1};
  CHECK(viscous.diffusivity(gas, 2.5) == Approx((4 + 1) / 2.5));
  const Newtonian conducting{.viscosity = 0.3, .conductivity = 2000};
  CHECK(conducting.diffusivity(gas, 2.5) == Approx(2000 / (8.314 / 0.02895 / 0.4) / 2.5));
}

TEST_CASE("coefficients out of range are refused by name", "[sph]") {
  using Catch::Matchers::Contains;
  const auto refusal = [](const Newtonian& stress) {
    return test::refusal([&] { stress.check(); });
  };
  CHECK(refusal({.viscosity = 1, .bulk = 5.0 / 3 - 1e-12}).empty());
  CHECK_THAT(refusal({.viscosity = -0.5}), Contains("viscosity = -0.5"));
  CHECK_THAT(refusal({.viscosity = NAN}), Contains("viscosity = nan"));
  CHECK_THAT(refusal({.viscosity = 1, .conductivity = -2}), Contains("conductivity = -2"));
  CHECK_THAT(refusal({.viscosity = 1, .bulk = 1.75}), Contains("bulk viscosity = 1.75"));
  CHECK_THAT(refusal({.viscosity = 1, .bulk = -0.25}), Contains("bulk viscosity = -0.25"));
}

TEST_CASE("a bad parameter of any policy stops a fluid before it begins", "[sph]") {
  using Catch::Matchers::Contains;
  const auto cloud = test::lattice_cloud<2>(4, spacing, test::still_air<2>());
  const auto begin = [&](const auto& gas) {
    using Scheme = std::decay_t<decltype(gas)>;
    return test::refusal([&] { sphmbs::sph::Fluid<Scheme>(gas, free_space<2>(), cloud); });
  };
  CHECK(begin(test::Gas<2>{}).empty());
  CHECK_THAT(begin(newtonian_gas<2>({.viscosity = -1})), Contains("viscosity = -1"));
  test::Gas<2> gas;
  gas.eos.gamma = 1;
  CHECK_THAT(begin(gas), Contains("gamma = 1"));
  gas.eos.gamma = 1.4;
  gas.smoothing.zeta = 1.5;
  CHECK_THAT(begin(gas), Contains("XSPH zeta = 1.5"));
}

TEST_CASE("an empty cloud, an empty box or a short period is refused", "[sph]") {
  using Catch::Matchers::Contains;
  const auto cloud = test::lattice_cloud<2>(4, spacing, test::still_air<2>());
  const auto begin = [&](const sphmbs::geometry::Domain<2>& domain, const auto& particles) {
    return test::refusal([&] { sphmbs::sph::Fluid<test::Gas<2>>({}, domain, particles); });
  };
  CHECK_THAT(begin(free_space<2>(), sphmbs::particles::Cloud<2>{}), Contains("particles = 0"));
  CHECK_THAT(begin(test::cube<2>(0, false), cloud), Contains("domain length = 0"));
  CHECK_THAT(begin(test::cube<2>(0.7, true), cloud), Contains("periodic length = 0.7"));
  CHECK(begin(test::cube<2>(0.75, true), cloud).empty());
}
