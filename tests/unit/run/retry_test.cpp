// SPDX-License-Identifier: MIT
// Steps that fail, of a system that fails as it is told to.
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/run.hpp>
#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::BeyondModel;
using sphmbs::Every;
using sphmbs::NumericalFailure;
using sphmbs::Schedule;
using sphmbs::time::PredictorCorrector;

/// Keeps time, and its state is the sum of its steps; sound allows steps of `courant(t)`.
class Fragile {
 public:
  std::function<double(double)> courant = [](double) { return 1.0; };
  /// May throw: the stage at t + dt.
  std::function<void(double, double)> at_stage = [](double, double) {};

  void stage(double, double dt) {
    ++stages;
    if (dt > 0) at_stage(time_, dt);
    if (dt == 0) dirty = false;
  }
  void rates(double) { survey_.courant = {courant(time_), 42}; }
  void commit(double, double dt) {
    CHECK_FALSE(dirty);
    time_ += dt;
    steps.push_back(dt);
  }
  void undo() {
    ++undone;
    dirty = true;  // until the first stage is taken again
  }
  double time() const { return time_; }
  const sphmbs::sph::Survey<2>& survey() const { return survey_; }
  std::string describe(std::uint32_t id) const { return "particle #" + std::to_string(id); }

  std::vector<double> steps;
  int undone = 0;
  int stages = 0;
  bool dirty = false;

 private:
  double time_ = 0;
  sphmbs::sph::Survey<2> survey_;
};

/// Fails for stages later than `longest` after the beginning of a step, between two times.
auto fails_beyond(double longest, double from = 0, double to = 1e9) {
  return [=](double t, double dt) {
    if (t >= from && t < to && dt > longest)
      throw NumericalFailure("too far\n  try: less", "E302", {7});
  };
}

constexpr auto quiet = [](auto&, const auto&) {};

}  // namespace

TEMPLATE_TEST_CASE("a step that fails is undone and taken in shorter ones", "[run][fault]",
                   PredictorCorrector, sphmbs::time::Heun, sphmbs::time::ShuOsher) {
  Fragile system;
  system.courant = [](double) { return 0.5; };
  system.at_stage = fails_beyond(0.06, 0.9, 1.1);
  int reports = 0;
  std::vector<double> seen;
  sphmbs::run(
      system, TestType{}, {.until = 2, .cfl = 1}, [&](auto&, const auto&) { ++reports; },
      Every(0.5, [&](Fragile& s) { seen.push_back(s.time()); }));
  CHECK(system.undone > 0);
  CHECK(system.time() == Approx(2).epsilon(1e-12));
  CHECK(seen == std::vector<double>{0, 0.5, 1, 1.5, 2});
  CHECK(reports == static_cast<int>(system.steps.size()));
}

TEST_CASE("after eight retries a step is a failure, with what it was and who", "[run][fault]") {
  Fragile system;
  system.at_stage = fails_beyond(0);
  try {
    sphmbs::run(system, PredictorCorrector{}, {.until = 1}, quiet);
    FAIL("went on");
  } catch (const NumericalFailure& failure) {
    CHECK(std::string(failure.what()) ==
          "too far (after 8 retries with shorter steps)\n  try: less");
    CHECK(failure.id == "E302");
    CHECK(failure.particles == std::vector<std::uint32_t>{7});
  }
  CHECK(system.undone == 9);  // the last time too: the system is as at the beginning of the step
  CHECK(system.time() == 0);
}

TEST_CASE("a fixed step that fails is taken in parts to its end", "[run][fault]") {
  Fragile system;
  system.at_stage = fails_beyond(0.04, 0.25, 0.5);
  std::vector<double> seen;
  sphmbs::run(system, PredictorCorrector{}, {.until = 1, .step = 0.25}, quiet,
              Every(0.01, [&](Fragile& s) { seen.push_back(s.time()); }));
  // The stage is in the middle of a step: 0.0625 is short enough.
  const std::vector<double> expected{0.25, 0.0625, 0.0625, 0.0625, 0.0625, 0.25, 0.25};
  CHECK(system.steps == expected);
  CHECK(seen == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
}

TEST_CASE("a fixed step beyond what is stable is taken in parts, or refused", "[run][fault]") {
  Fragile system;
  system.courant = [](double) { return 0.1; };
  sphmbs::run(system, PredictorCorrector{}, {.until = 2, .step = 1.0}, quiet);
  CHECK(system.steps.size() == 20);
  Fragile far;
  far.courant = [](double) { return 1e-6; };
  const auto text = test::complaint<NumericalFailure>(
      [&] { sphmbs::run(far, PredictorCorrector{}, {.until = 2, .step = 1.0}, quiet); });
  CHECK_THAT(text,
             Contains("a fixed step is 1000000") && Contains("sound") && Contains("particle #42"));
  CHECK(far.steps.empty());
}

TEST_CASE("what a shorter step does not help is not tried again", "[run][fault]") {
  Fragile touching;
  touching.at_stage = [](double, double) { throw BeyondModel("bodies touch"); };
  CHECK_THROWS_AS(sphmbs::run(touching, PredictorCorrector{}, {.until = 1}, quiet), BeyondModel);
  CHECK(touching.undone == 1);  // and left as it was
  Fragile wrong;
  wrong.at_stage = [](double, double) { throw sphmbs::InvalidInput("no"); };
  CHECK_THROWS_AS(sphmbs::run(wrong, PredictorCorrector{}, {.until = 1}, quiet),
                  sphmbs::InvalidInput);
  CHECK(wrong.undone == 0);
  Fragile seen;
  CHECK_THROWS_AS(sphmbs::run(seen, PredictorCorrector{}, {.until = 1}, quiet,
                              Every(0.5, [](Fragile&) { throw NumericalFailure("unbalanced"); })),
                  NumericalFailure);
  CHECK(seen.undone == 0);
}

TEST_CASE("steps that collapse end the run after twenty, with what limits them", "[run][fault]") {
  Fragile system;
  system.courant = [](double t) { return t < 0.5 ? 0.25 : 1e-8; };
  const auto text = [&] {
    return test::complaint<NumericalFailure>(
        [&] { sphmbs::run(system, PredictorCorrector{}, {.until = 1, .cfl = 1}, quiet); });
  };
  CHECK_THAT(text(), Contains("steps have become too short") && Contains("sound") &&
                         Contains("particle #42") && Contains("t = 0.5"));
  CHECK(system.steps.size() == 2 + 19);

  Fragile shallow;
  shallow.courant = [](double t) { return t < 0.5 ? 0.25 : 0.01; };
  CHECK_THROWS_AS(
      sphmbs::run(shallow, PredictorCorrector{}, {.until = 1, .cfl = 1, .floor = 0.02}, quiet),
      NumericalFailure);
  CHECK(shallow.steps.size() == 2 + 19);
}

namespace {

/// Numbers by name, as a checkpoint keeps them.
struct Kept {
  static constexpr bool restores = false;
  std::map<std::string_view, double> numbers;
  void operator()(std::string_view name, auto& value) {
    numbers[name] = static_cast<double>(value);
  }
};
struct Restored {
  static constexpr bool restores = true;
  const Kept& kept;
  template <class T>
  void operator()(std::string_view name, T& value) {
    value = static_cast<T>(kept.numbers.at(name));
  }
};

}  // namespace

TEST_CASE("a run that goes on from a checkpoint collapses where one would that was never saved",
          "[run][fault]") {
  const auto courant = [](double t) { return t < 0.5 ? 0.25 : 1e-8; };
  Fragile straight;
  straight.courant = courant;
  CHECK_THROWS_AS(sphmbs::run(straight, PredictorCorrector{}, {.until = 1, .cfl = 1}, quiet),
                  NumericalFailure);
  for (const std::size_t stop : {1, 2, 9}) {
    CAPTURE(stop);
    Fragile parts;  // goes on as it was, as a system does that is restored
    parts.courant = courant;
    sphmbs::sph::Pace pace;
    sphmbs::BetweenSteps ask([&](Fragile& system) { return system.steps.size() < stop; });
    CHECK_FALSE(sphmbs::run(parts, PredictorCorrector{}, {.until = 1, .cfl = 1}, pace, quiet, ask));
    Kept kept{};
    pace.visit_state(kept);
    sphmbs::sph::Pace again;
    Restored restored{kept};
    again.visit_state(restored);
    CHECK_THROWS_AS(sphmbs::run(parts, PredictorCorrector{}, {.until = 1, .cfl = 1}, again, quiet),
                    NumericalFailure);
    CHECK(parts.steps.size() == straight.steps.size());
  }
}

TEST_CASE("a step that is zero or not a number ends the run at once", "[run][fault]") {
  const double step = GENERATE(0.0, -1.0, std::numeric_limits<double>::quiet_NaN());
  Fragile system;
  system.courant = [=](double) { return step; };
  CHECK_THROWS_AS(sphmbs::run(system, PredictorCorrector{}, {.until = 1}, quiet), NumericalFailure);
  CHECK(system.steps.empty());
}

TEST_CASE("what an observer or a report throws reaches the caller", "[run][fault]") {
  struct Own {};
  Fragile system;
  CHECK_THROWS_AS(sphmbs::run(system, PredictorCorrector{}, {.until = 1}, quiet,
                              Every(0.5, [](Fragile&) { throw Own{}; })),
                  Own);
  CHECK_THROWS_AS(sphmbs::run(system, PredictorCorrector{}, {.until = 1},
                              [](auto&, const auto&) { throw Own{}; }),
                  Own);
}
