// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/core/math.hpp>

namespace test {

/// Self-similar blast of an energy set free at one point, line or plane of cold gas (Sedov 1946,
/// Taylor 1950). With xi = r / R(t), R ~ t^(2/(Dim + 2)) and rho = rho0 G, u = R' V, p = rho0 R'^2
/// P the equations of motion are, w = V - xi and R'' R / R'^2 = -Dim/2,
///
///   w G' + G (V' + (Dim - 1) V / xi) = 0,   -Dim/2 V + w V' + P'/G = 0,
///   -Dim P + w P' + gamma P (V' + (Dim - 1) V / xi) = 0,
///
/// integrated inwards from the strong shock at xi = 1.
class Sedov {
 public:
  Sedov(int dim, double gamma) : dim_(dim), gamma_(gamma) {
    Flow y{(gamma + 1) / (gamma - 1), 2 / (gamma + 1), 2 / (gamma + 1)};
    double content = 0;
    for (int i = 0; i <= steps; ++i) {
      const double xi = 1 - i * step;
      density_.push_back(y.G);
      const double end = i == 0 || i == steps ? 0.5 : 1;
      content += end * step * (0.5 * y.G * y.V * y.V + y.P / (gamma - 1)) * std::pow(xi, dim - 1);
      const Flow a = slope(xi, y);
      const Flow b = slope(xi - step / 2, after(y, a, step / 2));
      const Flow c = slope(xi - step / 2, after(y, b, step / 2));
      const Flow d = slope(xi - step, after(y, c, step));
      y = after(after(after(after(y, a, step / 6), b, step / 3), c, step / 3), d, step / 6);
    }
    // Around the centre the pressure is even and all energy internal.
    content += y.P / (gamma - 1) * std::pow(1 - 0.999, dim) / dim;
    const double whole = dim == 1 ? 2 : dim == 2 ? 2 * sphmbs::math::pi : 4 * sphmbs::math::pi;
    alpha_ = whole * content * 4 / ((dim + 2.0) * (dim + 2));
  }

  /// E t^2 / (rho0 R^(Dim + 2)).
  double alpha() const { return alpha_; }

  /// The time at which the shock of a unit energy in gas of unit density has come to a radius [s].
  double time(double radius) const { return std::sqrt(alpha_ * std::pow(radius, dim_ + 2)); }

  /// rho / rho0 at xi = r / R.
  double density(double xi) const {
    if (xi > 1) return 1;
    const double place = std::min((1 - xi) / step, steps - 1e-6);
    const auto i = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(i);
    return (1 - s) * density_[i] + s * density_[i + 1];
  }

 private:
  struct Flow {
    double G, V, P;
  };
  static constexpr int steps = 20000;
  static constexpr double step = 0.999 / steps;  // short of the centre, where the equations end

  /// Rates per way inwards.
  Flow slope(double xi, const Flow& y) const {
    const double w = y.V - xi;
    const double spread = (dim_ - 1) * y.V / xi;
    const double dV = (dim_ * y.P - gamma_ * y.P * spread - 0.5 * dim_ * w * y.G * y.V) /
                      (gamma_ * y.P - w * w * y.G);
    return {y.G * (dV + spread) / w, -dV, y.G * (w * dV - 0.5 * dim_ * y.V)};
  }
  static Flow after(const Flow& y, const Flow& k, double s) {
    return {y.G + s * k.G, y.V + s * k.V, y.P + s * k.P};
  }

  int dim_;
  double gamma_;
  double alpha_ = 0;
  std::vector<double> density_;
};

}  // namespace test
