// SPDX-License-Identifier: MIT
// Sedov's blast: energy set free at one point of cold gas, gamma = 1.4. Density is 6 times as high
// behind the shock and next to nothing at the centre.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/sedov.hpp"
#include "support/spherical.hpp"
#include "support/state.hpp"
#include "support/tube.hpp"

namespace {

constexpr double radius = 0.75;  // of the shock at the end [m]

struct Blast {
  double l1;             // sum V |rho - exact| / sum V, r < 1
  double peak;           // of a particle
  double shock;          // outermost radius of half the rise to the densest shell [m]
  double energy;         // in units of what was set free
  double h;              // at first [m]
  bool positive = true;  // densities and energies of all particles
};

/// Unit energy in a box of side 2 and unit density, given to particles by a kernel of the smoothing
/// length 2 spacings: within fewer, the gas of the bubble is coarser than the blast is wide.
template <int Dim, class Gas, class Policy>
Blast explode(int per_side) {
  using Kernel = sphmbs::kernels::QuinticSpline<Dim>;
  const double dx = 2.0 / per_side;
  sphmbs::geometry::Domain<Dim> domain{{sphmbs::Vec<Dim>::all(-1.0), sphmbs::Vec<Dim>::all(1.0)},
                                       {}};
  const sphmbs::geometry::Lattice<Dim> lattice{dx, sphmbs::Vec<Dim>::all(dx / 2)};
  sphmbs::particles::Cloud<Dim> cloud;
  cloud.add_gas(lattice.points(domain.box, domain), {.rho = 1, .p = 1e-5}, {dx});
  const auto share = [&](std::size_t i) {
    return Kernel::shape(std::sqrt(norm2(cloud.r[i])) / (2 * dx));
  };
  double sum = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) sum += share(i);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.p[i] += 0.4 * share(i) / sum / std::pow(dx, Dim);

  const test::Sedov exact(Dim, 1.4);
  sphmbs::sph::Fluid<Gas, Policy> fluid(Gas{.eos = {.gamma = 1.4}}, domain, cloud);
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = exact.time(radius), .cfl = 0.3},
              sphmbs::no_report);
  const auto end = test::state_of(fluid);
  Blast found{};
  found.h = 1.25 * dx;
  for (std::size_t i = 0; i < end.size(); ++i) {
    found.positive = found.positive && end.rho[i] > 0 && end.e[i] > 0;
    found.energy += end.m[i] * (end.e[i] + 0.5 * norm2(end.v[i]));
    found.peak = std::max(found.peak, end.rho[i]);
  }
  found.l1 = test::radial_l1(end, 1.0, [&](double r) { return exact.density(r / radius); });
  const test::Shells<Dim> shells(end, dx / 2);
  found.shock = shells.outermost(0.5 * (1 + shells.peak()));
  std::cout << "Sedov " << Dim << "D, " << per_side << " particles a side: L1(rho) " << found.l1
            << ", peak " << found.peak << ", shock at " << found.shock << " of " << radius << " (h "
            << found.h << "), energy " << found.energy << '\n';
  return found;
}

void check(const Blast& b, double l1, double peak) {
  CHECK(b.positive);
  CHECK(b.l1 <= l1);
  CHECK(b.peak >= peak);
  CHECK(b.peak <= 6);
  CHECK(std::abs(b.shock - radius) < b.h);
  CHECK(b.energy == Approx(1).epsilon(1.5e-3));
}

// With XSPH, since without it L1 stays at 0.20 in 2D at any resolution.
using Plane =
    test::ShockGas<2, sphmbs::riemann::Hllc, sphmbs::reconstruction::VanLeer, sphmbs::sph::Xsph>;

}  // namespace

TEST_CASE("Sedov's solution has its known energy", "[sedov]") {
  CHECK(test::Sedov(1, 1.4).alpha() == Approx(1.077485585).epsilon(1e-5));
  CHECK(test::Sedov(2, 1.4).alpha() == Approx(0.984074017).epsilon(1e-5));
  CHECK(test::Sedov(3, 1.4).alpha() == Approx(0.851071855).epsilon(1e-5));
  CHECK(test::Sedov(3, 5.0 / 3).alpha() == Approx(0.493590150).epsilon(1e-5));
}

// Measured with 32, 64 and 128 particles a side: L1 0.181, 0.155, 0.148, peak 3.37, 4.00, 4.99.
TEST_CASE("Sedov's blast in 2D", "[sedov]") {
  const Blast coarse = explode<2, Plane, sphmbs::execution::Serial>(32);
  check(coarse, 0.19, 3.2);
  const Blast fine = explode<2, Plane, sphmbs::execution::Serial>(64);
  check(fine, 0.163, 3.8);
  CHECK(fine.l1 < 0.9 * coarse.l1);
}

TEST_CASE("Sedov's blast in 2D, finer", "[sedov][slow]") {
  const Blast b = explode<2, Plane, sphmbs::execution::OpenMP>(128);
  check(b, 0.156, 4.7);
}

// Measured with 24 and 32 particles a side: L1 0.238, 0.204, peak 2.66, 3.06.
TEST_CASE("Sedov's blast in 3D", "[sedov][slow]") {
  using Space = test::ShockGas<3>;
  const Blast coarse = explode<3, Space, sphmbs::execution::OpenMP>(24);
  check(coarse, 0.25, 2.5);
  const Blast fine = explode<3, Space, sphmbs::execution::OpenMP>(32);
  check(fine, 0.215, 2.9);
  CHECK(fine.l1 < 0.9 * coarse.l1);
}
