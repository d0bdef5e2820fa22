// SPDX-License-Identifier: MIT
// A small sound wave after one period: how much each solver and limiter damps it, and how fast its
// error falls.
#include <cmath>
#include <complex>
#include <cstdio>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/state.hpp"

namespace {

namespace riemann = sphmbs::riemann;
namespace reconstruction = sphmbs::reconstruction;
using sphmbs::sph::NoXsph;
using sphmbs::sph::VolumeForm;
template <class Limiter>
using Muscl = reconstruction::Muscl<Limiter>;

constexpr double heat_ratio = 1.4;
constexpr double k = 2 * sphmbs::math::pi;  // one wave in a unit length
constexpr double amplitude = 1e-4;          // velocity / sound speed

struct Wave {
  double error;      // L2 of the velocity against the exact wave, by the wave's own
  double viscosity;  // decay rate / (k^2 c h) [-]
  double speed;      // by the sound speed [-]
};

/// Sound along x through gas of unit density and sound speed, a strip of `across` particles wide.
/// Particles begin where and as the exact wave has them, so that all that departs from it counts.
template <int Dim, class Riemann, class... Policies>
Wave travel(int along, double smoothing_ratio) {
  const double dx = 1.0 / along;
  // A period must be wider than two supports.
  const int across = Dim == 1 ? 1 : static_cast<int>(std::ceil(6 * smoothing_ratio)) + 2;
  std::vector<sphmbs::Vec<Dim>> points;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      sphmbs::Vec<Dim> x = sphmbs::Vec<Dim>::all((j + 0.5) * dx);
      x[0] = (i + 0.5) * dx;
      points.push_back(x);
    }
  sphmbs::geometry::Domain<Dim> domain{
      {sphmbs::Vec<Dim>::all(0.0), sphmbs::Vec<Dim>::all(across * dx)}, {}};
  domain.box.upper[0] = 1;
  domain.periodic.fill(true);
  sphmbs::particles::Cloud<Dim> cloud;
  cloud.add_gas(points, {.rho = 1, .p = 1 / heat_ratio}, {dx, smoothing_ratio});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double s = amplitude * std::cos(k * points[i][0]);
    cloud.r[i][0] -= amplitude / k * std::sin(k * points[i][0]);
    cloud.v[i][0] = s;
    cloud.rho[i] *= 1 + s;
    cloud.p[i] *= 1 + heat_ratio * s;
    cloud.h[i] *= 1 - s / Dim;
  }
  using Gas = sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<Dim>, Riemann,
                                      sphmbs::eos::IdealGas, Policies...>;
  sphmbs::sph::Fluid<Gas, sphmbs::execution::Serial> fluid(Gas{.eos = {.gamma = heat_ratio}},
                                                           domain, cloud);
  const int steps = 4 * along;  // of third order: nothing of what is measured
  test::take_steps(fluid, sphmbs::time::ShuOsher{}, steps, 1.0 / steps);
  const auto end = test::state_of(fluid);
  double square = 0;
  std::complex<double> component = 0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    const double x = points[i][0];
    const double u = end.v[i][0] / amplitude;
    square += std::pow(u - std::cos(k * x), 2);
    component += u * std::polar(1.0, -k * x);
  }
  const auto mean = 2 / static_cast<double>(end.size());
  component *= mean;
  const double h = smoothing_ratio * dx;
  return {std::sqrt(mean * square), -std::log(std::abs(component)) / (k * k * h),
          1 - std::arg(component) / k};
}

/// Prints and returns the wave of a choice at 64 particles a wave and the paper's smoothing ratio.
template <int Dim, class Riemann, class... Policies>
Wave row(const char* solver, const char* limiter) {
  const Wave w = travel<Dim, Riemann, Policies...>(64, 1.25);
  std::printf("sound %dD, %-15s %-14s viscosity / (c h) %9.2e, speed / c - 1 %9.2e, L2 %9.2e\n",
              Dim, solver, limiter, w.viscosity, w.speed - 1, w.error);
  return w;
}

/// Every limiter of a solver: at least so many times less viscous than the plain acoustic one.
template <int Dim, class Riemann>
void check_limiters(const char* solver, double plain) {
  using namespace reconstruction;
  CAPTURE(Dim, solver, plain);
  const Wave van_leer = row<Dim, Riemann, VolumeForm, NoXsph, Muscl<VanLeer>>(solver, "VanLeer");
  const Wave minmod = row<Dim, Riemann, VolumeForm, NoXsph, Muscl<Minmod>>(solver, "Minmod");
  const Wave particle =
      row<Dim, Riemann, VolumeForm, NoXsph, Muscl<BarthJespersen>>(solver, "BarthJespersen");
  const Wave none = row<Dim, Riemann, VolumeForm, NoXsph, Muscl<Unlimited>>(solver, "Unlimited");
  CHECK(van_leer.viscosity < plain / 50);
  CHECK(minmod.viscosity < plain / 10);
  CHECK(particle.viscosity < plain / 40);
  CHECK(none.viscosity < plain / 100);
  for (const Wave& w : {van_leer, minmod, particle, none}) {
    CHECK(w.viscosity > 0);
    CHECK(std::abs(w.speed - 1) < 0.005);
  }
}

/// The order of the error over three resolutions, each half as coarse as the one before.
template <int Dim, class... Policies>
double order(const char* name, int coarsest, double smoothing_ratio) {
  double error[3];
  for (int i = 0; i < 3; ++i) {
    error[i] = travel<Dim, riemann::Acoustic, Policies...>(coarsest << i, smoothing_ratio).error;
    std::printf("sound %dD, %s, h = %.2f spacings, %d particles a wave: L2 %.3e\n", Dim, name,
                smoothing_ratio, coarsest << i, error[i]);
  }
  return std::log2(error[0] / error[2]) / 2;
}

}  // namespace

TEST_CASE("slopes lower the damping of sound in 1D", "[sound]") {
  const Wave plain = row<1, riemann::Acoustic>("Acoustic", "none");
  CHECK(plain.viscosity == Approx(0.167).epsilon(0.02));
  CHECK(row<1, riemann::Hllc>("Hllc", "none").viscosity == Approx(plain.viscosity).epsilon(0.01));
  CHECK(row<1, riemann::Exact>("Exact", "none").viscosity == Approx(plain.viscosity).epsilon(0.01));
  CHECK(row<1, riemann::LimitedAcoustic>("LimitedAcoustic", "none").viscosity <
        plain.viscosity / 1000);
  check_limiters<1, riemann::Acoustic>("Acoustic", plain.viscosity);
  check_limiters<1, riemann::Hllc>("Hllc", plain.viscosity);
  check_limiters<1, riemann::Exact>("Exact", plain.viscosity);
}

TEST_CASE("slopes lower the damping of sound in 2D", "[sound]") {
  const Wave plain = row<2, riemann::Acoustic>("Acoustic", "none");
  CHECK(plain.viscosity == Approx(0.112).epsilon(0.02));
  CHECK(row<2, riemann::LimitedAcoustic>("LimitedAcoustic", "none").viscosity <
        plain.viscosity / 500);
  check_limiters<2, riemann::Acoustic>("Acoustic", plain.viscosity);
}

// At the paper's 1.25 spacings the sums over a lattice are off by 2e-4 to 1e-3, and so is the speed
// of sound at any resolution: the error stops there. Two spacings leave the order of the method.
// Measured: 1.98 in 1D and 1.93 in 2D with VanLeer, 1.0 without slopes.
TEST_CASE("sound with slopes converges at second order", "[sound]") {
  using reconstruction::VanLeer;
  CHECK(order<1, VolumeForm, NoXsph, Muscl<VanLeer>>("VanLeer", 64, 2) >= 1.92);
  CHECK(order<1, VolumeForm, NoXsph>("without slopes", 64, 2) < 1.1);
}

TEST_CASE("sound with slopes converges at second order in 2D", "[sound][slow]") {
  CHECK(order<2, VolumeForm, NoXsph, Muscl<reconstruction::VanLeer>>("VanLeer", 48, 2) >= 1.85);
}

// What a lattice cannot do. If a change makes this better, tighten it.
TEST_CASE("the error of sound stops at the sums over a lattice", "[sound]") {
  using reconstruction::VanLeer;
  CHECK(order<1, VolumeForm, NoXsph, Muscl<VanLeer>>("VanLeer", 64, 1.25) < 1.6);
}
