// SPDX-License-Identifier: MIT
// Plane Couette flow: gas at rest between two walls, of which the upper one begins to slide.
#include <cmath>
#include <iostream>
#include <vector>

#include "support/catch.hpp"
#include "verification/viscous/channel.hpp"

namespace {

using namespace channel;
using sphmbs::boundary::NoSlip;

constexpr double speed = 0.1;  // of the wall: Mach number 0.1
constexpr double reynolds = 10;
constexpr double viscosity = speed / reynolds;

/// Velocity / speed of the wall, at viscosity times time / height^2.
double couette(double y, double tau) {
  double u = y;
  for (int n = 1; n < 100; ++n)
    u += 2 * (n % 2 == 1 ? -1 : 1) / (n * pi) * std::exp(-n * n * pi * pi * tau) *
         std::sin(n * pi * y);
  return u;
}

}  // namespace

TEST_CASE("Couette flow starts and settles as the series says", "[viscous]") {
  std::vector<double> early, late, steady;
  for (const int rows : {8, 16, 32}) {
    const Plan plan{rows};
    Fluid<Gas<NoSlip>> fluid(isothermal<Gas<NoSlip>>(viscosity), plan.domain(), plan.cloud(),
                             Sliding{speed});
    const auto error_at = [&](double tau) {
      advance(fluid, tau / viscosity);
      return error(fluid, along, [&](double y) { return speed * couette(y, tau); });
    };
    early.push_back(error_at(0.05));
    late.push_back(error_at(0.2));
    steady.push_back(error_at(1));
    const double friction = viscosity * speed * plan.length();
    const double below = fluid.force_on(lower)[0] / friction;
    const double above = fluid.force_on(upper)[0] / friction;
    std::cout << "Couette, " << rows << " rows: friction of the walls / theory " << below << ' '
              << above << '\n';
    if (rows < 32) continue;
    CHECK(below == Approx(1).epsilon(0.01));
    CHECK(above == Approx(-1).epsilon(0.01));
  }
  const auto early_orders = orders("Couette at 0.05 h^2 / nu, 8 16 32 rows", early);
  const auto late_orders = orders("Couette at 0.2 h^2 / nu, 8 16 32 rows", late);
  orders("Couette, steady, 8 16 32 rows", steady);
  // Found are 0.08, 0.12 and 0.015 %, and orders from 1.8 to 4.3; what is left is the friction of
  // rows on a lattice, 0.5 % too small, which the steady profile does not feel.
  CHECK(early.back() < 0.003);
  CHECK(late.back() < 0.003);
  CHECK(steady.back() < 0.0005);
  for (const double order : early_orders) CHECK(order > 1.5);
  for (const double order : late_orders) CHECK(order > 1.5);
}

TEST_CASE("what a sliding wall spends on friction is energy of the gas", "[viscous]") {
  const Plan plan{16};
  const auto balance = [&](double cfl) {
    auto gas = isothermal<Gas<NoSlip>>(viscosity);
    gas.wall.isothermal = false;
    auto cloud = plan.cloud();
    shear(cloud, speed);
    Fluid<Gas<NoSlip>> fluid(gas, plan.domain(), cloud, Sliding{speed});
    const double before = energy(fluid);
    const double time = 0.2 / viscosity;
    advance(fluid, time, cfl);
    const double gained = energy(fluid) - before;
    const double work = fluid.exchange().driving_work();
    const double theory = viscosity * speed * speed * plan.length() * time;
    const double lost = gained / work - 1;
    std::cout << "Couette: heat of friction / theory " << gained / theory << ", gained / work - 1 "
              << lost << " at cfl " << cfl << '\n';
    CHECK(gained == Approx(theory).epsilon(0.02));
    return std::abs(lost);
  };
  const double coarse = balance(0.4);
  const double fine = balance(0.2);
  // Found are 8e-10 and 1e-10.
  CHECK(coarse < 1e-8);
  CHECK(fine < coarse / 3);
}
