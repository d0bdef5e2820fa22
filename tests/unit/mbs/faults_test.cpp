// SPDX-License-Identifier: MIT
// What a structure does when its numbers go wrong.
#include <limits>
#include <string>

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
