// SPDX-License-Identifier: MIT
// What a structure does when its numbers go wrong.
#include <limits>
#include <string>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/driven_angle.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"
#include "support/random.hpp"

using namespace sphmbs::mbs;
using Catch::Matchers::Contains;
using sphmbs::NumericalFailure;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Solver>
using System = Dynamics<test::PlanarMechanism, Solver, sphmbs::execution::Serial>;

}  // namespace

TEMPLATE_TEST_CASE("a NaN in a body is found within a step, with its coordinate", "[mbs][fault]",
                   solvers::SparseLU, solvers::SparseLDLT) {
  test::PlanarMechanism mechanism = test::double_pendulum();
  System<TestType> system(mechanism);
  test::Random random(17);
  for (int trial = 0; trial < 60; ++trial) {
    const auto good = system.memory();
    auto bad = good;
    auto& x = trial % 3 == 0 ? bad.state.q : trial % 3 == 1 ? bad.state.v : bad.state.lambda;
    const int k = static_cast<int>(random.between(0, static_cast<double>(x.size()) - 0.01));
    x[k] = trial % 2 == 0 ? not_a_number : std::numeric_limits<double>::infinity();
    system.recall(bad);
    const int unknown = trial % 3 == 2 ? system.equations().coordinates() + k : k;
    const char* const field = trial % 3 == 0   ? "coordinate q of "
                              : trial % 3 == 1 ? "velocity v of "
                                               : "multiplier lambda of ";
    const std::string text = test::complaint<NumericalFailure>(
        [&] { GeneralizedAlpha{}.step(system, [] { return 1e-3; }); });
    REQUIRE_THAT(text, Contains(field + system.equations().name_of(unknown)));
    system.recall(good);
    GeneralizedAlpha{}.step(system, [] { return 1e-3; });
  }
  CHECK(system.time() == Approx(0.06));
}

TEST_CASE("steps of a structure that collapse name the part that asks for them", "[mbs][fault]") {
  test::PlanarMechanism mechanism = test::double_pendulum();
  System<solvers::SparseLU> system(mechanism);
  const std::string text = test::complaint<NumericalFailure>([&] {
    sphmbs::run(system, GeneralizedAlpha{.accuracy = 1e-9}, {.until = 1, .floor = 0.01},
                sphmbs::no_report);
  });
  CHECK_THAT(text, Contains("steps have become too short") && Contains("accuracy") &&
                       Contains("the error of bar "));
  CHECK(system.statistics().steps == 20);
}

TEST_CASE("a stiff element of a cable that asks for tiny steps is named", "[mbs][fault]") {
  using Cable = ancf::Cable<2>;
  Structure<Cable, joints::Joint<2>> model;
  model.gravity = {0, -9.81};
  auto line = ancf::line(
      model, {.from = {0, 0},
              .to = {1, 0},
              .elements = 4,
              .prototype =
                  Cable{.axial_stiffness = 100, .bending_stiffness = 0.01, .mass_per_length = 1}});
  model.add(joints::pinned(line.start(), model.q(), "root"));
  model.template all<Cable>()[3].part.axial_stiffness *= 1e6;
  VectorXd v = model.v();
  v[v.size() - 2] = 10;  // stretches the last element
  model.start_from(model.q(), v);
  Dynamics<decltype(model), solvers::SparseLU, sphmbs::execution::Serial> system(model);
  const std::string text = test::complaint<NumericalFailure>([&] {
    sphmbs::run(system, GeneralizedAlpha{.accuracy = 1e-7}, {.until = 1, .floor = 1e-4},
                sphmbs::no_report);
  });
  CHECK_THAT(text, Contains("steps have become too short") && Contains("the error of cable 3"));
  CHECK(system.statistics().steps < 25);
}

TEST_CASE("an acceleration from nowhere is told in the step that it comes in", "[mbs][fault]") {
  test::PlanarMechanism mechanism;
  const auto bar = mechanism.add(test::thin_bar({0, 0}, {1, 0}));
  mechanism.add(joints::pinned(bar.start(), mechanism.q(), "root"));
  const joints::TimeFunction angle([](double t) { return t * t; }, [](double t) { return 2 * t; },
                                   [](double t) { return t < 0.0999 ? 2 : not_a_number; });
  mechanism.add(joints::driven_angle(bar.vector({0, 0}, {1, 0}), angle, mechanism.q(), "drive"));
  System<solvers::SparseLU> system(mechanism);
  const std::string text = test::complaint<NumericalFailure>(
      [&] { test::advance(system, GeneralizedAlpha{.newton = {.max_halvings = 0}}, 1, 0.01); });
  CHECK_THAT(text, Contains("the acceleration of driven angle 'drive' is not a number"));
  CHECK(system.time() == Approx(0.09));
  CHECK(system.state().vdot.allFinite());
}

TEST_CASE("a slider goes back to the element of its rail that an undone step began on",
          "[mbs][fault]") {
  using Cable = ancf::Cable<2>;
  Structure<Cable, ncf::Bar, joints::Joint<2>, joints::Sliding<Cable>> model;
  model.gravity = {0, -9.81};
  const auto line = ancf::line(
      model,
      {.from = {0, 0},
       .to = {3, 0},
       .elements = 3,
       .prototype = Cable{.axial_stiffness = 100, .bending_stiffness = 1, .mass_per_length = 1}});
  model.add(joints::pinned(line.start(), model.q(), "A"));
  model.add(joints::pinned(line.end(), model.q(), "B"));
  const auto bar = model.add(test::thin_bar({0.9, 0}, {0.9, -1}));
  VectorXd v = model.v();
  for (const Node& node : bar.nodes) v[node.offset] = 5;
  model.start_from(model.q(), v);
  model.add(joints::sliding(model, line.elements, {.slider = bar.start(), .at = 0.9}));
  Dynamics<decltype(model), solvers::SparseLU, sphmbs::execution::Serial> system(model);
  const auto slider = [&]() -> auto& { return model.template all<joints::Sliding<Cable>>()[0]; };
  const auto energies = system.energies();
  const auto memory = system.memory();
  REQUIRE(slider().element() == 0);
  GeneralizedAlpha{}.step(system, [] { return 0.05; });
  GeneralizedAlpha{}.step(system, [] { return 0.05; });
  REQUIRE(slider().element() == 1);
  SECTION("recalled") {
    system.recall(memory);
    CHECK(slider().element() == 0);
    CHECK(system.energies().total() == energies.total());
  }
  SECTION("a failed step leaves it where it is") {
    const GeneralizedAlpha hasty{
        .newton = {.tolerance = 1e-12, .max_iterations = 1, .max_halvings = 0}};
    system.recall(memory);
    CHECK_THROWS_AS(hasty.step(system, [] { return 0.1; }), NumericalFailure);
    CHECK(slider().element() == 0);
  }
}

TEST_CASE("Newton's method that cannot succeed says the same with every solver", "[mbs][fault]") {
  const auto say = [](auto&& system) {
    GeneralizedAlpha hasty{.newton = {.tolerance = 1e-12, .max_iterations = 1, .max_halvings = 2}};
    try {
      hasty.step(system, [] { return 0.1; });
    } catch (const NumericalFailure& e) {
      CHECK(e.id == "E330");
      CHECK(system.time() == 0);
      const std::string text = e.what();
      return text.substr(0, text.find("; the largest residual"));
    }
    return std::string();
  };
  test::PlanarMechanism mechanism = test::double_pendulum();
  const std::string lu = say(System<solvers::SparseLU>(mechanism));
  CHECK_THAT(lu, Contains("does not converge at t = 0.025 s") && Contains("after 2 halvings"));
  CHECK(say(System<solvers::SparseLDLT>(mechanism)) == lu);
}
