// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/riemann/riemann_solver.hpp>

namespace sphmbs::riemann {

/// Density, velocity and pressure of a plane flow.
struct Primitive {
  double rho;  ///< [kg/m^3]
  double u;    ///< [m/s]
  double p;    ///< [Pa]
};

/// Exact solution of the Riemann problem of an ideal gas with an initial jump at x = 0 (Toro 2009,
/// Riemann Solvers and Numerical Methods for Fluid Dynamics, ch. 4). For comparison, on the host.
class ExactSolution {
 public:
  /// @throws InvalidInput for densities or pressures that are not positive, gamma <= 1, or states
  ///         that move apart so fast that vacuum forms.
  ExactSolution(const Primitive& left, const Primitive& right, double gamma)
      : left_(left), right_(right), gamma_(gamma) {
    expects(gamma > 1, "gamma", gamma, "above 1");
    expects(std::min(left.rho, right.rho) > 0, "density", std::min(left.rho, right.rho),
            "positive [kg/m^3]");
    expects(std::min(left.p, right.p) > 0, "pressure", std::min(left.p, right.p), "positive [Pa]");
    const double escape = 2 * (sound(left) + sound(right)) / (gamma - 1);
    expects(right.u - left.u < escape, "velocity jump", right.u - left.u,
            "below " + std::to_string(escape) + " m/s, or vacuum forms");
    solve();
  }

  /// Pressure [Pa] and velocity [m/s] between the two outer waves.
  Star<double> star() const { return star_; }

  /// The flow at x = xi t, for xi in m/s and t > 0.
  Primitive at(double xi) const {
    if (xi < star_.u) return side(left_, xi, -1);
    return side(right_, xi, 1);
  }

 private:
  double sound(const Primitive& s) const { return std::sqrt(gamma_ * s.p / s.rho); }

  // Velocity change across the wave from state s to pressure p, and its derivative.
  Star<double> jump(const Primitive& s, double p) const {
    if (p > s.p) {
      const double A = 2 / ((gamma_ + 1) * s.rho);
      const double B = (gamma_ - 1) / (gamma_ + 1) * s.p;
      const double root = std::sqrt(A / (p + B));
      return {(p - s.p) * root, root * (1 - 0.5 * (p - s.p) / (p + B))};
    }
    const double c = sound(s);
    const double power = (gamma_ - 1) / (2 * gamma_);
    return {2 * c / (gamma_ - 1) * (std::pow(p / s.p, power) - 1),
            std::pow(p / s.p, -(gamma_ + 1) / (2 * gamma_)) / (s.rho * c)};
  }

  void solve() {
    const double c_left = sound(left_);
    const double c_right = sound(right_);
    const double power = (gamma_ - 1) / (2 * gamma_);
    // Two rarefactions: exact when both waves are, a good start otherwise.
    double p =
        std::pow((c_left + c_right - 0.5 * (gamma_ - 1) * (right_.u - left_.u)) /
                     (c_left / std::pow(left_.p, power) + c_right / std::pow(right_.p, power)),
                 1 / power);
    for (int i = 0; i < 100; ++i) {
      const Star<double> a = jump(left_, p);
      const Star<double> b = jump(right_, p);
      const double next = std::max(1e-3 * p, p - (a.p + b.p + right_.u - left_.u) / (a.u + b.u));
      const bool done = std::abs(next - p) <= 1e-15 * p;
      p = next;
      if (done) break;
    }
    star_ = {.p = p, .u = 0.5 * (left_.u + right_.u + jump(right_, p).p - jump(left_, p).p)};
  }

  // The flow on the side of state s; `sign` is -1 for the left side and 1 for the right one.
  Primitive side(const Primitive& s, double xi, double sign) const {
    const double c = sound(s);
    const double ratio = star_.p / s.p;
    const double g = (gamma_ - 1) / (gamma_ + 1);
    if (ratio > 1) {
      const double mach =
          std::sqrt((gamma_ + 1) / (2 * gamma_) * ratio + (gamma_ - 1) / (2 * gamma_));
      if (sign * (xi - s.u) > mach * c) return s;
      return {s.rho * (ratio + g) / (g * ratio + 1), star_.u, star_.p};
    }
    const double c_star = c * std::pow(ratio, (gamma_ - 1) / (2 * gamma_));
    if (sign * (xi - s.u) > c) return s;
    if (sign * (xi - star_.u) < c_star)
      return {s.rho * std::pow(ratio, 1 / gamma_), star_.u, star_.p};
    const double fan = 2 / (gamma_ + 1) + sign * g / c * (xi - s.u);
    const double c_fan = c * fan;
    return {s.rho * std::pow(fan, 2 / (gamma_ - 1)), xi - sign * c_fan,
            s.p * std::pow(fan, 2 * gamma_ / (gamma_ - 1))};
  }

  Primitive left_;
  Primitive right_;
  double gamma_;
  Star<double> star_{};
};

}  // namespace sphmbs::riemann
