// SPDX-License-Identifier: MIT
// Somebody else's program whose gas runs on a device, or on the host in its place.
#include <cmath>
#include <cstdio>

#include <sphmbs/execution/openacc.hpp>
#include <sphmbs/sphmbs.hpp>

using namespace sphmbs;

int main() {
  const geometry::Box<2> box{.lower = {0, 0}, .upper = {1, 1}};
  const geometry::Domain<2> domain{.box = box, .periodic = {true, true}};
  particles::Cloud<2> cloud;
  cloud.add_gas(geometry::Lattice<2>{.spacing = 0.05}.points(box, domain), {.rho = 1, .p = 1},
                {0.05});
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.v[i][0] = 0.1 * std::sin(6 * cloud.r[i][1]);
  try {
    sph::Fluid<sph::PaperScheme<2>, execution::OpenACC> fluid({}, domain, std::move(cloud));
    const double before = fluid.totals().energy();
    run(fluid, time::PredictorCorrector{}, {.until = 0.05}, no_report);
    const double after = fluid.totals().energy();
    std::printf("%s: energy %.10g, then %.10g\n", execution::OpenACC::device().name.c_str(), before,
                after);
    return std::abs(after - before) <= 1e-5 * before ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
