// SPDX-License-Identifier: MIT
#include <cmath>

#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

constexpr double spacing = 0.1;
constexpr int per_side = 20;
constexpr double side = per_side * spacing;

/// A fluid that counts after every evaluation which pairs its lists should have found.
template <class Fluid>
class Watched {
 public:
  explicit Watched(Fluid& fluid) : fluid_(fluid) {}

  void stage(double scale, double dt) { fluid_.stage(scale, dt); }
  void rates(double keep) {
    fluid_.rates(keep);
    const auto* const records = fluid_.particles().records();
    const auto space = fluid_.domain().template periodicity<double>();
    std::uint64_t expected = 0;
    for (std::size_t a = 0; a < fluid_.size(); ++a) {
      const auto s = sphmbs::particles::load_record<2>(records, a);
      for (std::size_t b = 0; b < a; ++b) {
        const auto o = sphmbs::particles::load_record<2>(records, b);
        const double reach = 3 * (s.h + o.h) / 2;
        if (norm2(space.nearest(o.r - s.r)) < reach * reach) expected += 2;
      }
    }
    missed += fluid_.survey().pairs != expected ? 1 : 0;
    ++evaluations;
  }
  void commit(double scale, double dt) { fluid_.commit(scale, dt); }
  double step_limit() const { return sphmbs::sph::step_limit(fluid_.survey(), 0.25).dt; }

  int missed = 0;
  int evaluations = 0;

 private:
  Fluid& fluid_;
};

/// A gas at rest with a blast in its middle: smoothing lengths and speeds change quickly.
sphmbs::particles::Cloud<2> blast() {
  auto cloud = test::lattice_cloud<2>(per_side, spacing, test::still_air<2>());
  test::disturb(cloud, spacing, 95,
                {.place = 0.2, .speed = 0, .density = 0, .pressure = 0, .mass = 0});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double x = cloud.r[i][0] - side / 2;
    const double y = cloud.r[i][1] - side / 2;
    if (std::hypot(x, y) < 0.35) cloud.p[i] *= 2;
  }
  return cloud;
}

template <class Policy, class Integrator>
void check_run(const sphmbs::particles::Cloud<2>& cloud, bool periodic) {
  sphmbs::sph::Fluid<test::Gas<2>, Policy> fluid({}, test::cube<2>(side, periodic), cloud);
  Watched watched(fluid);
  for (int step = 0; step < 40; ++step)
    Integrator{}.step(watched, [&] { return watched.step_limit(); });
  CHECK(watched.missed == 0);
  // The lists did serve several evaluations and were made anew more than once.
  CHECK(fluid.statistics().rebuilds > 1);
  CHECK(fluid.statistics().rebuilds < static_cast<std::uint64_t>(watched.evaluations));
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("no pair is missed while lists serve several steps", "[sph]",
                        test::Policies) {
  const bool periodic = GENERATE(false, true);
  CAPTURE(periodic);
  SECTION("of a blast") {
    check_run<TestType, sphmbs::time::PredictorCorrector>(blast(), periodic);
    check_run<TestType, sphmbs::time::Heun>(blast(), periodic);
    check_run<TestType, sphmbs::time::ShuOsher>(blast(), periodic);
  }
  SECTION("of a disordered gas") {
    const auto cloud = test::disordered_cloud<2>(per_side, spacing, 96);
    check_run<TestType, sphmbs::time::PredictorCorrector>(cloud, periodic);
  }
}

TEST_CASE("a gas at rest needs its lists once", "[sph]") {
  const auto cloud = test::lattice_cloud<2>(per_side, spacing, test::still_air<2>());
  sphmbs::sph::Fluid<test::Gas<2>> fluid({}, test::cube<2>(side, true), cloud);
  for (int step = 0; step < 10; ++step)
    sphmbs::time::PredictorCorrector{}.step(fluid, [] { return 1e-5; });
  CHECK(fluid.statistics().rebuilds <= 2);
  CHECK(fluid.statistics().steps == 10);
  CHECK(fluid.statistics().evaluations == 20);
}

TEST_CASE("changing the smoothing lengths before the first stage is allowed", "[sph]") {
  const auto domain = test::cube<2>(side, false);
  auto cloud = test::disordered_cloud<2>(per_side, spacing, 97);
  sphmbs::sph::Fluid<test::Gas<2>> fluid({}, domain, cloud);
  const auto fields = fluid.particles().fields();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.h[i] *= 1.5;
    fields.h[fields.id[i]] = cloud.h[i];
  }
  fluid.stage(0, 0);
  fluid.rates(0);
  CHECK(fluid.survey().pairs == test::rates_of(test::Gas<2>{}, domain, cloud).survey.pairs);
}
