// SPDX-License-Identifier: MIT
// Gas between two walls, periodic along x, with a hot spot: sphmbs without the examples' support.
#include <cstdio>

#include <sphmbs/sphmbs.hpp>

using namespace sphmbs;
using Gas = sph::RiemannSph<kernels::WendlandC4<2>, riemann::Acoustic, eos::IdealGas>;

void hot_spot() {
  const double dx = 0.02;                                        // [m]
  const geometry::Box<2> box{.lower = {0, 0}, .upper = {1, 1}};  // [m]
  const geometry::Domain<2> domain{.box = box, .periodic = {true, false}};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
  const geometry::Box<2> slab{.lower = {-1, 0}, .upper = {2, 1}};
  const geometry::Ball<2> spot{.centre = {0.5, 0.5}, .radius = 0.1};

  particles::Cloud<2> cloud;  // [kg/m^3], [Pa]
  cloud.add_gas(lattice.points(box - spot, domain), {.rho = 1.2, .p = 1e5}, {dx, 1.8});
  cloud.add_gas(lattice.inner_points(spot, domain), {.rho = 1.2, .p = 2e5}, {dx, 1.8});
  cloud.add_virtual(lattice.points(slab.grown(4 * dx) - slab, domain, 4 * dx),
                    {.rho = 1.2, .p = 1e5}, {dx, 1.8});

  sph::Fluid<Gas> fluid(Gas{.eos = {.gamma = 1.4}}, domain, std::move(cloud));
  run(fluid, time::PredictorCorrector{}, {.until = 1e-3}, no_report, Every(1e-4, [](auto& f) {
        const auto centre = f.sample({0.5, 0.5});
        std::printf("t = %.1e s  p = %.4g Pa  energy of gas and walls %.10g J\n", f.time(),
                    centre.p, f.totals().energy() + f.totals().virtual_internal);
      }));
}

int main() {
  try {
    hot_spot();
  } catch (const Error& error) {  // one sentence: what is wrong, its value, what is allowed
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
