// SPDX-License-Identifier: MIT
// What a gas does when its numbers go wrong.
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <sphmbs/run.hpp>
#include <sphmbs/sph/balance.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/policies.hpp"
#include "support/random.hpp"
#include "support/rates.hpp"
#include "support/state.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::BeyondModel;
using sphmbs::NumericalFailure;
using sphmbs::geometry::Escape;
using sphmbs::time::PredictorCorrector;

constexpr double spacing = 0.1;
constexpr double side = 1.8;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using Policy = sphmbs::execution::OpenMP;
using Fluid = sphmbs::sph::Fluid<test::Gas<2>, Policy>;

Fluid some_fluid(Escape escape = Escape::allow, bool periodic = true) {
  auto domain = test::cube<2>(side, periodic);
  domain.escape = escape;
  return Fluid({}, domain, test::disordered_cloud<2>(18, spacing, 71));
}

/// One step, at whose middle `meddle` may change what the fluid holds.
template <class Meddle>
void step(Fluid& fluid, const Meddle& meddle) {
  fluid.stage(0, 0);
  fluid.rates(0);
  const double dt = sphmbs::sph::step_limit(fluid.survey(), 0.25).dt;
  fluid.stage(dt / 2, dt / 2);
  fluid.rates(0);
  meddle();
  fluid.commit(dt, dt);
}
void step(Fluid& fluid) {
  step(fluid, [] {});
}

std::size_t place_of(Fluid& fluid, std::uint32_t id) {
  const auto ids = fluid.particles().fields().id;
  std::size_t i = 0;
  while (ids[i] != id) ++i;
  return i;
}

struct Said {
  std::string text;
  std::string_view id;
  std::vector<std::uint32_t> particles;
};

template <class Action>
Said what_fails(Action&& action) {
  try {
    action();
  } catch (const NumericalFailure& e) {
    return {e.what(), e.id, e.particles};
  }
  return {};
}

/// What is said of a value put into a field of a particle after two steps.
Said injected(const std::string& field, std::uint32_t id, double value) {
  Fluid fluid = some_fluid();
  step(fluid);
  step(fluid);
  if (field == "acceleration")
    return what_fails([&] {
      // Lists that are made within the step put the particles into another order.
      step(fluid, [&] { fluid.particles().rates().v[1][place_of(fluid, id)] = value; });
    });
  const auto y = fluid.particles().fields();
  const std::size_t i = place_of(fluid, id);
  double* to = field == "position"   ? y.r[1]
               : field == "velocity" ? y.v[0]
               : field == "density"  ? y.rho
               : field == "energy"   ? y.e
                                     : y.h;
  to[i] = value;
  return what_fails([&] { step(fluid); });
}

const std::vector<std::string> fields{"position", "velocity",         "density",
                                      "energy",   "smoothing length", "acceleration"};

}  // namespace

TEST_CASE("a NaN anywhere is found within a step, with particle and field", "[sph][fault]") {
  test::Random random(13);
  for (int trial = 0; trial < 200; ++trial) {
    const auto id = static_cast<std::uint32_t>(random.between(0, 323.99));
    const std::string& field = fields[static_cast<std::size_t>(trial) % fields.size()];
    CAPTURE(trial, id, field);
    Said first;
    for (const int threads : {1, 2, 4}) {
      if (threads > 1 && trial % 10 != 0) continue;
      const test::Threads some(threads);
      const Said said = injected(field, id, not_a_number);
      if (threads == 1) first = said;
      REQUIRE(said.text == first.text);
    }
    REQUIRE_THAT(first.text, Contains("gas particle #" + std::to_string(id) + " "));
    // A rate shows where it is used.
    REQUIRE_THAT(first.text,
                 Contains((field == "acceleration" ? "velocity" : field) + " not finite"));
    REQUIRE(first.id == "E301");
    REQUIRE(first.particles == std::vector<std::uint32_t>{id});
  }
}

namespace {

/// What is said of a NaN that the others see in a particle while its own state is sound.
std::string seen_by_others(int field, std::uint32_t id) {
  Fluid fluid = some_fluid();
  step(fluid);
  fluid.stage(0, 0);
  const std::size_t i = place_of(fluid, id);
  auto record = sphmbs::particles::load_record<2>(fluid.particles().records(), i);
  double* const numbers[] = {&record.r[0], &record.v[1], &record.rho, &record.p,
                             &record.c,    &record.h,    &record.m};
  *numbers[field] = not_a_number;
  sphmbs::particles::store_record<2>(fluid.particles().records(), i, record);
  return what_fails([&] { fluid.rates(0); }).text;
}

}  // namespace

TEST_CASE("a NaN that only neighbours see is told of the particle that has it", "[sph][fault]") {
  test::Random random(14);
  for (int trial = 0; trial < 210; ++trial) {
    const auto id = static_cast<std::uint32_t>(random.between(0, 323.99));
    CAPTURE(trial, id);
    std::string first;
    for (const int threads : {1, 2, 4}) {
      if (threads > 1 && trial % 5 != 0) continue;
      const test::Threads some(threads);
      const std::string text = seen_by_others(trial % 7, id);
      if (threads == 1) first = text;
      REQUIRE(text == first);
    }
    REQUIRE_THAT(first, Contains("gas particle #" + std::to_string(id) + " "));
    if (trial % 7 == 6) REQUIRE_THAT(first, Contains("mass not finite"));
  }
}

TEST_CASE("an infinite number is found as a NaN is", "[sph][fault]") {
  for (const std::string& field : fields) {
    CAPTURE(field);
    const Said said = injected(field, 97, infinity);
    CHECK(said.particles == std::vector<std::uint32_t>{97});
    CHECK_THAT(said.text, Contains("not finite"));
  }
}

TEST_CASE("rates that are not finite are found before they are used", "[sph][fault]") {
  // The square of 1e200 is not a number that double holds.
  Fluid fluid = some_fluid();
  fluid.particles().fields().v[0][7] = 1e200;
  const Said said = what_fails([&] { step(fluid); });
  CHECK((said.id == "E305" || said.id == "E307"));
  CHECK_FALSE(said.particles.empty());
}

TEST_CASE("each way to be unphysical has its name", "[sph][fault]") {
  CHECK(injected("density", 5, -1).id == "E302");
  CHECK(injected("density", 5, 0).id == "E302");
  CHECK(injected("energy", 5, -1e4).id == "E303");
  CHECK(injected("energy", 5, 0).id == "E303");
  CHECK(injected("smoothing length", 5, -0.1).id == "E304");
}

TEST_CASE("what is not physical is found before any neighbour sees it", "[sph][fault]") {
  const int field = GENERATE(0, 1, 2);
  Fluid fluid = some_fluid();
  const auto y = fluid.particles().fields();
  double* const fields_of_5[] = {&y.rho[5], &y.e[5], &y.h[5]};
  *fields_of_5[field] *= -1;
  const Said said = what_fails([&] { fluid.stage(0, 0); });
  CHECK(said.id == std::array{"E302", "E303", "E304"}[static_cast<std::size_t>(field)]);
}

TEST_CASE("a stage so far ahead that particles could pass unseen is refused", "[sph][fault]") {
  Fluid fluid = some_fluid();
  fluid.stage(0, 0);
  fluid.rates(0);
  CHECK(what_fails([&] { fluid.stage(0, 1); }).id == "E307");
}

TEST_CASE("an update that would not be physical is not made", "[sph][fault]") {
  Fluid fluid = some_fluid();
  step(fluid);
  const auto before = test::state_of(fluid);
  const double t = fluid.time();
  const auto impulse = fluid.exchange().impulse();
  std::string_view expected;
  const auto spoil = [&](int kind) {
    const auto rates = fluid.particles().rates();
    const std::size_t i = place_of(fluid, 200);
    if (kind == 0) rates.rho[i] = -1e9;
    if (kind == 1) rates.e[i] = -1e15;
    if (kind == 2) rates.h[i] = -1e9;
    if (kind == 3) rates.e[i] = not_a_number;
    if (kind == 4) rates.r[1][i] = infinity;
    expected = kind == 0 ? "E302" : kind == 1 ? "E303" : kind == 2 ? "E304" : "E301";
  };
  for (int kind = 0; kind < 5; ++kind) {
    CAPTURE(kind);
    const Said said = what_fails([&] { step(fluid, [&] { spoil(kind); }); });
    CHECK(said.id == expected);
    CHECK(said.particles == std::vector<std::uint32_t>{200});
    CHECK(fluid.time() == t);
    CHECK(same_bits(test::state_of(fluid), before));
    fluid.undo();
    CHECK(test::same_bits(fluid.exchange().impulse(), impulse));
  }
  CHECK(fluid.statistics().retries == 5);
  CHECK(fluid.statistics().steps == 1);
}

TEST_CASE("density and smoothing length do not collapse within one step", "[sph][fault]") {
  const bool of_h = GENERATE(false, true);
  Fluid fluid = some_fluid();
  fluid.stage(0, 0);
  fluid.rates(0);
  const double dt = sphmbs::sph::step_limit(fluid.survey(), 0.25).dt;
  const auto y = fluid.particles().fields();
  const auto rates = fluid.particles().rates();
  (of_h ? rates.h : rates.rho)[5] = -0.99 * (of_h ? y.h : y.rho)[5] / dt;
  const Said said = what_fails([&] { fluid.commit(dt, dt); });
  CHECK(said.id == "E302");
  CHECK_THAT(said.text, Contains("collapses within one step"));
}

TEST_CASE("of several particles that are sick the one with the lowest id is named",
          "[sph][fault]") {
  for (const int threads : {1, 4}) {
    const test::Threads some(threads);
    Fluid fluid = some_fluid();
    for (const std::uint32_t id : {300u, 10u, 200u})
      fluid.particles().fields().rho[place_of(fluid, id)] = not_a_number;
    CHECK(what_fails([&] { step(fluid); }).particles == std::vector<std::uint32_t>{10});
  }
}

TEST_CASE("a step goes on after one that was undone as if that had not been", "[sph][fault]") {
  Fluid straight = some_fluid(), disturbed = some_fluid();
  for (int k = 0; k < 10; ++k) {
    step(straight);
    for (int again = 0; again < k % 3; ++again) {
      CHECK_THROWS_AS(
          step(disturbed, [&] { disturbed.particles().rates().v[0][17] = not_a_number; }),
          NumericalFailure);
      disturbed.undo();
    }
    if (k % 4 == 2) {  // a long one, with lists of its own
      disturbed.stage(0, 0);
      disturbed.rates(0);
      disturbed.stage(0, 8 * sphmbs::sph::step_limit(disturbed.survey(), 0.25).dt);
      disturbed.undo();
    }
    step(disturbed);
    CHECK(disturbed.survey().pairs == straight.survey().pairs);
  }
  const auto a = test::state_of(straight), b = test::state_of(disturbed);
  double off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a.rho[i] - b.rho[i]));
  CHECK(off < 1e-12);
  CHECK(std::isfinite(disturbed.exchange().impulse()[0]));
  CHECK(disturbed.time() == Approx(straight.time()).epsilon(1e-12));
}

TEST_CASE("a speed limit is kept", "[sph][fault]") {
  Fluid fluid = some_fluid();
  fluid.admission().fastest = 1;
  const Said said = what_fails([&] { step(fluid); });
  CHECK(said.id == "E306");
}

TEST_CASE("numbers next to zero do no harm", "[sph][fault]") {
  const auto run = [](double speed, int threads) {
    const test::Threads some(threads);
    auto cloud = test::lattice_cloud<2>(18, spacing, test::still_air<2>());
    for (auto& v : cloud.v) v = {speed, -speed};
    Fluid fluid({}, test::cube<2>(side, true), cloud);
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < 20; ++k) step(fluid);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    return std::pair{test::state_of(fluid), took.count()};
  };
  const auto plain = run(1, 1), tiny = run(1e-310, 1), zero = run(-0.0, 1);
  CHECK(same_bits(tiny.first, run(1e-310, 3).first));
  CHECK(zero.first.rho == run(0.0, 1).first.rho);
  CHECK(tiny.second < 3 * plain.second + 0.2);
}

TEST_CASE("gas that flies apart at Mach 50 stays physical or ends the run", "[sph][fault]") {
  for (const double mach : {1.0, 5.0, 50.0}) {
    CAPTURE(mach);
    auto cloud = test::lattice_cloud<2>(18, spacing, test::still_air<2>());
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.v[i] = {cloud.r[i][0] < side / 2 ? -340 * mach : 340 * mach, 0};
    Fluid fluid({}, test::cube<2>(side, false), cloud);
    const Said said = what_fails([&] {
      sphmbs::run(fluid, PredictorCorrector{}, {.until = 5e-4 / mach, .cfl = 0.4},
                  sphmbs::no_report);
    });
    const auto state = test::state_of(fluid);
    for (std::size_t i = 0; i < state.size(); ++i) {
      REQUIRE(state.rho[i] > 0);
      REQUIRE(state.e[i] > 0);
      REQUIRE(std::isfinite(state.v[i][0]));
    }
    if (!said.text.empty()) CHECK(fluid.statistics().retries == 8);
  }
}

TEST_CASE("steps that are too long are divided, and energy stays", "[sph][fault]") {
  Fluid fluid = some_fluid();
  fluid.stage(0, 0);
  fluid.rates(0);
  const double stable = sphmbs::sph::step_limit(fluid.survey(), 0.4).dt;
  const sphmbs::sph::Balance balance(fluid);
  const double factor = GENERATE(10.0, 100.0, 1e6);
  const Said said = what_fails([&] {
    sphmbs::run(fluid, PredictorCorrector{},
                {.until = 2 * factor * stable, .step = factor * stable}, sphmbs::no_report);
  });
  CAPTURE(factor, said.text);
  if (factor > 1e3) {
    CHECK(said.id == "E310");
    CHECK(fluid.statistics().steps == 0);
  } else {
    CHECK(said.text.empty());
    CHECK(static_cast<double>(fluid.statistics().steps) >= 0.5 * factor);
    CHECK(std::abs(balance.drift().energy) < 0.01);
  }
}

TEST_CASE("ten particles at one point go on, ten thousand are refused by name", "[sph][fault]") {
  auto cloud = test::lattice_cloud<2>(18, spacing, test::still_air<2>());
  for (std::size_t i = 100; i < 110; ++i) cloud.r[i] = cloud.r[100];
  Fluid fluid({}, test::cube<2>(side, true), cloud);
  for (int k = 0; k < 5; ++k) step(fluid);
  for (const double rho : test::state_of(fluid).rho) CHECK(std::isfinite(rho));

  sphmbs::particles::Cloud<2> crowd;
  crowd.add_gas(std::vector<sphmbs::Vec<2>>(10000, {0.9, 0.9}), test::still_air<2>(),
                {.spacing = spacing});
  Fluid crowded({}, test::cube<2>(side, true), crowd);
  const Said said = what_fails([&] { step(crowded); });
  CHECK(said.id == "E311");
  CHECK_THAT(said.text, Contains("particle #0 has ") && Contains("8192"));
}

TEST_CASE("two particles at one point push each other with finite, opposite forces",
          "[sph][fault]") {
  auto cloud = test::disordered_cloud<2>(18, spacing, 71);
  const std::uint32_t one = 100, other = 101;
  cloud.r[other] = cloud.r[one];
  const bool alike = GENERATE(false, true);
  if (alike) {
    for (auto* field : {&cloud.rho, &cloud.p, &cloud.h, &cloud.m}) (*field)[other] = (*field)[one];
    cloud.v[other] = cloud.v[one];
  }
  Fluid fluid({}, test::cube<2>(side, true), cloud);
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto rates = test::rates_by_id(fluid);
  sphmbs::Vec<2> sum{};
  double size = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    for (const double x : {rates.v[i][0], rates.v[i][1], rates.rho[i], rates.e[i], rates.h[i]})
      REQUIRE(std::isfinite(x));
    sum += cloud.m[i] * rates.v[i];
    size += cloud.m[i] * std::sqrt(norm2(rates.v[i]));
  }
  CHECK(std::sqrt(norm2(sum)) < 1e-12 * size);
  // What is the same in all its numbers feels the same: nothing between the two prefers one.
  if (alike) {
    CHECK(rates.v[one][0] == Approx(rates.v[other][0]).epsilon(1e-12));
    CHECK(rates.v[one][1] == Approx(rates.v[other][1]).epsilon(1e-12));
    CHECK(rates.e[one] == Approx(rates.e[other]).epsilon(1e-12));
  }
  for (int k = 0; k < 5; ++k) step(fluid);
}

TEST_CASE("a single particle and none are no surprise", "[sph][fault]") {
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas({{0.9, 0.9}}, test::still_air<2>(), {.spacing = spacing});
  Fluid one({}, test::cube<2>(side, true), cloud);
  for (int k = 0; k < 5; ++k) step(one);
  CHECK(one.time() > 0);
  CHECK_THAT(test::refusal([] { Fluid({}, test::cube<2>(side, true), {}); }),
             Contains("particles = 0"));
}

TEST_CASE("gas that leaves the domain goes on, ends the run or is counted", "[sph][fault]") {
  const auto shoot = [](Fluid& fluid, int count, double speed) {
    const auto v = fluid.particles().fields().v[0];
    for (int k = 0; k < count; ++k) v[place_of(fluid, 306 + static_cast<std::uint32_t>(k))] = speed;
  };
  const auto go = [](Fluid& fluid) {
    sphmbs::run(fluid, PredictorCorrector{}, {.until = 2e-6, .cfl = 0.4}, sphmbs::no_report);
  };
  SECTION("goes on") {
    Fluid fluid = some_fluid(Escape::allow, false);
    shoot(fluid, 3, 1e6);
    go(fluid);
    CHECK(fluid.gas_count() == 324);
    CHECK(fluid.escaped().particles == 0);
  }
  SECTION("is removed and counted") {
    Fluid fluid = some_fluid(Escape::remove, false);
    shoot(fluid, 3, 1e6);
    sphmbs::sph::Balance balance(fluid, {.stop = {1e-12, 1e-6, 1}});
    go(fluid);
    CHECK(fluid.escaped().particles >= 3);
    CHECK(fluid.gas_count() + fluid.escaped().particles == 324);
    CHECK(fluid.gas_accounted() == fluid.gas_count());
    CHECK(fluid.totals().particles == fluid.gas_count());
    CHECK(fluid.escaped().energy > 0.4 * 3 * 1.2 * spacing * spacing * 1e12 * 0.5);
    balance.check();
    CHECK(std::abs(balance.drift().mass) < 1e-12);
    CHECK(std::abs(balance.drift().momentum) < 1e-9);
  }
  SECTION("ends the run") {
    Fluid fluid = some_fluid(Escape::error, false);
    shoot(fluid, 1, 1e6);
    const Said said = what_fails([&] { go(fluid); });
    CHECK(said.id == "E309");
    CHECK(said.particles.size() == 1);
    CHECK(fluid.statistics().retries == 0);
  }
}

TEST_CASE("a particle out of this world ends the run and its cell exists", "[sph][fault]") {
  const bool periodic = GENERATE(false, true);
  Fluid fluid = some_fluid(Escape::allow, periodic);
  const auto x = fluid.particles().fields().r[1];
  x[place_of(fluid, 11)] = 1e18;
  if (periodic) {
    step(fluid);  // it is a whole number of periods away from somewhere
  } else {
    const Said said = what_fails([&] { step(fluid); });
    CHECK(said.id == "E309");
    CHECK(said.particles == std::vector<std::uint32_t>{11});
  }
}

TEST_CASE("a particle that is lost stops a run, and so does energy from nowhere", "[sph][fault]") {
  Fluid fluid = some_fluid();
  sphmbs::sph::Balance balance(fluid);
  step(fluid);
  balance.check();
  CHECK(balance.warnings().empty());
  const auto y = fluid.particles().fields();
  SECTION("a particle") {
    y.set[5] = 1;  // now a wall
    CHECK_THAT(what_fails([&] { balance.check(); }).text, Contains("323"));
  }
  SECTION("a little energy") {
    for (std::size_t i = 0; i < fluid.size(); ++i) y.e[i] *= 1.05;
    balance.check();
    balance.check();
    REQUIRE(balance.warnings().size() == 1);
    CHECK_THAT(balance.warnings()[0], Contains("energy at t = "));
  }
  SECTION("much energy") {
    for (std::size_t i = 0; i < fluid.size(); ++i) y.e[i] *= 1.5;
    CHECK(what_fails([&] { balance.check(); }).id == "E320");
  }
  SECTION("momentum") {
    for (std::size_t i = 0; i < fluid.size(); ++i) y.v[0][i] += 30;
    CHECK_THAT(what_fails([&] { balance.check(); }).text, Contains("momentum"));
  }
  SECTION("not a number") {
    y.e[3] = not_a_number;
    CHECK(what_fails([&] { balance.check(); }).id == "E320");
  }
}

namespace {

/// Ends in an exception of its own for dense gas.
struct Touchy : sphmbs::eos::IdealGas {
  template <class N>
  N pressure(N rho, N e) const {
    if constexpr (std::is_same_v<N, double>)
      if (rho > 100) throw std::runtime_error("no such gas at " + std::to_string(rho));
    return IdealGas::pressure(rho, e);
  }
};

using TouchyGas =
    sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<2>, sphmbs::riemann::Acoustic, Touchy>;

}  // namespace

TEST_CASE("what an equation of state throws on any thread reaches the caller", "[sph][fault]") {
  const int threads = GENERATE(1, 2, 4);
  const test::Threads some(threads);
  auto cloud = test::disordered_cloud<2>(18, spacing, 71);
  sphmbs::sph::Fluid<TouchyGas, Policy> fluid({}, test::cube<2>(side, true), cloud);
  const auto rho = fluid.particles().fields().rho;
  rho[300] = 300;
  rho[200] = 200;
  CHECK_THROWS_WITH(fluid.stage(0, 0), Contains("no such gas at 200"));
}

TEST_CASE("two gases of different dimension do not see each other", "[sph][fault]") {
  using Line = sphmbs::sph::Fluid<test::Gas<1>, Policy>;
  const auto line = [] {
    return Line({}, test::cube<1>(20, true), test::disordered_cloud<1>(200, spacing, 5));
  };
  const auto go = [](auto& fluid) {
    PredictorCorrector{}.step(fluid,
                              [&] { return sphmbs::sph::step_limit(fluid.survey(), 0.25).dt; });
  };
  Fluid plane = some_fluid(), lone_plane = some_fluid();
  Line thin = line(), lone_line = line();
  for (int k = 0; k < 5; ++k) {
    go(plane);
    go(thin);
  }
  for (int k = 0; k < 5; ++k) go(lone_plane);
  for (int k = 0; k < 5; ++k) go(lone_line);
  CHECK(same_bits(test::state_of(plane), test::state_of(lone_plane)));
  CHECK(same_bits(test::state_of(thin), test::state_of(lone_line)));
}
