// SPDX-License-Identifier: MIT
// Plane Poiseuille flow: a body force drives gas from rest between two walls.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "support/catch.hpp"
#include "support/rates.hpp"
#include "verification/viscous/channel.hpp"

namespace {

using namespace channel;
using sphmbs::boundary::FreeSlip;
using sphmbs::boundary::NoSlip;

constexpr double speed = 0.1;  // in the middle of the steady flow: Mach number 0.1
constexpr double reynolds = 10;
constexpr double viscosity = speed / reynolds;
constexpr double drive = 8 * viscosity * speed;

/// Velocity / speed, at viscosity times time / height^2.
double poiseuille(double y, double tau) {
  double u = 4 * y * (1 - y);
  for (int n = 1; n < 100; n += 2)
    u -= 32 / std::pow(n * pi, 3) * std::exp(-n * n * pi * pi * tau) * std::sin(n * pi * y);
  return u;
}

template <class Gas>
Gas driven() {
  Gas gas = isothermal<Gas>(viscosity);
  gas.acceleration = {drive, 0};
  return gas;
}

}  // namespace

TEST_CASE("Poiseuille flow starts and settles as the series says", "[viscous]") {
  std::vector<double> early, late, steady;
  for (const int rows : {8, 16, 32}) {
    const Plan plan{rows};
    Fluid<Gas<NoSlip>> fluid(driven<Gas<NoSlip>>(), plan.domain(), plan.cloud());
    const auto error_at = [&](double tau) {
      advance(fluid, tau / viscosity);
      return error(fluid, along, [&](double y) { return speed * poiseuille(y, tau); });
    };
    early.push_back(error_at(0.05));
    late.push_back(error_at(0.2));
    steady.push_back(error_at(1));
    const auto totals = fluid.totals();
    const double weight = drive * totals.mass;
    const double below = fluid.force_on(lower)[0] / weight;
    const double above = fluid.force_on(upper)[0] / weight;
    const Vec<2> missed = totals.momentum - fluid.exchange().impulse();
    std::cout << "Poiseuille, " << rows << " rows: friction of the walls / body force " << below
              << " + " << above << ", momentum missed " << test::length(missed) << '\n';
    CHECK(below + above == Approx(1).epsilon(0.003));
    CHECK(below == Approx(above).epsilon(1e-3));
    CHECK(test::length(missed) < 1e-10 * test::length(totals.momentum));
  }
  const auto early_orders = orders("Poiseuille at 0.05 h^2 / nu, 8 16 32 rows", early);
  const auto late_orders = orders("Poiseuille at 0.2 h^2 / nu, 8 16 32 rows", late);
  const auto steady_orders = orders("Poiseuille, steady, 8 16 32 rows", steady);
  // Found are 0.18, 0.24 and 0.36 %, and orders from 2.3 to 3.5.
  CHECK(early.back() < 0.004);
  CHECK(late.back() < 0.005);
  CHECK(steady.back() < 0.007);
  for (const auto& order : {early_orders, late_orders, steady_orders})
    CHECK(*std::min_element(order.begin(), order.end()) > 2);
}

// Sums over a square lattice at h = 1.25 spacings have 1.2 % less shear than integrals, over rows
// at random places along each other 0.7 %; at h = 1.5 spacings half of it. Without limiter, which
// takes back some of it at the crest of the profile, -0.68 and -0.04 % are found.
TEST_CASE("wider kernels bring the friction between rows nearer to the given viscosity",
          "[viscous][slow]") {
  using Smooth = Gas<NoSlip, sphmbs::riemann::Acoustic, sphmbs::reconstruction::Unlimited>;
  const auto excess = [](double smoothing_ratio) {
    const Plan plan{32, smoothing_ratio};
    Fluid<Smooth> fluid(driven<Smooth>(), plan.domain(), plan.cloud());
    advance(fluid, 1 / viscosity);
    const auto totals = fluid.totals();
    // Compared at the particles: the sum over rows is no exact integral.
    double expected = 0;
    const auto state = test::state_of(fluid);
    for (std::size_t i = 0; i < fluid.gas_count(); ++i)
      expected += state.m[i] * speed * poiseuille(state.r[i][1], 1);
    const double found = expected / totals.momentum[0] - 1;
    std::cout << "Poiseuille, h / spacing " << smoothing_ratio
              << ": viscosity found / given - 1 = " << found << '\n';
    return std::abs(found);
  };
  const double narrow = excess(1.25);
  const double wide = excess(1.5);
  CHECK(narrow < 0.008);
  CHECK(wide < 0.002);
}

TEST_CASE("gas between walls that it slips along falls freely", "[viscous]") {
  const Plan plan{16};
  auto gas = driven<Gas<FreeSlip>>();
  gas.wall.isothermal = false;
  Fluid<Gas<FreeSlip>> fluid(gas, plan.domain(), plan.cloud());
  const double time = 0.2 / viscosity;
  advance(fluid, time);
  const auto state = test::state_of(fluid);
  double off = 0;
  for (std::size_t i = 0; i < fluid.gas_count(); ++i)
    off = std::max(off, test::length(state.v[i] - Vec<2>{drive * time, 0}));
  const double friction = fluid.force_on(lower)[0] + fluid.force_on(upper)[0];
  const double weight = drive * fluid.totals().mass;
  std::cout << "slipping gas: velocity off by " << off / (drive * time) << ", friction / weight "
            << friction / weight << '\n';
  CHECK(off < 1e-8 * drive * time);
  CHECK(std::abs(friction) < 1e-8 * weight);
}
