// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>

#include <sphmbs/core/pack.hpp>
#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/eos/stiffened_gas.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::eos::IdealGas;
using sphmbs::eos::StiffenedGas;

constexpr double rounding = 1e-14;
constexpr double densities[] = {1e-3, 1.2, 50, 1000};
constexpr double pressures[] = {1, 841, 1e5, 3e9};

template <class E>
std::string refusal(const E& eos) {
  return test::refusal([&] { eos.check(); });
}

}  // namespace

TEST_CASE("energy and pressure of an ideal gas are inverse functions, eq. 5", "[eos]") {
  const IdealGas air{.gamma = 1.37};
  for (const double rho : densities)
    for (const double p : pressures) {
      const double e = air.internal_energy(rho, p);
      CHECK(p == Approx(0.37 * rho * e).epsilon(rounding));
      CHECK(air.pressure(rho, e) == Approx(p).epsilon(rounding));
    }
}

TEST_CASE("the squared sound speed of an ideal gas is gamma p / rho and gamma (gamma - 1) e",
          "[eos]") {
  const IdealGas air;
  for (const double rho : densities)
    for (const double p : pressures) {
      const double c = air.sound_speed(rho, p);
      CHECK(c * c == Approx(1.4 * p / rho).epsilon(rounding));
      CHECK(c * c == Approx(1.4 * 0.4 * air.internal_energy(rho, p)).epsilon(rounding));
    }
  CHECK(air.sound_speed(1.0, 841.0) == Approx(34.3132627).epsilon(1e-8));
}

TEST_CASE("the temperature of an ideal gas obeys eq. 6, e = kappa T / (M (gamma - 1))", "[eos]") {
  const IdealGas air;
  for (const double rho : densities)
    for (const double p : pressures) {
      const double T = air.temperature(rho, p);
      CHECK(air.internal_energy(rho, p) == Approx(8.314 * T / (0.02895 * 0.4)).epsilon(rounding));
    }
  CHECK(air.heat_capacity() == Approx(1.4 / 0.4 * 8.314 / 0.02895));
}

TEST_CASE("the squared sound speed is the derivative of the pressure at constant entropy",
          "[eos]") {
  // de = p / rho^2 drho along an isentrope; central differences of relative step 1e-5.
  const auto check = [](const auto& eos, double rho, double p) {
    const double e = eos.internal_energy(rho, p);
    const double d = 1e-5 * rho;
    const double de = p / (rho * rho) * d;
    const double slope = (eos.pressure(rho + d, e + de) - eos.pressure(rho - d, e - de)) / (2 * d);
    const double c = eos.sound_speed(rho, p);
    CHECK(slope == Approx(c * c).epsilon(1e-7));
  };
  check(IdealGas{}, 1.2, 1e5);
  check(IdealGas{.gamma = 5.0 / 3}, 30, 4e6);
  check(StiffenedGas{}, 1000, 1e5);
  check(StiffenedGas{.gamma = 2.1, .stiffness = 1e6}, 700, 3e6);
}

TEST_CASE("a stiffened gas without stiffness is an ideal gas", "[eos]") {
  const IdealGas ideal{.gamma = 1.6};
  const StiffenedGas stiffened{
      .gamma = 1.6, .stiffness = 0, .heat_capacity_v = 8.314 / 0.02895 / (1.6 - 1)};
  for (const double rho : densities)
    for (const double p : pressures) {
      const double e = ideal.internal_energy(rho, p);
      CHECK(stiffened.internal_energy(rho, p) == Approx(e).epsilon(rounding));
      CHECK(stiffened.pressure(rho, e) == Approx(p).epsilon(rounding));
      CHECK(stiffened.sound_speed(rho, p) == Approx(ideal.sound_speed(rho, p)).epsilon(rounding));
      CHECK(stiffened.temperature(rho, p) == Approx(ideal.temperature(rho, p)).epsilon(rounding));
    }
  CHECK(stiffened.heat_capacity() == Approx(ideal.heat_capacity()));
}

TEST_CASE("energy and pressure of a stiffened gas are inverse functions", "[eos]") {
  const StiffenedGas water;
  for (const double rho : densities)
    for (const double p : pressures)
      CHECK(std::abs(water.pressure(rho, water.internal_energy(rho, p)) - p) <
            1e-14 * (p + water.gamma * water.stiffness));
}

TEST_CASE("single precision and packs agree with double precision", "[eos]") {
  const auto check = [](const auto& eos, double rho, double p) {
    using P = sphmbs::Pack<double, 4>;
    const auto in_single = [](double x) { return static_cast<float>(x); };
    const double e = eos.internal_energy(rho, p);
    const double c = eos.sound_speed(rho, p);
    const double T = eos.temperature(rho, p);
    for (int l = 0; l < 4; ++l) {
      CHECK(eos.internal_energy(P(rho), P(p)).v[l] == Approx(e).epsilon(rounding));
      CHECK(eos.pressure(P(rho), P(e)).v[l] == Approx(eos.pressure(rho, e)).epsilon(rounding));
      CHECK(eos.sound_speed(P(rho), P(p)).v[l] == Approx(c).epsilon(rounding));
      CHECK(eos.temperature(P(rho), P(p)).v[l] == Approx(T).epsilon(rounding));
    }
    CHECK(eos.internal_energy(in_single(rho), in_single(p)) == Approx(e).epsilon(1e-6));
    CHECK(eos.sound_speed(in_single(rho), in_single(p)) == Approx(c).epsilon(1e-6));
    CHECK(eos.temperature(in_single(rho), in_single(p)) == Approx(T).epsilon(1e-6));
  };
  check(IdealGas{}, 1.293, 1e4);
  check(StiffenedGas{}, 998, 2e8);
}

TEST_CASE("parameters of an equation of state out of range are refused by name", "[eos]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(IdealGas{}).empty());
  CHECK_THAT(refusal(IdealGas{.gamma = 1}), Contains("gamma = 1"));
  CHECK_THAT(refusal(IdealGas{.gamma = nan}), Contains("gamma = nan"));
  CHECK_THAT(refusal(IdealGas{.molar_mass = 0}), Contains("molar_mass = 0"));
  CHECK_THAT(refusal(IdealGas{.gas_constant = -8}), Contains("gas_constant = -8"));
  CHECK(refusal(StiffenedGas{}).empty());
  CHECK(refusal(StiffenedGas{.stiffness = 0}).empty());
  CHECK_THAT(refusal(StiffenedGas{.gamma = 0.5}), Contains("gamma = 0.5"));
  CHECK_THAT(refusal(StiffenedGas{.stiffness = -1}), Contains("stiffness = -1"));
  CHECK_THAT(refusal(StiffenedGas{.stiffness = nan}), Contains("stiffness = nan"));
  CHECK_THAT(refusal(StiffenedGas{.heat_capacity_v = 0}), Contains("heat_capacity_v = 0"));
}
