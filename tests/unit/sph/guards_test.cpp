// SPDX-License-Identifier: MIT
#include <limits>
#include <string>

#include <sphmbs/run.hpp>
#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::NumericalFailure;

constexpr double spacing = 0.1;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

sphmbs::particles::Cloud<2> some_gas() { return test::disordered_cloud<2>(18, spacing, 71); }

/// What a fluid says of a cloud within one step.
template <class Policy, class Integrator = sphmbs::time::PredictorCorrector, class T = double>
std::string failure(const sphmbs::particles::Cloud<2>& cloud) {
  return test::complaint<NumericalFailure>([&] {
    sphmbs::sph::Fluid<test::Gas<2>, Policy, sphmbs::boundary::Fixed, T> fluid(
        {}, test::cube<2>(1.8, true), cloud);
    Integrator{}.step(fluid, [&] { return sphmbs::sph::step_limit(fluid.survey(), 0.25).dt; });
  });
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a healthy gas raises no alarm", "[sph]", test::Policies) {
  CHECK(failure<TestType>(some_gas()).empty());
}

TEMPLATE_LIST_TEST_CASE("the particle whose energy is not a number is named within one step",
                        "[sph][fault]", test::Policies) {
  for (const std::size_t sick : {0u, 150u, 323u}) {
    auto cloud = some_gas();
    cloud.p[sick] = not_a_number;
    const std::string id = "gas particle #" + std::to_string(sick) + " ";
    CHECK_THAT((failure<TestType>(cloud)), Contains(id));
    CHECK_THAT((failure<TestType, sphmbs::time::Heun>(cloud)), Contains(id));
    CHECK_THAT((failure<TestType, sphmbs::time::ShuOsher>(cloud)), Contains(id));
    CHECK_THAT((failure<TestType, sphmbs::time::PredictorCorrector, float>(cloud)), Contains(id));
  }
}

TEMPLATE_LIST_TEST_CASE("the particle whose state is not physical is named within one step",
                        "[sph][fault]", test::Policies) {
  const std::size_t sick = 150;
  auto cloud = some_gas();
  SECTION("negative density") { cloud.rho[sick] = -1; }
  SECTION("no density") { cloud.rho[sick] = 0; }
  SECTION("infinite density") { cloud.rho[sick] = infinity; }
  SECTION("negative pressure") { cloud.p[sick] = -1e5; }
  SECTION("infinite pressure") { cloud.p[sick] = infinity; }
  SECTION("velocity not a number") { cloud.v[sick][1] = not_a_number; }
  SECTION("infinite velocity") { cloud.v[sick][0] = infinity; }
  SECTION("place not a number") { cloud.r[sick][0] = not_a_number; }
  SECTION("infinite place") { cloud.r[sick][0] = -infinity; }
  SECTION("smoothing length not a number") { cloud.h[sick] = not_a_number; }
  SECTION("negative smoothing length") { cloud.h[sick] = -0.125; }
  CHECK_THAT(failure<TestType>(cloud), Contains("gas particle #150 "));
}

TEMPLATE_LIST_TEST_CASE("a sick virtual particle is named with its set", "[sph][fault]",
                        test::Policies) {
  auto cloud = some_gas();
  for (std::size_t i = 100; i < 200; ++i) cloud.set[i] = 2;
  cloud.p[150] = not_a_number;
  CHECK_THAT(failure<TestType>(cloud), Contains("virtual particle #150 of set 2 "));
}

TEST_CASE("a failure says when, where and in what state the particle is", "[sph][fault]") {
  auto cloud = some_gas();
  cloud.p[150] = not_a_number;
  const std::string text = failure<sphmbs::execution::Serial>(cloud);
  for (const char* part : {"at step ", "t = ", " at (", "v = (", "rho = ", "e = nan",
                           "h = ", " neighbours", "--cfl", "--step"})
    CHECK_THAT(text, Contains(part));
  for (const char* part : {"\n  gas particle #150", "\n  likely: ", "\n  try: "})
    CHECK_THAT(text, Contains(part));
}

TEST_CASE("a failure reads the same for any number of threads", "[sph][fault]") {
  auto cloud = test::disordered_cloud<2>(60, spacing, 72);
  for (const std::size_t sick : {700u, 1500u, 3100u}) cloud.p[sick] = not_a_number;
  const auto tell = [&] {
    return test::complaint<NumericalFailure>([&] {
      sphmbs::sph::Fluid<test::Gas<2>, sphmbs::execution::Default> fluid({}, test::cube<2>(6, true),
                                                                         cloud);
      sphmbs::time::PredictorCorrector{}.step(fluid, [] { return 1e-6; });
    });
  };
  const test::Threads one(1);
  const std::string expected = tell();
  CHECK_THAT(expected, Contains("#700 "));
  for (int count = 2; count <= 4; ++count) {
    const test::Threads several(count);
    CHECK(tell() == expected);
  }
}

TEST_CASE("too long a step is a numerical failure, and the advice is to shorten it",
          "[sph][fault]") {
  const bool periodic = GENERATE(false, true);
  CAPTURE(periodic);
  sphmbs::sph::Fluid<test::Gas<2>> fluid({}, test::cube<2>(1.8, periodic), some_gas());
  int reports = 0;
  const auto text = test::complaint<NumericalFailure>([&] {
    sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = 1, .step = 0.1},
                [&](auto&, const sphmbs::sph::StepLimit&) { ++reports; });
  });
  CHECK_THAT(text, Contains("dt = ") && Contains("smaller step"));
  CHECK(reports <= 3);
}
