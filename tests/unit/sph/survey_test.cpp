// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

constexpr double rounding = 1e-12;
constexpr double spacing = 0.1;
constexpr double side = 1.8;

sphmbs::particles::Cloud<2> some_gas() { return test::disordered_cloud<2>(18, spacing, 81); }

}  // namespace

TEMPLATE_LIST_TEST_CASE("the particle that sound crosses first limits the step", "[sph]",
                        test::Policies) {
  auto cloud = some_gas();
  SECTION("a small one") { cloud.h[157] /= 10; }
  SECTION("a hot one") { cloud.p[157] *= 400; }
  const auto rates =
      test::rates_of<TestType, double>(test::Gas<2>{}, test::cube<2>(side, true), cloud);
  const auto limit = sphmbs::sph::step_limit(rates.survey, 0.3);
  CHECK(limit.id == 157);
  CHECK(limit.reason == "sound");
  const double c = std::sqrt(1.4 * cloud.p[157] / cloud.rho[157]);
  const double divergence = std::abs(rates.rho[157] / cloud.rho[157]);
  const double expected = 0.3 * cloud.h[157] / (c + cloud.h[157] * divergence);
  CHECK(limit.dt == Approx(expected).epsilon(rounding));
}

TEMPLATE_LIST_TEST_CASE("every limit is the smallest over all particles", "[sph]", test::Policies) {
  using Viscous = test::Gas<2, sphmbs::sph::Xsph, sphmbs::sph::Newtonian>;
  Viscous gas;
  gas.stress = {.viscosity = 3};
  const auto cloud = some_gas();
  const auto rates = test::rates_of<TestType, double>(gas, test::cube<2>(side, true), cloud);
  double sound = std::numeric_limits<double>::infinity();
  double acceleration = sound;
  double diffusion = sound;
  double h_rate = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double h = cloud.h[i];
    const double c = std::sqrt(1.4 * cloud.p[i] / cloud.rho[i]);
    sound = std::min(sound, h / (c + h * std::abs(rates.rho[i] / cloud.rho[i])));
    acceleration = std::min(acceleration, std::sqrt(h / test::length(rates.v[i])));
    diffusion = std::min(diffusion, h * h * cloud.rho[i] / (2 * 4.0 / 3 * 3));
    h_rate = std::max(h_rate, std::abs(rates.h[i]));
  }
  CHECK(rates.survey.courant.dt == Approx(sound).epsilon(rounding));
  CHECK(rates.survey.acceleration.dt == Approx(acceleration).epsilon(rounding));
  CHECK(rates.survey.diffusion.dt == Approx(diffusion).epsilon(rounding));
  CHECK(rates.survey.h_rate == Approx(h_rate).epsilon(rounding));
}

TEMPLATE_LIST_TEST_CASE("a body force limits the step where it beats sound", "[sph]",
                        test::Policies) {
  test::Gas<2> gas;
  gas.acceleration = {0, -1e12};
  auto cloud = test::lattice_cloud<2>(18, spacing, test::still_air<2>());
  cloud.h[211] *= 0.7;
  const auto rates = test::rates_of<TestType, double>(gas, test::cube<2>(side, true), cloud);
  const auto limit = sphmbs::sph::step_limit(rates.survey, 0.5);
  CHECK(limit.id == 211);
  CHECK(limit.reason == "acceleration");
  CHECK(limit.dt == Approx(0.5 * std::sqrt(cloud.h[211] / 1e12)).epsilon(1e-3));
}

TEMPLATE_LIST_TEST_CASE("viscosity limits the step where it beats sound", "[sph]", test::Policies) {
  test::Gas<2, sphmbs::sph::Xsph, sphmbs::sph::Newtonian> gas;
  gas.stress = {.viscosity = 3e4};
  auto cloud = test::lattice_cloud<2>(18, spacing, test::still_air<2>());
  cloud.rho[99] *= 0.5;
  cloud.p[99] *= 0.5;
  const auto rates = test::rates_of<TestType, double>(gas, test::cube<2>(side, true), cloud);
  const auto limit = sphmbs::sph::step_limit(rates.survey, 0.5);
  CHECK(limit.id == 99);
  CHECK(limit.reason == "diffusion");
  const double viscosity = 4.0 / 3 * 3e4 / cloud.rho[99];
  CHECK(limit.dt == Approx(0.5 * cloud.h[99] * cloud.h[99] / (2 * viscosity)).epsilon(rounding));
}

TEMPLATE_LIST_TEST_CASE("of equal limits the one of the lowest id is told", "[sph]",
                        test::Policies) {
  auto cloud = test::lattice_cloud<2>(50, spacing, test::still_air<2>());
  for (auto& r : cloud.r) r = {20 * r[0], 20 * r[1]};  // nobody sees anybody
  for (const std::size_t small : {2001u, 7u, 1300u}) cloud.h[small] /= 2;
  const auto rates =
      test::rates_of<TestType, double>(test::Gas<2>{}, test::cube<2>(100, false), cloud);
  CHECK(sphmbs::sph::step_limit(rates.survey, 0.25).id == 7);
}

TEMPLATE_LIST_TEST_CASE("no two particles approach each other faster than the survey says", "[sph]",
                        test::Policies) {
  const auto cloud = some_gas();
  const auto rates =
      test::rates_of<TestType, double>(test::Gas<2>{}, test::cube<2>(side, true), cloud);
  double fastest = 0;
  for (std::size_t a = 0; a < cloud.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      fastest = std::max(fastest, test::length(rates.r[a] - rates.r[b]));
  CHECK(rates.survey.approach() >= fastest);
  CHECK(rates.survey.approach() <= 2 * fastest);  // and the bound is not a useless one
}

TEST_CASE("the step is in proportion to the Courant number", "[sph]") {
  const auto rates = test::rates_of(test::Gas<2>{}, test::cube<2>(side, true), some_gas());
  const double whole = sphmbs::sph::step_limit(rates.survey, 1).dt;
  CHECK(sphmbs::sph::step_limit(rates.survey, 0.25).dt == Approx(0.25 * whole).epsilon(rounding));
}
