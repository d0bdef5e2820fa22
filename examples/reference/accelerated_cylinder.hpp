// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sphmbs::examples {

/// Force on a cylinder at times c t / R = 0, 0.1, ... 10 after the start of a constant
/// acceleration, by displaced mass and acceleration. Linear acoustics: the inverse Laplace
/// transform of K1(s) / (s (s K0(s) + K1(s))), by Stehfest's method with 26 terms in 50 digits.
inline constexpr std::array<double, 101> cylinder_step_response{
    0.000000, 0.097482, 0.189873, 0.277131, 0.359259, 0.436302, 0.508335, 0.575462, 0.637810,
    0.695525, 0.748767, 0.797711, 0.842537, 0.883433, 0.920592, 0.954209, 0.984479, 1.011595,
    1.035750, 1.057132, 1.075925, 1.092310, 1.106459, 1.118542, 1.128718, 1.137143, 1.143964,
    1.149321, 1.153348, 1.156171, 1.157908, 1.158672, 1.158567, 1.157690, 1.156135, 1.153984,
    1.151318, 1.148208, 1.144723, 1.140923, 1.136865, 1.132600, 1.128176, 1.123634, 1.119012,
    1.114345, 1.109664, 1.104995, 1.100362, 1.095787, 1.091287, 1.086878, 1.082574, 1.078386,
    1.074324, 1.070393, 1.066601, 1.062952, 1.059449, 1.056093, 1.052886, 1.049828, 1.046917,
    1.044151, 1.041529, 1.039047, 1.036702, 1.034491, 1.032409, 1.030452, 1.028616, 1.026895,
    1.025286, 1.023782, 1.022380, 1.021075, 1.019861, 1.018733, 1.017688, 1.016720, 1.015825,
    1.014999, 1.014237, 1.013535, 1.012889, 1.012296, 1.011752, 1.011253, 1.010796, 1.010377,
    1.009995, 1.009646, 1.009327, 1.009036, 1.008770, 1.008528, 1.008307, 1.008105, 1.007921,
    1.007753, 1.007599,
};

/// The same between these times.
inline double step_response(double t) {
  const double place = std::clamp(10 * t, 0.0, 100.0);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), 99);
  const double share = place - static_cast<double>(i);
  return (1 - share) * cylinder_step_response[i] + share * cylinder_step_response[i + 1];
}

/// Speed of a free cylinder after an impulse, by its first speed: what the gas has taken up by a
/// time is the mass that it displaces times the integral of f(t - s) dV(s), f being the response to
/// a step. In the long run m / (m + m').
class ImpulsiveStart {
 public:
  /// @param mass_ratio  of the cylinder to the gas in its place
  explicit ImpulsiveStart(double mass_ratio) {
    speed_.push_back(1);
    // Midpoints of the response, so that each new speed follows from those before it.
    for (std::size_t n = 1; n <= 2000; ++n) {
      double taken = step_response(at(n));
      for (std::size_t k = 1; k < n; ++k)
        taken += step_response(at(n) - at(k) + step / 2) * (speed_[k] - speed_[k - 1]);
      const double last = step_response(step / 2);
      speed_.push_back((mass_ratio - taken + last * speed_[n - 1]) / (mass_ratio + last));
    }
  }

  double speed(double t) const {
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(t / step), speed_.size() - 2);
    const double share = t / step - static_cast<double>(i);
    return (1 - share) * speed_[i] + share * speed_[i + 1];
  }

 private:
  static constexpr double step = 0.005;
  static double at(std::size_t n) { return static_cast<double>(n) * step; }
  std::vector<double> speed_;
};

}  // namespace sphmbs::examples
