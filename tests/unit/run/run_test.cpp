// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <sphmbs/run.hpp>
#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::Every;
using sphmbs::Schedule;
using sphmbs::Timing;
using sphmbs::sph::StepLimit;
using sphmbs::time::PredictorCorrector;

/// A system that does nothing but keep time; sound allows it steps of a given length.
class Clock {
 public:
  explicit Clock(double courant) { survey_.courant = {courant, 42}; }

  void stage(double, double dt) { staged_ = dt; }
  void rates(double) { rates_at_ = time_ + staged_; }
  void commit(double, double dt) { time_ += dt; }
  double time() const { return time_; }
  const sphmbs::sph::Survey<2>& survey() const { return survey_; }

  /// Whether the rates belong to the state.
  bool consistent() const { return rates_at_ == time_; }

 private:
  double time_ = 0;
  double staged_ = 0;
  double rates_at_ = -1;
  sphmbs::sph::Survey<2> survey_;
};

struct Nothing {
  void operator()(const Clock&, const StepLimit&) const {}
};

/// The times at which an observer of some interval acts.
template <class Integrator = PredictorCorrector>
std::vector<double> acts(const Schedule& schedule, double interval, double courant = 1,
                         Timing timing = Timing::exact) {
  std::vector<double> times;
  Clock clock(courant);
  sphmbs::run(clock, Integrator{}, schedule, Nothing{},
              Every(
                  interval,
                  [&](Clock& c) {
                    CHECK(c.consistent());
                    times.push_back(c.time());
                  },
                  timing));
  return times;
}

/// The lengths of the steps taken.
template <class... Observers>
std::vector<double> steps(const Schedule& schedule, double courant, Observers... observers) {
  std::vector<double> lengths;
  Clock clock(courant);
  sphmbs::run(
      clock, PredictorCorrector{}, schedule,
      [&](Clock&, const StepLimit& limit) { lengths.push_back(limit.dt); }, observers...);
  CHECK(clock.time() == Approx(schedule.until).epsilon(1e-12));
  return lengths;
}

bool close(const std::vector<double>& found, const std::vector<double>& expected) {
  if (found.size() != expected.size()) return false;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (std::abs(found[i] - expected[i]) > 1e-12) return false;
  return true;
}

}  // namespace

TEMPLATE_TEST_CASE("an observer acts at 0, at every multiple and at the end, once each", "[run]",
                   PredictorCorrector, sphmbs::time::Heun, sphmbs::time::ShuOsher) {
  SECTION("the end is no multiple") {
    CHECK(close(acts<TestType>({.until = 1}, 0.3), {0, 0.3, 0.6, 0.9, 1}));
  }
  SECTION("the end is a multiple") {
    CHECK(close(acts<TestType>({.until = 1}, 0.25), {0, 0.25, 0.5, 0.75, 1}));
    CHECK(close(acts<TestType>({.until = 0.3}, 0.1), {0, 0.1, 0.2, 0.3}));
  }
  SECTION("the interval is longer than the run") {
    CHECK(close(acts<TestType>({.until = 1}, 5), {0, 1}));
  }
  SECTION("steps are much shorter than the interval") {
    CHECK(close(acts<TestType>({.until = 1}, 0.5, 0.003), {0, 0.5, 1}));
  }
}

TEST_CASE("an observer keeps its times over many intervals", "[run]") {
  const auto times = acts({.until = 100}, 0.1, 0.04);
  REQUIRE(times.size() == 1001);
  for (std::size_t i = 0; i < times.size(); ++i)
    REQUIRE(std::abs(times[i] - 0.1 * static_cast<double>(i)) < 1e-9);
}

TEST_CASE("an observer that may wait acts at the first step after its time", "[run]") {
  // A quarter of 0.16 is a step of 0.04.
  CHECK(close(acts({.until = 0.4, .cfl = 0.25}, 0.1, 0.16, Timing::next_step),
              {0, 0.12, 0.2, 0.32, 0.4}));
}

TEST_CASE("fixed steps are kept, and observers act at the first step after their time", "[run]") {
  CHECK(close(acts({.until = 1, .step = 0.25}, 0.3), {0, 0.5, 0.75, 1}));
  CHECK(close(steps({.until = 1, .step = 0.25}, 0.25, Every(0.3, [](Clock&) {})),
              {0.25, 0.25, 0.25, 0.25}));
}

TEST_CASE("an interval shorter than a fixed step acts once a step", "[run]") {
  CHECK(close(acts({.until = 1, .step = 0.25}, 0.1), {0, 0.25, 0.5, 0.75, 1}));
}

TEST_CASE("the last fixed step ends where the schedule does", "[run]") {
  CHECK(close(steps({.until = 1, .step = 0.3}, 1), {0.3, 0.3, 0.3, 0.1}));
}

TEST_CASE("a fixed step that divides the time is taken that many times", "[run]") {
  CHECK(steps({.until = 1, .step = 1e-3}, 1).size() == 1000);
  CHECK(steps({.until = 0.8, .step = 1e-4}, 1).size() == 8000);
  CHECK(steps({.until = 1, .step = 1e-6}, 1).size() == 1000000);
}

TEST_CASE("a step limited by sound is the Courant number times the limit", "[run]") {
  const auto lengths = steps({.until = 1, .cfl = 0.5}, 0.25);
  CHECK(close(lengths, std::vector<double>(8, 0.125)));
}

TEST_CASE("steps are shortened evenly to meet an observer and the end", "[run]") {
  // 0.3 is met by three steps of 0.1, the rest of 0.1 by one; the limit is 0.125.
  CHECK(close(steps({.until = 0.4, .cfl = 0.5}, 0.25, Every(0.3, [](Clock&) {})),
              {0.1, 0.1, 0.1, 0.1}));
  CHECK(close(steps({.until = 1, .cfl = 0.5}, 0.6), {0.25, 0.25, 0.25, 0.25}));
}

TEST_CASE("steps meet the times of several observers", "[run]") {
  const auto lengths =
      steps({.until = 0.6, .cfl = 1}, 10, Every(0.2, [](Clock&) {}), Every(0.3, [](Clock&) {}),
            Every(
                0.05, [](Clock&) {}, Timing::next_step));
  CHECK(close(lengths, {0.2, 0.1, 0.1, 0.2}));
}

TEST_CASE("no step is longer than its limit", "[run]") {
  for (const double courant : {0.1, 0.137, 0.31, 0.999}) {
    for (const double length : steps({.until = 1, .cfl = 1}, courant, Every(0.21, [](Clock&) {})))
      CHECK(length <= courant * (1 + 1e-8));
  }
}

TEST_CASE("the report tells why the step is no longer and who limits it", "[run]") {
  Clock clock(0.1);
  sphmbs::run(clock, PredictorCorrector{}, {.until = 0.1, .cfl = 1},
              [](Clock& c, const StepLimit& limit) {
                CHECK(c.consistent());
                CHECK(limit.reason == "sound");
                CHECK(limit.id == 42);
              });
  Clock fixed(0.1);
  sphmbs::run(fixed, PredictorCorrector{}, {.until = 0.1, .step = 0.05},
              [](Clock&, const StepLimit& limit) { CHECK(limit.reason == "fixed"); });
}

TEST_CASE("a run that goes on from where another ended begins there", "[run]") {
  Clock clock(1);
  std::vector<double> times;
  const auto observer = [&] { return Every(0.4, [&](Clock& c) { times.push_back(c.time()); }); };
  sphmbs::run(clock, PredictorCorrector{}, {.until = 1}, Nothing{}, observer());
  times.clear();
  sphmbs::run(clock, PredictorCorrector{}, {.until = 2}, Nothing{}, observer());
  CHECK(close(times, {1, 1.2, 1.6, 2}));
}

TEST_CASE("a run without observers reaches its end", "[run]") {
  Clock clock(0.01);
  sphmbs::run(clock, PredictorCorrector{}, {.until = 1}, Nothing{});
  CHECK(clock.time() == Approx(1).epsilon(1e-12));
  CHECK(clock.consistent());
}

TEST_CASE("a schedule out of range is refused by name", "[run][fault]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto refusal = [](const Schedule& schedule) {
    const auto by_itself = test::refusal([&] { schedule.check(); });
    CHECK(by_itself == test::refusal([&] {
            Clock clock(1);
            sphmbs::run(clock, PredictorCorrector{}, schedule, Nothing{});
          }));
    return by_itself;
  };
  CHECK(refusal({.until = 1}).empty());
  CHECK(refusal({.until = 1, .cfl = 1}).empty());
  CHECK_THAT(refusal({.until = 0}), Contains("until = 0"));
  CHECK_THAT(refusal({.until = -1}), Contains("until = -1"));
  CHECK_THAT(refusal({.until = infinity}), Contains("until = inf"));
  CHECK_THAT(refusal({.until = 1, .cfl = 0}), Contains("cfl = 0"));
  CHECK_THAT(refusal({.until = 1, .cfl = 1.5}), Contains("cfl = 1.5"));
  CHECK_THAT(refusal({.until = 1, .cfl = NAN}), Contains("cfl = nan"));
  CHECK_THAT(refusal({.until = 1, .step = 0.0}), Contains("step = 0"));
  CHECK_THAT(refusal({.until = 1, .step = -0.1}), Contains("step = -0.1"));
  CHECK_THAT(refusal({.until = 1, .step = infinity}), Contains("step = inf"));
}

TEST_CASE("an interval that is not positive is refused", "[run]") {
  const auto refusal = [](double interval) {
    return test::refusal([&] { Every(interval, [](Clock&) {}); });
  };
  CHECK(refusal(1).empty());
  CHECK_THAT(refusal(0), Contains("interval = 0"));
  CHECK_THAT(refusal(-0.1), Contains("interval = -0.1"));
  CHECK_THAT(refusal(NAN), Contains("interval = nan"));
}
