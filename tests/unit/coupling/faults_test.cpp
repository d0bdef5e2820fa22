// SPDX-License-Identifier: MIT
// What gas and bodies do together when something goes wrong.
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "support/ball_in_gas.hpp"
#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"

#include <sphmbs/coupling/leaks.hpp>
#include <sphmbs/io/checkpoints.hpp>

namespace {

using Catch::Matchers::Contains;
namespace coupling = sphmbs::coupling;
using sphmbs::NumericalFailure;
using Ball = test::BallInGas<sphmbs::sph::PaperScheme<2>>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const Ball::Plan small{.spacing = 0.2, .side = 4, .velocity = {0.1, 0}};

std::string failure(Ball& ball, const auto& scheme) {
  return test::complaint<NumericalFailure>([&] {
    sphmbs::run(ball.system, scheme, {.until = ball.system.time() + 1, .step = 0.02},
                sphmbs::no_report);
  });
}

double fastest(Ball& ball) {
  const auto fields = ball.fluid.particles().fields();
  double square = 0;
  for (std::size_t i = 0; i < ball.fluid.size(); ++i)
    if (fields.set[i] == sphmbs::particles::gas)
      square = std::max(square, norm2(fields.velocity(i)));
  return std::sqrt(square);
}

}  // namespace

TEMPLATE_TEST_CASE("a NaN in a body is named, and no step is tried twice for it",
                   "[coupling][fault]", coupling::Staggered<>, coupling::Strong<>) {
  Ball ball(small);
  ball.system.evaluate();
  TestType{}.step(ball.system, [] { return 0.01; });
  auto memory = ball.bodies.memory();
  std::string what;
  SECTION("coordinate") {
    memory.state.q[1] = not_a_number;
    what = "coordinate q of ";
  }
  SECTION("velocity") {
    memory.state.v[0] = not_a_number;
    what = "velocity v of ";
  }
  SECTION("multiplier") {
    memory.state.lambda[0] = not_a_number;
    what = "multiplier lambda of ";
  }
  ball.bodies.recall(memory);
  const std::string text = failure(ball, TestType{});
  CAPTURE(text);
  CHECK_THAT(text, Contains(what) && Contains("body 0") && Contains("nan"));
  CHECK(ball.fluid.statistics().retries == 0);
}

TEMPLATE_TEST_CASE("a coupled step that fails leaves gas and bodies where they were",
                   "[coupling][fault]", coupling::Staggered<>, coupling::Strong<>) {
  Ball ball(small);
  TestType{}.step(ball.system, [] { return 0.01; });
  const auto q = ball.bodies.state().q;
  const double t = ball.system.time(), work = ball.system.exchanged().work_of_gas;
  ball.fluid.admission().fastest = 1e-6;
  CHECK_THROWS_AS(TestType{}.step(ball.system, [] { return 0.01; }), NumericalFailure);
  ball.system.undo();
  CHECK(ball.fluid.time() == t);
  CHECK(ball.bodies.time() == t);
  CHECK(ball.bodies.state().q == q);
  CHECK(ball.system.exchanged().work_of_gas == work);
  ball.fluid.admission() = {};
  TestType{}.step(ball.system, [] { return 0.01; });
  CHECK(ball.system.time() == Approx(0.02));
  CHECK(ball.bodies.time() == ball.fluid.time());
}

TEST_CASE("undone before its first step, a coupled system is as it was made", "[coupling][fault]") {
  Ball ball(small), untouched(small);
  const auto q = ball.bodies.state().q, vdot = ball.bodies.state().vdot;
  ball.system.undo();
  CHECK(ball.bodies.state().q == q);
  CHECK(ball.bodies.state().vdot == vdot);
  for (Ball* b : {&ball, &untouched}) coupling::Staggered<>{}.step(b->system, [] { return 0.01; });
  CHECK(ball.bodies.state().q == untouched.bodies.state().q);
}

TEST_CASE("bodies that fail within a step are undone with the gas", "[coupling][fault]") {
  Ball ball(small);
  coupling::Staggered<> scheme;
  scheme.step(ball.system, [] { return 0.01; });
  const auto q = ball.bodies.state().q;
  const auto before = ball.system.exchanged();
  REQUIRE(before.work_of_gas != 0);
  scheme.structure_steps = 3;
  int calls = 0;
  // Newton's method cannot succeed.
  scheme.structure.newton.tolerance = 1e-300;
  scheme.structure.newton.max_iterations = 1;
  scheme.structure.newton.max_halvings = 0;
  CHECK_THROWS_AS(scheme.step(ball.system,
                              [&] {
                                ++calls;
                                return 0.3;
                              }),
                  NumericalFailure);
  ball.system.undo();
  CHECK(calls == 1);
  CHECK(ball.bodies.state().q == q);
  CHECK(ball.system.exchanged().work_of_gas == before.work_of_gas);
  CHECK(test::same_bits(ball.system.exchanged().impulse, before.impulse));
  // Nor do bodies stay where some of several steps have led them.
  ball.system.begin();
  sphmbs::mbs::GeneralizedAlpha{}.step(ball.bodies, [] { return 0.1; });
  CHECK(ball.bodies.state().q != q);
  auto& load = ball.system.mean_load();
  const sphmbs::mbs::VectorXd mean = sphmbs::mbs::VectorXd::Ones(q.size());
  const sphmbs::mbs::VectorXd end = load.at_end(scheme.structure, mean, 0.1).load;
  load.accept(load.at_end(scheme.structure, mean, 0.1), 0.1);
  CHECK(load.at_end(scheme.structure, mean, 0.1).load != end);
  ball.system.undo();
  CHECK(load.at_end(scheme.structure, mean, 0.1).load == end);
  CHECK(ball.bodies.state().q == q);
  CHECK(ball.bodies.time() == ball.fluid.time());
}

TEST_CASE("a step of several of the gas ends with the last good one", "[coupling][fault]") {
  Ball first(small), ball(small);
  coupling::Staggered<> scheme;
  double speed[3];
  for (double& s : speed) {
    scheme.step(first.system, [] { return 0.05; });
    s = fastest(first);
  }
  REQUIRE(speed[1] > 1.001 * speed[0]);
  scheme.gas_steps = 3;
  ball.fluid.admission().fastest = 0.5 * (speed[0] + speed[1]);
  CHECK(scheme.step(ball.system, [] { return 0.15; }) == Approx(0.05));
  CHECK(ball.system.time() == Approx(0.05));
  CHECK(ball.bodies.time() == Approx(ball.fluid.time()));
  CHECK(ball.fluid.statistics().retries == 1);
  ball.fluid.admission() = {};
  scheme.step(ball.system, [] { return 0.15; });
  CHECK(ball.system.time() == Approx(0.2));
}

TEST_CASE("a coupling that diverges ends with the course of its forces", "[coupling][fault]") {
  auto plan = small;
  plan.mass_ratio = 1e-3;
  Ball ball(plan);
  const coupling::Strong<coupling::Relaxation> hopeless{.repeat = {.share = 1}, .most = 6};
  const std::string text =
      test::complaint<NumericalFailure>([&] { hopeless.step(ball.system, [] { return 0.02; }); });
  CAPTURE(text);
  CHECK_THAT(text, Contains("do not agree after 6 repetitions") && Contains("as a share of them"));
  ball.system.undo();
  CHECK(ball.system.time() == 0);
  CHECK(ball.bodies.time() == 0);
  // Shorter steps agree, and are counted.
  sphmbs::run(ball.system, hopeless, {.until = 0.04, .step = 0.02}, sphmbs::no_report);
  CHECK(ball.fluid.statistics().retries > 1);
  CHECK(ball.fluid.statistics().steps > 2);
  CHECK(ball.velocity().norm() < 0.2);
  Ball good(plan);
  sphmbs::run(good.system, coupling::Strong<>{}, {.until = 0.1, .step = 0.02}, sphmbs::no_report);
  CHECK(good.velocity().norm() < 0.2);
}

TEST_CASE("forces that are near agreement when the repetitions end are not taken for it",
          "[coupling][fault]") {
  Ball ball(small);
  const coupling::Strong<coupling::Relaxation> short_of_it{.repeat = {.share = 0.5}, .most = 1};
  const std::string text = test::complaint<NumericalFailure>(
      [&] { short_of_it.step(ball.system, [] { return 0.02; }); });
  CHECK_THAT(text, Contains("do not agree after 1 repetitions"));
  CHECK(ball.system.time() == 0);
}

TEST_CASE("gas that gets into a body is counted and named, or stops the run", "[coupling][fault]") {
  Ball ball(small);
  ball.system.evaluate();
  coupling::Leaks leaks(ball.system);
  coupling::Leaks strict(ball.system, 0);
  leaks.look();
  CHECK(leaks.crossed().empty());
  const auto fields = ball.fluid.particles().fields();
  std::size_t i = 0;
  while (fields.set[i] != sphmbs::particles::gas || std::abs(fields.r[0][i] - 2) > 0.15 ||
         std::abs(fields.r[1][i] - 2.7) > 0.15)
    ++i;
  for (std::size_t j = 0; j < ball.fluid.size(); ++j)  // onto a particle of the ball
    if (sphmbs::particles::is_virtual(fields.set[j]) && std::abs(fields.r[0][j] - 2) < 0.15 &&
        fields.r[1][j] > 2.25)
      for (int k = 0; k < 2; ++k) fields.r[k][i] = fields.r[k][j];
  // One that goes on from a checkpoint knows where the gas was.
  const auto folder = std::filesystem::temp_directory_path() /
                      ("sphmbs_leaks_" + std::to_string(std::random_device{}()));
  const auto saved = sphmbs::io::Checkpoints(folder).write(
      1, {}, [&](sphmbs::io::StateWriter& archive) { archive("leaks", leaks); });
  coupling::Leaks late(ball.system), resumed(ball.system);
  sphmbs::io::CheckpointFile file(saved);
  sphmbs::io::StateReader archive(file);
  archive("leaks", resumed);
  std::filesystem::remove_all(folder);
  late.look();
  resumed.look();
  CHECK(late.crossed().empty());
  CHECK(resumed.crossed() == std::vector<std::uint32_t>{fields.id[i]});
  leaks.look();
  leaks.look();
  CHECK(leaks.crossed() == std::vector<std::uint32_t>{fields.id[i]});
  try {
    strict.look();
    FAIL("not noticed");
  } catch (const sphmbs::BeyondModel& e) {
    CHECK(e.particles == std::vector<std::uint32_t>{fields.id[i]});
    CHECK(e.id == "E321");
  }
}
