// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <utility>
#include <vector>

namespace test {

/// Integral of f from a to b by Gauss and Legendre's rule of 20 points, exact for polynomials up to
/// degree 39.
template <class F>
double integral(double a, double b, F&& f) {
  constexpr int n = 20;
  static const auto rule = [] {
    std::vector<std::pair<double, double>> points;
    for (int i = 1; i <= n; ++i) {
      double x = std::cos(3.14159265358979323846 * (i - 0.25) / (n + 0.5));
      double slope = 1;
      for (int newton = 0; newton < 20; ++newton) {
        double before = 1;
        double p = x;
        for (int k = 2; k <= n; ++k)
          before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
        slope = n * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      points.emplace_back(x, 2 / ((1 - x * x) * slope * slope));
    }
    return points;
  }();
  double sum = 0;
  for (const auto& [x, weight] : rule) sum += weight * f((a + b) / 2 + (b - a) / 2 * x);
  return (b - a) / 2 * sum;
}

}  // namespace test
