// SPDX-License-Identifier: MIT
// Sod's shock tube against the exact solution at t = 0.2, with the paper's scheme.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "reference/shock_tube_curves.hpp"
#include "support/catch.hpp"
#include "support/rates.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::examples::SodTube;

constexpr double until = 0.2;

/// The gas particles at the end of a run.
template <int Dim>
struct Profile {
  test::State<Dim> end;
  std::vector<std::size_t> gas;  // their places in `end`

  double x(std::size_t i) const { return end.r[i][0]; }
  double volume(std::size_t i) const { return end.m[i] / end.rho[i]; }
};

template <int Dim, class Policy>
Profile<Dim> run(double spacing) {
  const SodTube<Dim> tube(spacing);
  sphmbs::particles::Cloud<Dim> cloud;
  tube.fill(cloud);
  const test::Gas<Dim> gas{.eos = {.gamma = SodTube<Dim>::gamma}};
  sphmbs::sph::Fluid<test::Gas<Dim>, Policy> fluid(gas, tube.domain(), cloud);
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = until, .cfl = 0.25},
              [](const auto&, const sphmbs::sph::StepLimit&) {});
  Profile<Dim> profile{test::state_of(fluid), {}};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.set[i] == sphmbs::particles::gas) profile.gas.push_back(i);
  return profile;
}

/// sum V |rho - rho_other(x)| / sum V.
template <int Dim, class Other>
double l1(const Profile<Dim>& profile, Other&& other) {
  double sum = 0;
  double volume = 0;
  for (const std::size_t i : profile.gas) {
    sum += profile.volume(i) * std::abs(profile.end.rho[i] - other(profile.x(i)));
    volume += profile.volume(i);
  }
  return sum / volume;
}

double exact_density(double x) {
  static const sphmbs::riemann::ExactSolution solution(SodTube<1>::left, SodTube<1>::right,
                                                       SodTube<1>::gamma);
  return solution.at((x - SodTube<1>::jump) / until).rho;
}

/// The density of a line of particles, linear in between.
struct Line {
  explicit Line(const Profile<1>& profile) {
    for (const std::size_t i : profile.gas) points.emplace_back(profile.x(i), profile.end.rho[i]);
    std::sort(points.begin(), points.end());
  }
  double operator()(double x) const {
    if (x <= points.front().first) return points.front().second;
    if (x >= points.back().first) return points.back().second;
    const auto b = std::lower_bound(points.begin(), points.end(), std::pair(x, 0.0));
    const auto a = b - 1;
    const double s = (x - a->first) / (b->first - a->first);
    return (1 - s) * a->second + s * b->second;
  }
  std::vector<std::pair<double, double>> points;
};

}  // namespace

TEST_CASE("Sod's tube in 1D converges to the exact solution", "[sod]") {
  // 100 to 800 particles, of which 89 / 100 lie on the dense side. The bounds are what the scheme
  // is specified to reach. The order falls with the spacing, as a part of the error stays: see
  // below.
  const int dense[] = {89, 178, 356, 712};
  const double bound[] = {2.2e-2, 1.3e-2, 7.8e-3, 4.5e-3};
  double error[4];
  for (int level = 0; level < 4; ++level) {
    const auto profile = run<1, sphmbs::execution::Serial>(0.5 / dense[level]);
    error[level] = l1(profile, exact_density);
    std::cout << "Sod 1D, " << profile.gas.size() << " particles: L1(rho) " << error[level];
    if (level > 0) std::cout << ", order " << std::log2(error[level - 1] / error[level]);
    std::cout << '\n';
    CAPTURE(dense[level]);
    CHECK(error[level] <= bound[level]);
  }
  CHECK(std::log2(error[0] / error[1]) >= 0.7);
  CHECK(std::log2(error[1] / error[2]) >= 0.7);
  CHECK(std::log2(error[0] / error[3]) / 3 >= 0.7);
}

// What the paper's scheme cannot do. A shock is as few smoothing lengths wide at any resolution,
// and across it the density that eq. (20) integrates and the one at which particles lie part: the
// diffusion of the star states acts on the first alone. The gas behind is left 3 % too dense and at
// 3 % too high a pressure, with the right velocity, and the L1 error cannot fall below 1.2e-3. If a
// change makes this better, tighten it.
TEST_CASE("the gas behind Sod's shock is off by some per cent at any resolution", "[sod]") {
  const sphmbs::riemann::ExactSolution exact(SodTube<1>::left, SodTube<1>::right,
                                             SodTube<1>::gamma);
  for (const int dense : {712, 1424}) {
    const auto profile = run<1, sphmbs::execution::Serial>(0.5 / dense);
    double rho = 0, u = 0, p = 0, lying = 0, volume = 0, first = 1, last = 0, mass = 0;
    for (const std::size_t i : profile.gas) {
      const double x = profile.x(i);  // in the middle between contact and shock
      if (x < 0.77 || x > 0.82) continue;
      const double V = profile.volume(i);
      volume += V;
      rho += V * profile.end.rho[i];
      u += V * profile.end.v[i][0];
      p += V * (SodTube<1>::gamma - 1) * profile.end.rho[i] * profile.end.e[i];
      mass += profile.end.m[i];
      first = std::min(first, x);
      last = std::max(last, x);
    }
    REQUIRE(volume > 0);
    const auto count = mass / profile.end.m[profile.gas.back()];
    lying = mass * (count - 1) / count / (last - first);
    const double want = exact.at((0.795 - SodTube<1>::jump) / until).rho;
    std::cout << "Sod 1D, spacing 0.5/" << dense << ", behind the shock / exact: rho "
              << rho / volume / want << ", u " << u / volume / exact.star().u << ", p "
              << p / volume / exact.star().p << ", density at which they lie " << lying / want
              << '\n';
    CHECK(std::abs(rho / volume / want - 1) < 0.035);
    CHECK(std::abs(p / volume / exact.star().p - 1) < 0.035);
    CHECK(std::abs(lying / want - 1) < 0.015);
    CHECK(std::abs(u / volume / exact.star().u - 1) < 0.005);
  }
}

TEST_CASE("Sod's tube in 2D has the profile of 1D", "[sod]") {
  const double spacing = 0.5 / 89;
  const auto plane = run<2, sphmbs::execution::Serial>(spacing);
  const auto line = run<1, sphmbs::execution::Serial>(spacing);
  const double error = l1(plane, exact_density);
  const double line_error = l1(line, exact_density);
  const double difference = l1(plane, Line(line));
  std::cout << "Sod 2D, spacing 0.5/89: L1(rho) " << error << " (1D " << line_error
            << "), against 1D " << difference << '\n';
  // In the plane the thin side's particles are closer along the tube, so that both differ by a
  // share of the error of the coarser one, and the plane is nearer to the exact solution.
  CHECK(error <= line_error);
  CHECK(difference <= 0.5 * line_error);
}

TEST_CASE("Sod's tube in 3D has the profile of 1D", "[sod][slow]") {
  const double spacing = 0.5 / 40;
  const auto space = run<3, sphmbs::execution::OpenMP>(spacing);
  const auto line = run<1, sphmbs::execution::Serial>(spacing);
  const double error = l1(space, exact_density);
  const double line_error = l1(line, exact_density);
  const double difference = l1(space, Line(line));
  std::cout << "Sod 3D, spacing 0.5/40: L1(rho) " << error << " (1D " << line_error
            << "), against 1D " << difference << '\n';
  CHECK(error <= line_error);
  CHECK(difference <= 0.5 * line_error);
}
