// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>

#include "support/catch.hpp"

namespace {

/// y' = f(y, t) for a few unknowns, kept as the integrators want it. Old rates are not a number, so
/// that one that is read against the agreement shows.
template <class F>
class Ode {
 public:
  Ode(std::vector<double> start, F f) : y(std::move(start)), k_(y.size(), NAN), f_(f) {}

  void stage(double scale, double dt) {
    staged_ = y;
    if (scale != 0)
      for (std::size_t i = 0; i < y.size(); ++i) staged_[i] += scale * k_[i];
    at_ = t + dt;
    log += "stage ";
  }
  void rates(double keep) {
    const std::vector<double> f = f_(staged_, at_);
    for (std::size_t i = 0; i < y.size(); ++i) k_[i] = keep != 0 ? keep * k_[i] + f[i] : f[i];
    ++evaluations;
    log += "rates ";
  }
  void commit(double scale, double dt) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += scale * k_[i];
    t += dt;
    log += "commit ";
  }

  std::vector<double> y;
  double t = 0;
  int evaluations = 0;
  std::string log = {};

 private:
  std::vector<double> staged_ = {};
  std::vector<double> k_;
  double at_ = 0;
  F f_;
};

/// Harmonic oscillator: the state is (cos t, -sin t).
auto oscillator() {
  return Ode({1.0, 0.0}, [](const std::vector<double>& y, double) {
    return std::vector<double>{y[1], -y[0]};
  });
}

/// y' = y cos t: y = exp(sin t). Its right-hand side depends on the time of the stage.
auto driven() {
  return Ode({1.0}, [](const std::vector<double>& y, double t) {
    return std::vector<double>{y[0] * std::cos(t)};
  });
}

/// y' = 3 t^2: y = t^3. Depends on the time alone.
auto quadrature() {
  return Ode({0.0},
             [](const std::vector<double>&, double t) { return std::vector<double>{3 * t * t}; });
}

template <class System, class Integrator>
void go(System& system, const Integrator& integrator, double until, int steps) {
  for (int i = 0; i < steps; ++i) integrator.step(system, [&] { return until / steps; });
}

template <class Integrator>
double oscillator_error(int steps) {
  auto system = oscillator();
  go(system, Integrator{}, 2, steps);
  return std::hypot(system.y[0] - std::cos(2.0), system.y[1] + std::sin(2.0));
}

template <class Integrator>
double driven_error(int steps) {
  auto system = driven();
  go(system, Integrator{}, 2, steps);
  return std::abs(system.y[0] - std::exp(std::sin(2.0)));
}

/// The order that halving the step shows, over three halvings.
template <class Error>
void check_order(Error&& error, double expected) {
  for (const int steps : {160, 320, 640}) {
    const double order = std::log2(error(steps) / error(2 * steps));
    CAPTURE(steps);
    CHECK(std::abs(order - expected) < 0.1);
  }
}

using sphmbs::time::Heun;
using sphmbs::time::PredictorCorrector;
using sphmbs::time::ShuOsher;

}  // namespace

TEST_CASE("the predictor-corrector is of second order", "[time]") {
  check_order(oscillator_error<PredictorCorrector>, 2);
  check_order(driven_error<PredictorCorrector>, 2);
}

TEST_CASE("Heun's method is of second order", "[time]") {
  check_order(oscillator_error<Heun>, 2);
  check_order(driven_error<Heun>, 2);
}

TEST_CASE("Shu and Osher's method is of third order", "[time]") {
  check_order(oscillator_error<ShuOsher>, 3);
  check_order(driven_error<ShuOsher>, 3);
}

TEMPLATE_TEST_CASE("an integrator steps time by what is chosen and returns it", "[time]",
                   PredictorCorrector, Heun, ShuOsher) {
  auto system = oscillator();
  CHECK(TestType{}.step(system, [] { return 0.125; }) == 0.125);
  CHECK(system.t == 0.125);
  CHECK(TestType{}.step(system, [] { return 0.25; }) == 0.25);
  CHECK(system.t == 0.375);
}

TEMPLATE_TEST_CASE("the step is chosen once, after the first rates and before all else", "[time]",
                   PredictorCorrector, Heun, ShuOsher) {
  auto system = oscillator();
  int asked = 0;
  TestType{}.step(system, [&] {
    ++asked;
    CHECK(system.log == "stage rates ");
    CHECK(system.t == 0);
    return 0.1;
  });
  CHECK(asked == 1);
  CHECK(system.log.ends_with("commit "));
}

TEST_CASE("an integrator of n stages evaluates the rates n times a step", "[time]") {
  const auto evaluations = [](const auto& integrator) {
    auto system = oscillator();
    go(system, integrator, 1, 10);
    return system.evaluations;
  };
  CHECK(evaluations(PredictorCorrector{}) == 20);
  CHECK(evaluations(Heun{}) == 20);
  CHECK(evaluations(ShuOsher{}) == 30);
}

TEST_CASE("stages are taken at the times of the methods' tableaus", "[time]") {
  // One step of length 1 of y' = 3 t^2: midpoint 3/4, trapezium 3/2, Simpson's weights 1 exactly.
  const auto result = [](const auto& integrator) {
    auto system = quadrature();
    go(system, integrator, 1, 1);
    return system.y[0];
  };
  CHECK(result(PredictorCorrector{}) == Approx(0.75).epsilon(1e-15));
  CHECK(result(Heun{}) == Approx(1.5).epsilon(1e-15));
  CHECK(result(ShuOsher{}) == Approx(1).epsilon(1e-15));
}

TEST_CASE("an exponential grows by the methods' stability polynomials", "[time]") {
  const auto growth = [](const auto& integrator) {
    auto system = Ode({1.0}, [](const std::vector<double>& y, double) { return y; });
    go(system, integrator, 0.5, 1);
    return system.y[0];
  };
  CHECK(growth(PredictorCorrector{}) == Approx(1 + 0.5 + 0.125).epsilon(1e-15));
  CHECK(growth(Heun{}) == Approx(1 + 0.5 + 0.125).epsilon(1e-15));
  CHECK(growth(ShuOsher{}) == Approx(1 + 0.5 + 0.125 + 0.125 / 6).epsilon(1e-15));
}
