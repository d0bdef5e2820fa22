// SPDX-License-Identifier: MIT
#include "support/bits.hpp"

#include <vector>

#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

constexpr double spacing = 0.1;

/// Gas in a channel, periodic along x, between two walls.
sphmbs::particles::Cloud<2> channel() {
  std::vector<sphmbs::Vec<2>> gas, wall;
  for (const auto& x : test::cell_centres<2>(40, spacing))
    (x[1] < 0.4 || x[1] > 3.6 ? wall : gas).push_back(x);
  sphmbs::particles::Cloud<2> cloud;
  cloud.add_gas(gas, test::still_air<2>(), {.spacing = spacing});
  cloud.add_virtual(wall, test::still_air<2>(), {.spacing = spacing});
  test::disturb(cloud, spacing, 91);
  return cloud;
}

/// Every field and what the run counted, after some steps, in the order of the initial cloud.
template <class T>
struct End {
  std::vector<std::vector<T>> fields;
  double time;
  double wall_work;
  sphmbs::Vec<2> impulse;
  std::uint64_t pairs;
  std::uint64_t rebuilds;
};

template <class Policy, class T, class Integrator>
End<T> twenty_steps(const Integrator& integrator) {
  auto domain = test::cube<2>(4, true);
  domain.periodic[1] = false;
  test::Gas<2> gas;
  gas.acceleration = {100, 0};
  sphmbs::sph::Fluid<test::Gas<2>, Policy, sphmbs::boundary::Fixed, T> fluid(gas, domain,
                                                                             channel());
  for (int step = 0; step < 20; ++step)
    integrator.step(fluid, [&] { return sphmbs::sph::step_limit(fluid.survey(), 0.25).dt; });
  const auto fields = fluid.particles().fields();
  End<T> end{.fields = {},
             .time = fluid.time(),
             .wall_work = fluid.exchange().wall_work(),
             .impulse = fluid.exchange().impulse(),
             .pairs = fluid.statistics().pair_interactions,
             .rebuilds = fluid.statistics().rebuilds};
  for (const T* field : {fields.r[0], fields.r[1], fields.v[0], fields.v[1], fields.rho, fields.e,
                         fields.h, fields.m})
    end.fields.push_back(test::by_id<Policy>(field, fields.id, fluid.size()));
  return end;
}

template <class T>
void check_same(const End<T>& a, const End<T>& b) {
  REQUIRE(a.fields.size() == b.fields.size());
  for (std::size_t f = 0; f < a.fields.size(); ++f) {
    CAPTURE(f);
    CHECK(test::same_bits(a.fields[f], b.fields[f]));
  }
  CHECK(test::same_bits(a.time, b.time));
  CHECK(test::same_bits(a.wall_work, b.wall_work));
  CHECK(test::same_bits(a.impulse, b.impulse));
  CHECK(a.pairs == b.pairs);
  CHECK(a.rebuilds == b.rebuilds);
}

template <class T, class Integrator>
void check_all_threads(const Integrator& integrator) {
  const auto expected = twenty_steps<sphmbs::execution::Serial, T>(integrator);
  CHECK(expected.rebuilds > 1);
  for (const int count : {1, 2, 3, 4}) {
    CAPTURE(count);
    const test::Threads threads(count);
    check_same(twenty_steps<sphmbs::execution::OpenMP, T>(integrator), expected);
  }
}

}  // namespace

TEST_CASE("a run has the same bits in one thread, in several, and without threads", "[sph]") {
  SECTION("in double precision") { check_all_threads<double>(sphmbs::time::PredictorCorrector{}); }
  SECTION("in single precision") { check_all_threads<float>(sphmbs::time::PredictorCorrector{}); }
  SECTION("with Heun's method") { check_all_threads<double>(sphmbs::time::Heun{}); }
}

TEST_CASE("a run has the same bits when it is repeated", "[sph]") {
  const sphmbs::time::PredictorCorrector integrator;
  check_same(twenty_steps<sphmbs::execution::OpenMP, double>(integrator),
             twenty_steps<sphmbs::execution::OpenMP, double>(integrator));
}
