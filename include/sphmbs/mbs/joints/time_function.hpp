// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::joints {

/// A given function of time with its first two derivatives, for rheonomic conditions. Joints are
/// evaluated in parallel: the three functions may be called by several threads at once.
class TimeFunction {
 public:
  using Function = std::function<double(double)>;  ///< of the time [s]

  /// A constant.
  TimeFunction(double constant = 0) : constant_(constant) {}

  /// A function of the user's own; `differentiated` in dual.hpp finds the derivatives itself.
  /// @throws InvalidInput where one of the three is empty.
  TimeFunction(Function value, Function rate, Function acceleration)
      : value_(std::move(value)), rate_(std::move(rate)), acceleration_(std::move(acceleration)) {
    expects(value_ && rate_ && acceleration_, "time function", "empty",
            "three functions: value, rate and acceleration");
  }

  /// At time t [s].
  double value(double t) const { return value_ ? value_(t) : constant_; }
  /// First derivative at time t [s].
  double rate(double t) const { return value_ ? rate_(t) : 0; }
  /// Second derivative at time t [s].
  double acceleration(double t) const { return value_ ? acceleration_(t) : 0; }
  /// Whether it is a plain number.
  bool constant() const { return !value_; }

  /// @throws InvalidInput unless value, rate and acceleration are finite at t = 0.
  void check() const {
    expects(std::isfinite(value(0)), "value of the time function at t = 0", value(0), "finite");
    expects(std::isfinite(rate(0)), "rate of the time function at t = 0", rate(0), "finite");
    expects(std::isfinite(acceleration(0)), "acceleration of the time function at t = 0",
            acceleration(0), "finite");
  }

 private:
  double constant_ = 0;
  Function value_, rate_, acceleration_;
};

/// start + slope t.
inline TimeFunction linear_in_time(double start, double slope) {
  return {[=](double t) { return start + slope * t; }, [=](double) { return slope; },
          [](double) { return 0.0; }};
}

/// mean + amplitude sin(2 pi frequency t + phase).
struct Sine {
  double amplitude;  ///< half of the way between its extremes
  double frequency;  ///< [Hz]
  double phase = 0;  ///< [rad]
  double mean = 0;   ///< value about which it swings

  /// As a function of time with its derivatives.
  operator TimeFunction() const {
    const double w = 2 * std::numbers::pi * frequency;
    return {[s = *this, w](double t) { return s.mean + s.amplitude * std::sin(w * t + s.phase); },
            [s = *this, w](double t) { return s.amplitude * w * std::cos(w * t + s.phase); },
            [s = *this, w](double t) { return -s.amplitude * w * w * std::sin(w * t + s.phase); }};
  }
};

/// From one value to another with continuous second derivative:
/// s^3 (10 - 15 s + 6 s^2), s = (t - begin) / (end - begin).
struct SmoothStep {
  double from = 0;   ///< value before the change
  double to;         ///< value after it
  double begin = 0;  ///< [s]
  double end;        ///< [s]

  /// @throws InvalidInput unless it ends after it begins.
  operator TimeFunction() const {
    expects(end > begin, "end of the smooth step", end, "after its begin [s]");
    const double h = end - begin, height = to - from;
    const auto share = [b = begin, h](double t) { return std::clamp((t - b) / h, 0.0, 1.0); };
    return {[=, from = from](double t) {
              const double s = share(t);
              return from + height * s * s * s * (10 + s * (6 * s - 15));
            },
            [=](double t) {
              const double s = share(t);
              return height / h * 30 * s * s * (1 - s) * (1 - s);
            },
            [=](double t) {
              const double s = share(t);
              return height / (h * h) * 60 * s * (1 - s) * (1 - 2 * s);
            }};
  }
};

/// f^2.
inline TimeFunction squared(const TimeFunction& f) {
  if (f.constant()) return f.value(0) * f.value(0);
  return {[f](double t) { return f.value(t) * f.value(t); },
          [f](double t) { return 2 * f.value(t) * f.rate(t); },
          [f](double t) { return 2 * (f.rate(t) * f.rate(t) + f.value(t) * f.acceleration(t)); }};
}

/// factor cos(f) or, with phase -pi/2, factor sin(f).
inline TimeFunction cosine_of(const TimeFunction& f, double factor, double phase) {
  if (f.constant()) return factor * std::cos(f.value(0) + phase);
  return {[=](double t) { return factor * std::cos(f.value(t) + phase); },
          [=](double t) { return -factor * std::sin(f.value(t) + phase) * f.rate(t); },
          [=](double t) {
            const double angle = f.value(t) + phase;
            return -factor *
                   (std::cos(angle) * f.rate(t) * f.rate(t) + std::sin(angle) * f.acceleration(t));
          }};
}

/// A point or vector that moves as given, each component by a function of its own.
template <int Dim>
class Path {
 public:
  /// A point at rest.
  Path(const Vector<Dim>& constant = Vector<Dim>::Zero()) {
    for (int k = 0; k < Dim; ++k) along_[static_cast<std::size_t>(k)] = constant[k];
  }
  /// One function, or number, for each component.
  template <class... F>
  requires(sizeof...(F) == Dim &&
           (std::convertible_to<F, TimeFunction> && ...)) explicit Path(F... components)
      : along_{TimeFunction(std::move(components))...} {}

  /// At time t [s].
  Vector<Dim> value(double t) const {
    return each([t](const TimeFunction& f) { return f.value(t); });
  }
  /// Velocity at time t [s].
  Vector<Dim> rate(double t) const {
    return each([t](const TimeFunction& f) { return f.rate(t); });
  }
  /// Acceleration at time t [s].
  Vector<Dim> acceleration(double t) const {
    return each([t](const TimeFunction& f) { return f.acceleration(t); });
  }

  /// @throws InvalidInput as each component does.
  void check() const {
    for (const TimeFunction& f : along_) f.check();
  }

 private:
  template <class Read>
  Vector<Dim> each(Read&& read) const {
    Vector<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = read(along_[static_cast<std::size_t>(k)]);
    return x;
  }

  std::array<TimeFunction, static_cast<std::size_t>(Dim)> along_;
};

}  // namespace sphmbs::mbs::joints
