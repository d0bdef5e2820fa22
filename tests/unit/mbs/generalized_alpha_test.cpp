// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance;
using test::double_pendulum;
using test::PlanarMechanism;

TEST_CASE("every refactoring policy finds the same motion", "[mbs]") {
  std::vector<VectorXd> ends;
  std::vector<long> factorisations;
  for (const Refactor refactor :
       {Refactor::every_iteration, Refactor::every_step, Refactor::when_slow}) {
    PlanarMechanism mechanism = double_pendulum();
    Dynamics system(mechanism);
    advance(system, {.newton = {.tolerance = 1e-12, .refactor = refactor}}, 0.2, 2e-3);
    ends.push_back(system.state().q);
    factorisations.push_back(system.statistics().factorisations);
    CHECK(system.statistics().steps == 100);
    CHECK(system.statistics().halvings == 0);
  }
  CHECK((ends[1] - ends[0]).cwiseAbs().maxCoeff() < 1e-9);
  CHECK((ends[2] - ends[0]).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(factorisations[0] > factorisations[1]);
  // The projection takes one a step, which serves the next step where factors may be old.
  CHECK(factorisations[1] == 2 * 100);
  CHECK(factorisations[2] < 110);
}

TEST_CASE("conditions hold to rounding throughout", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  Dynamics system(mechanism);
  const GeneralizedAlpha integrator;
  double largest = 0;
  for (int k = 0; k < 500; ++k) {
    integrator.step(system, [] { return 4e-3; });
    system.equations().evaluate(system.state());
    largest = std::max(largest, system.equations().conditions_residual().cwiseAbs().maxCoeff());
  }
  CHECK(largest < 1e-9 * system.size());
}

TEST_CASE("a step with an accuracy is as long as it allows", "[mbs]") {
  std::vector<double> errors, steps;
  PlanarMechanism reference_mechanism = double_pendulum();
  Dynamics reference(reference_mechanism);
  advance(reference, {}, 0.5, 5e-5);
  for (const double accuracy : {1e-6, 1e-8}) {
    PlanarMechanism mechanism = double_pendulum();
    Dynamics system(mechanism);
    sphmbs::run(system, GeneralizedAlpha{.accuracy = accuracy}, {.until = 0.5},
                [](const auto&, const sphmbs::sph::StepLimit&) {});
    CHECK(system.time() == Approx(0.5).epsilon(1e-12));
    errors.push_back((system.state().q - reference.state().q).cwiseAbs().maxCoeff());
    steps.push_back(static_cast<double>(system.statistics().steps));
  }
  CHECK(steps[1] > 3 * steps[0]);  // the error of a step falls with the cube of its length
  CHECK(steps[1] < 7 * steps[0]);
  CHECK(errors[1] < errors[0] / 10);
  CHECK(errors[1] < 1e-5);
}

TEST_CASE("a step that is neither fixed nor controlled is refused", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  Dynamics system(mechanism);
  const auto refused = [&](const GeneralizedAlpha& integrator, const sphmbs::Schedule& schedule) {
    return test::refusal([&] {
      sphmbs::run(system, integrator, schedule, [](const auto&, const sphmbs::sph::StepLimit&) {});
    });
  };
  CHECK(test::mentions(refused({}, {.until = 1}), {"step = none", "accuracy"}));
  CHECK(test::mentions(refused({.spectral_radius = 1.5}, {.until = 1, .step = 1e-3}),
                       {"spectral_radius = 1.5", "between 0 and 1"}));
  CHECK(test::mentions(refused({.newton = {.tolerance = 0}}, {.until = 1, .step = 1e-3}),
                       {"newton.tolerance = 0"}));
  CHECK(test::mentions(refused({.accuracy = -1.0}, {.until = 1, .step = 1e-3}), {"accuracy = -1"}));
}

TEST_CASE("a step that fails is halved, and then reported with its iterations", "[mbs][fault]") {
  PlanarMechanism mechanism = double_pendulum();
  Dynamics system(mechanism);
  // Few iterations are enough for short steps only.
  GeneralizedAlpha hasty{.newton = {.max_iterations = 4}};
  hasty.step(system, [] { return 0.2; });
  CHECK(system.statistics().halvings > 0);
  CHECK(system.time() == Approx(0.2));

  hasty.newton.max_halvings = 1;
  hasty.newton.max_iterations = 1;
  hasty.newton.tolerance = 1e-12;
  const State before = system.state();
  const std::string text =
      test::complaint<sphmbs::NumericalFailure>([&] { hasty.step(system, [] { return 0.1; }); });
  CHECK(test::mentions(text, {"does not converge at t = 0.25 s with a step of 0.05 s",
                              "after 1 halvings", "largest residual", "iteration", "bar"}));
  CHECK(system.state().q == before.q);
  CHECK(system.state().t == before.t);
}
