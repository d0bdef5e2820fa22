// SPDX-License-Identifier: MIT
// The smallest program with gas.
#include <sphmbs/sphmbs.hpp>
using namespace sphmbs;

int main() {
  const geometry::Box<2> box{.lower = {0, 0}, .upper = {1, 1}};
  const geometry::Domain<2> domain{.box = box, .periodic = {true, true}};
  particles::Cloud<2> cloud;
  cloud.add_gas(geometry::Lattice<2>{.spacing = 0.1}.points(box, domain), {.rho = 1, .p = 1},
                {0.1});
  sph::Fluid<sph::PaperScheme<2>> fluid({}, domain, std::move(cloud));
  run(fluid, time::PredictorCorrector{}, {.until = 0.01}, no_report);
}
