// SPDX-License-Identifier: MIT
// Slopes of the gas, and pairs that are reconstructed from them.
#include <cmath>
#include <cstddef>

#include <sphmbs/boundary/extrapolated.hpp>
#include <sphmbs/reconstruction/muscl.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

namespace sph = sphmbs::sph;
namespace reconstruction = sphmbs::reconstruction;
using sphmbs::Vec;

constexpr double spacing = 0.1;

template <int Dim, class... Policies>
using Gas = sph::RiemannSph<sphmbs::kernels::QuinticSpline<Dim>, sphmbs::riemann::Acoustic,
                            sphmbs::eos::IdealGas, Policies...>;

/// A field that is linear in space, one for each of density, pressure and components of velocity.
template <int Dim>
struct Linear {
  static Vec<Dim> slope(int field) {
    Vec<Dim> g;
    for (int k = 0; k < Dim; ++k) g[k] = 0.01 * (field + 1) * (k - 0.7);
    return g;
  }
  static void fill(sphmbs::particles::Cloud<Dim>& cloud) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec<Dim>& x = cloud.r[i];
      cloud.rho[i] = 1.2 + dot(slope(0), x);
      cloud.p[i] = 1e5 * (1 + dot(slope(1), x));
      for (int k = 0; k < Dim; ++k) cloud.v[i][k] = dot(slope(2 + k), x);
    }
  }
};

/// Largest error of any slope of any particle, as a share of the slopes.
template <class Scheme, class Policy, class T>
double worst_slope(const sphmbs::particles::Cloud<Scheme::dim>& cloud) {
  constexpr int dim = Scheme::dim;
  const double side = spacing * test::some_hundreds<dim>;
  sph::Fluid<Scheme, Policy, sphmbs::boundary::Fixed, T> fluid({}, test::cube<dim>(side, false),
                                                               cloud);
  fluid.stage(0, 0);
  fluid.rates(0);
  double worst = 0;
  const auto judge = [&](const Vec<dim, T>& found, const Vec<dim>& want) {
    const double error = test::length(found.template to<double>() - want) / test::length(want);
    if (!(error <= worst)) worst = error;
  };
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (fluid.particles().fields().set[i] != sphmbs::particles::gas) continue;
    const auto s = sphmbs::particles::load_vicinity<dim>(fluid.vicinities(), i).slopes;
    judge(s.rho, Linear<dim>::slope(0));
    judge(s.p, 1e5 * Linear<dim>::slope(1));
    for (int k = 0; k < dim; ++k) judge(s.v[k], Linear<dim>::slope(2 + k));
  }
  return worst;
}

template <int Dim>
sphmbs::particles::Cloud<Dim> scattered() {
  auto cloud = test::lattice_cloud<Dim>(test::some_hundreds<Dim>, spacing, test::still_air<Dim>());
  test::disturb(cloud, spacing, 71);
  Linear<Dim>::fill(cloud);
  return cloud;
}

struct Floor {
  static constexpr int dim = 2;
  double distance(Vec<2> x) const { return x[1] - 0.4; }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("slopes of linear fields are exact on scattered particles", "[sph]",
                        test::Policies) {
  // Up to the rim of the cloud, where particles have neighbours on one side only.
  CHECK(worst_slope<Gas<1, reconstruction::Muscl<>>, TestType, double>(scattered<1>()) < 1e-10);
  CHECK(worst_slope<Gas<2, reconstruction::Muscl<>>, TestType, double>(scattered<2>()) < 1e-10);
  CHECK(worst_slope<Gas<3, reconstruction::Muscl<>>, TestType, double>(scattered<3>()) < 1e-10);
  CHECK(worst_slope<Gas<2, reconstruction::Muscl<>>, TestType, float>(scattered<2>()) < 2e-3);
}

TEMPLATE_LIST_TEST_CASE("slopes next to walls without a state come from the gas alone", "[sph]",
                        test::Policies) {
  std::vector<Vec<2>> below, above;
  for (const auto& x : test::cell_centres<2>(test::some_hundreds<2>, spacing))
    (x[1] > 0.4 ? above : below).push_back(x);
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(above, test::still_air<2>(), {.spacing = spacing});
  test::disturb(cloud, spacing, 72);
  Linear<2>::fill(cloud);
  cloud.add_virtual(below, {.rho = 3, .p = 7e4}, {.spacing = spacing}, Floor{});
  using Walled = Gas<2, reconstruction::Muscl<>, sphmbs::boundary::FreeSlip>;
  CHECK(worst_slope<Walled, TestType, double>(cloud) < 1e-10);
}

TEMPLATE_TEST_CASE("reconstructed pairs conserve momentum and energy", "[sph]",
                   reconstruction::VanLeer, reconstruction::Minmod, reconstruction::BarthJespersen,
                   reconstruction::Unlimited) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, spacing, 73);
    const auto domain = test::cube<Dim>(spacing * test::some_hundreds<Dim>, true);
    const auto rates = test::rates_of(
        Gas<Dim, reconstruction::Muscl<TestType>, sph::VolumeForm, sph::Relaxed>{}, domain, cloud);
    test::Sum energy;
    Vec<Dim> force = Vec<Dim>::all(0.0);
    double size = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      energy.add(cloud.m[i] * dot(cloud.v[i], rates.v[i]));
      energy.add(cloud.m[i] * rates.e[i]);
      force += cloud.m[i] * rates.v[i];
      size += cloud.m[i] * test::length(rates.v[i]);
    }
    CHECK(energy.share() < 1e-12);
    CHECK(test::length(force) < 1e-12 * size);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEST_CASE("a reconstruction that is no gas is refused and counted", "[sph]") {
  // Pressure falls from 1e5 Pa to next to nothing: unlimited slopes overshoot below zero.
  auto cloud = test::lattice_cloud<2>(20, spacing, test::still_air<2>());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.r[i][0] > 1) cloud.p[i] = 1;
  const auto domain = test::cube<2>(2, true);
  const auto falls = [&](auto scheme) {
    sph::Fluid<decltype(scheme)> fluid(scheme, domain, cloud);
    fluid.stage(0, 0);
    fluid.rates(0);
    const auto rates = test::rates_by_id(fluid);
    for (const double e : rates.e) REQUIRE(std::isfinite(e));
    CHECK(fluid.statistics().falls == fluid.survey().falls);
    return fluid.survey().falls;
  };
  CHECK(falls(Gas<2, reconstruction::Muscl<reconstruction::Unlimited>>{}) > 0);
  CHECK(falls(Gas<2, reconstruction::Muscl<reconstruction::VanLeer>>{}) == 0);
  CHECK(falls(Gas<2>{}) == 0);
}

TEST_CASE("instead of the energy, a background pressure keeps energy plus pressure times volume",
          "[sph]") {
  const auto cloud = test::disordered_cloud<2>(18, spacing, 74);
  const auto domain = test::cube<2>(18 * spacing, true);
  Gas<2, reconstruction::Muscl<>, sph::VolumeForm> gas;
  gas.background = 9e4;
  const auto rates = test::rates_of(gas, domain, cloud);
  const auto plain =
      test::rates_of(Gas<2, reconstruction::Muscl<>, sph::VolumeForm>{}, domain, cloud);
  test::Sum kept, energy;
  Vec<2> force{};
  double size = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double gain = cloud.m[i] * (dot(cloud.v[i], rates.v[i]) + rates.e[i]);
    const double dV = -cloud.m[i] / (cloud.rho[i] * cloud.rho[i]) * rates.rho[i];
    energy.add(gain);
    kept.add(gain);
    kept.add(9e4 * dV);
    force += cloud.m[i] * rates.v[i];
    size += cloud.m[i] * test::length(rates.v[i]);
    CHECK(rates.e[i] == plain.e[i]);
    CHECK(rates.rho[i] == plain.rho[i]);
  }
  CHECK(kept.share() < 1e-12);
  CHECK(energy.share() > 1e-6);
  CHECK(test::length(force) < 1e-12 * size);
}
