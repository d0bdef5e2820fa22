// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include <sphmbs/mbs/ancf/cable.hpp>

/// Closed forms and exact solutions of rods that cables and beams are compared with.
namespace test {

/// Root of an increasing or decreasing f between two arguments where its sign differs.
template <class F>
double root(double a, double b, F&& f) {
  const bool up = f(b) > 0;
  double m = 0.5 * (a + b);
  for (int k = 0; k < 200 && m != a && m != b; ++k) {
    ((f(m) > 0) == up ? b : a) = m;
    m = 0.5 * (a + b);
  }
  return m;
}

/// Order at which errors fall from a mesh to one `ratio` times as fine.
inline double order(double coarse, double fine, double ratio = 2) {
  return std::log(std::abs(coarse / fine)) / std::log(ratio);
}

/// Inextensible cantilever of unit length with a transverse dead force alpha EI/L^2 at its tip
/// (Bisshopp and Drucker 1945, Quarterly of Applied Mathematics 3).
struct Elastica {
  double shortening, deflection, angle;  // 1 - x, w and the slope's angle at the tip

  explicit Elastica(double alpha) {
    const double quarter = std::numbers::pi / 2;
    const auto modulus = [](double tip) { return std::sqrt(0.5 * (1 + std::sin(tip))); };
    const auto first = [&](double tip) { return std::asin(std::sqrt(0.5) / modulus(tip)); };
    angle = root(1e-9, quarter - 1e-6, [&](double tip) {
      const double k = modulus(tip);
      return std::comp_ellint_1(k) - std::ellint_1(k, first(tip)) - std::sqrt(alpha);
    });
    const double k = modulus(angle);
    shortening = 1 - std::sqrt(2 * std::sin(angle) / alpha);
    deflection =
        1 - 2 * (std::comp_ellint_2(k) - std::ellint_2(k, first(angle))) / std::sqrt(alpha);
  }
};

/// Stretch l = |r'| of a rod with the energy of a `Measure` under the normal force N and the moment
/// M: N = EA (l - 1), or with Green's strain and the geometric curvature
/// N = EA (l^2 - 1) l/2 - M^2 l/(EI).
template <class Measure>
double stretch(double N, double M, double EA, double EI) {
  if constexpr (Measure::curvature_power == 2) return 1 + N / EA;
  const double c = 0.5 * EA + M * M / EI;
  double l = 1 + std::cbrt(std::max(0.0, 2 * N / EA));
  for (int k = 0; k < 30; ++k) l -= (0.5 * EA * l * l * l - c * l - N) / (1.5 * EA * l * l - c);
  return l;
}

/// What a rod without shear is made of, and what it carries: a dead force and a moment at its tip
/// and a dead load per unstretched length.
struct RodLoad {
  double length, EA, EI;
  sphmbs::mbs::Vector<2> force = {0, 0}, line_load = {0, 0};
  double moment = 0;
  double shear_compliance = 0;  // 1/(k GA), with the energy of Reissner's beam (Engineering)
};

/// Planar cantilever, clamped along +x, whose energy is that of `Measure`: what cables of it tend
/// to. With l = |r'| and th' the rate of turning per unstretched length, N and M are dU/dl and
/// dU/dth'; n' = -f, M' = -l t x n and N = n.t are integrated from the tip by the classical
/// Runge-Kutta method, with the tip's angle found by shooting.
template <class Measure>
class ExactRod {
 public:
  explicit ExactRod(const RodLoad& load) : load_(load) {
    const double half_turn = std::numbers::pi;
    const auto at_root = [&](double tip) { return integrated(tip)[0]; };
    const double sign = at_root(0) > 0 ? -1 : 1;
    double end = 0;
    for (int k = 0; k < 40 && sign * at_root(end) < 0; ++k) end += sign * half_turn / 8;
    angle_ = root(end - sign * half_turn / 8, end, at_root);
    const auto y = integrated(angle_);
    tip_ = {-y[2], -y[3]};
  }

  double angle() const { return angle_; }
  const sphmbs::mbs::Vector<2>& tip() const { return tip_; }

 private:
  using Rates = sphmbs::mbs::Vector<4>;  // of th, M, x, y

  // th, M, x and y less those at the tip, at the clamp.
  Rates integrated(double angle) const {
    constexpr int steps = 1000;
    const double h = -load_.length / steps;
    Rates y(angle, load_.moment, 0, 0);
    for (int k = 0; k < steps; ++k) {
      const double s = load_.length + k * h;
      const Rates k1 = rates(s, y), k2 = rates(s + h / 2, y + h / 2 * k1),
                  k3 = rates(s + h / 2, y + h / 2 * k2), k4 = rates(s + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
  }

  Rates rates(double s, const Rates& y) const {
    const sphmbs::mbs::Vector<2> n = load_.force + (load_.length - s) * load_.line_load,
                                 t(std::cos(y[0]), std::sin(y[0]));
    const double l = stretch<Measure>(n.dot(t), y[1], load_.EA, load_.EI);
    const double turning = Measure::curvature_power == 2 ? 1 : l * l;
    const sphmbs::mbs::Vector<2> across(-t[1], t[0]),
        r = l * t + load_.shear_compliance * n.dot(across) * across;
    return {turning * y[1] / load_.EI, -(r[0] * n[1] - r[1] * n[0]), r[0], r[1]};
  }

  RodLoad load_;
  double angle_ = 0;
  sphmbs::mbs::Vector<2> tip_;
};

}  // namespace test
