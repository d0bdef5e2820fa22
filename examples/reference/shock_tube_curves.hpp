// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <sphmbs/geometry/box.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/geometry/shape.hpp>
#include <sphmbs/particles/cloud.hpp>
#include <sphmbs/riemann/exact_solution.hpp>

#include "support/gas_session.hpp"

namespace sphmbs::examples {

/// Gas at rest on both sides of the jump, Sod's without any other choice.
struct TubeStates {
  riemann::Primitive left{1, 0, 1};
  riemann::Primitive right{0.125, 0, 0.1};
  double gamma = 1.4;
};

/// Initial particles of Sod's problem on 0 <= x <= 1 with the jump at 0.5.
template <int Dim>
class SodTube {
 public:
  static constexpr riemann::Primitive left{1, 0, 1};
  static constexpr riemann::Primitive right{0.125, 0, 0.1};
  static constexpr double gamma = 1.4;
  static constexpr double jump = 0.5;

  /// @param spacing  on the dense side; rounded so that whole particles fit [m]
  explicit SodTube(double spacing, const TubeStates& states = {})
      : states_(states),
        dense_(std::lround(jump / spacing)),
        across_(Dim == 1 ? 1 : 24),
        sparse_across_(
            Dim == 1 ? 1 : std::max(1L, std::lround(static_cast<double>(across_) * shrinkage()))) {
    dx_ = jump / static_cast<double>(dense_);
    width_ = Dim == 1 ? 1 : static_cast<double>(across_) * dx_;
    const double ratio =
        std::pow(static_cast<double>(across_) / static_cast<double>(sparse_across_), Dim - 1);
    sparse_ = std::max(1L, std::lround(rarity() * static_cast<double>(dense_) * ratio));
  }

  geometry::Domain<Dim> domain() const {
    geometry::Domain<Dim> d;
    for (int k = 0; k < Dim; ++k) {
      d.box.lower[k] = 0;
      d.box.upper[k] = k == 0 ? 1 : width_;
      d.periodic[static_cast<std::size_t>(k)] = k > 0;
    }
    return d;
  }

  /// Gas particles along the tube's axis, both sides together.
  long along() const { return dense_ + sparse_; }
  const TubeStates& states() const { return states_; }

  /// Adds gas and, beyond both ends, five layers of virtual particles.
  void fill(particles::Cloud<Dim>& cloud) const {
    half(cloud, states_.left, dense_, across_, 0, jump);
    half(cloud, states_.right, sparse_, sparse_across_, jump, 1);
  }

 private:
  /// Of densities, right by left [-].
  double rarity() const { return states_.right.rho / states_.left.rho; }
  /// Particles across the tube on the right, by those on the left [-].
  double shrinkage() const { return std::pow(rarity(), 1.0 / Dim); }

  void half(particles::Cloud<Dim>& cloud, const riemann::Primitive& state, long n, long across,
            double from, double to) const {
    const double step = (to - from) / static_cast<double>(n);
    const double side = width_ / static_cast<double>(across);
    std::vector<Vec<Dim>> gas, wall;
    for (long i = from > 0 ? 0 : -5; i < (from > 0 ? n + 5 : n); ++i)
      for (long j = 0; j < (Dim > 1 ? across : 1); ++j)
        for (long k = 0; k < (Dim > 2 ? across : 1); ++k) {
          Vec<Dim> x;
          x[0] = from + (static_cast<double>(i) + 0.5) * step;
          if constexpr (Dim > 1) x[1] = (static_cast<double>(j) + 0.5) * side;
          if constexpr (Dim > 2) x[2] = (static_cast<double>(k) + 0.5) * side;
          (i >= 0 && i < n ? gas : wall).push_back(x);
        }
    // The volume of a particle is step * side^(Dim-1), of which the resolution is the cube's edge.
    const double edge = Dim == 1 ? step : std::pow(step * std::pow(side, Dim - 1), 1.0 / Dim);
    const particles::State<Dim> s{.rho = state.rho, .p = state.p};
    cloud.add_gas(gas, s, {edge});
    geometry::Box<Dim> tube{.lower = Vec<Dim>::all(-1e3), .upper = Vec<Dim>::all(1e3)};
    tube.lower[0] = 0;
    tube.upper[0] = 1;
    cloud.add_virtual(wall, s, {edge}, outside(tube));
  }

  TubeStates states_;
  long dense_;
  long across_;
  long sparse_across_;
  long sparse_ = 0;
  double dx_ = 0;
  double width_ = 0;
};

/// Volume-weighted L1 error of the density, sum V_a |rho_a - rho(x_a)| / sum V_a * 1 m with
/// V = m / rho over the gas particles, and the picture of the profiles.
template <class Fluid, int Dim>
void compare_with_exact(Session<Fluid>& session, Fluid& fluid, const SodTube<Dim>& tube) {
  using Tube = SodTube<Dim>;
  using Policy = typename Fluid::PolicyType;
  const TubeStates& states = tube.states();
  const riemann::ExactSolution exact(states.left, states.right, states.gamma);
  const double t = fluid.time();
  const auto fields = fluid.particles().fields();
  const std::size_t n = fluid.size();
  const auto x = download<Policy>(fields.r[0], n);
  const auto u = download<Policy>(fields.v[0], n);
  const auto rho = download<Policy>(fields.rho, n);
  const auto e = download<Policy>(fields.e, n);
  const auto m = download<Policy>(fields.m, n);
  const auto set = download<Policy>(fields.set, n);

  double error = 0, error_u = 0, error_p = 0, volume = 0;
  Curve points[3];
  for (std::size_t i = 0; i < n; ++i) {
    if (set[i] != particles::gas) continue;
    const double p = fluid.scheme().eos.pressure(rho[i], e[i]);
    const auto want = exact.at((x[i] - Tube::jump) / t);
    error += m[i] / rho[i] * std::abs(rho[i] - want.rho);
    error_u += m[i] / rho[i] * std::abs(u[i] - want.u);
    error_p += m[i] / rho[i] * std::abs(p - want.p);
    volume += m[i] / rho[i];
    const double value[3] = {rho[i], u[i], p};
    for (int k = 0; k < 3; ++k) {
      points[k].x.push_back(x[i]);
      points[k].y.push_back(value[k]);
    }
  }
  session.result("particles_along", static_cast<double>(tube.along()), std::nullopt, "-");
  session.result("L1_density", error / volume, 0.0, "kg/m3");
  session.result("L1_velocity", error_u / volume, 0.0, "m/s");
  session.result("L1_pressure", error_p / volume, 0.0, "Pa");

  const char* labels[3] = {"density [kg/m³]", "velocity [m/s]", "pressure [Pa]"};
  std::vector<Panel> panels(3);
  for (int k = 0; k < 3; ++k) {
    Curve line{.label = "exact"};
    for (int i = 0; i <= 1000; ++i) {
      const auto want = exact.at((0.001 * i - Tube::jump) / t);
      line.x.push_back(0.001 * i);
      line.y.push_back(k == 0 ? want.rho : k == 1 ? want.u : want.p);
    }
    line.reference = true;
    points[k].label = "sphmbs";
    points[k].style = {.line = Line::none, .marker = Marker::dot};
    panels[static_cast<std::size_t>(k)] = {
        .x_label = "x [m]", .y_label = labels[k], .curves = {points[k], line}};
  }
  session.curves("profiles",
                 "Sod's shock tube, " + std::to_string(tube.along()) +
                     " particles along the tube, t = " + format_number(t) + " s",
                 panels, 3);
}

}  // namespace sphmbs::examples
