// SPDX-License-Identifier: MIT
// Sod's shock tube in SHOCK_TUBE_DIM = 1, 2 or 3 dimensions, against the exact solution: left
// (rho, u, p) = (1, 0, 1), right (0.125, 0, 0.1), gamma 1.4, compared at t = 0.2.
#include <sphmbs/sphmbs.hpp>

#include "reference/shock_tube_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"

using namespace sphmbs;
constexpr int dim = SHOCK_TUBE_DIM;
const std::string case_name = dim == 1 ? "shock_tube" : "shock_tube_" + std::to_string(dim) + "d";

template <class Smoothing, class Policy>
void shock_tube(const examples::Settings& settings, Policy policy) {
  using Gas =
      sph::RiemannSph<kernels::QuinticSpline<dim>, riemann::Acoustic, eos::IdealGas, Smoothing>;
  const double dx = settings.spacing;
  examples::require(dx <= 0.025, "--spacing", dx, "at most 0.025 m, a fortieth of the tube");
  examples::require_memory(std::pow(24, dim - 1) / dx, dx);

  // Particles of (nearly) equal mass on both sides, so that the right ones are wider apart; the
  // tube is as wide as its periodic sides ask for, and ends in fixed walls of virtual particles.
  const examples::SodTube<dim> tube(dx);
  particles::Cloud<dim> cloud;
  tube.fill(cloud);

  const Gas gas{.eos = {.gamma = 1.4}};
  sph::Fluid<Gas, Policy> fluid(gas, tube.domain(), std::move(cloud), {}, policy);

  examples::Session session(settings, case_name, "Sod's shock tube in " + std::to_string(dim) + "D",
                            fluid);
  session.note("gas",
               std::string("ideal gas gamma 1.4, quintic spline, acoustic Riemann solver, ") +
                   (Smoothing::acts ? "XSPH 0.5" : "no XSPH"));
  session.record("energy", "J", [&] { return fluid.totals().energy(); });
  session.run(time::PredictorCorrector{}, 20, 4);
  examples::compare_with_exact(session, fluid, tube);
  session.finish();
}

int main(int argc, char** argv) {
  examples::CommandLine command_line(
      {.name = case_name,
       .title = "Sod's shock tube in " + std::to_string(dim) + "D",
       .backends = examples::backends(),
       .defaults = {.spacing = dim == 1 ? 0.5 / 356 : 0.5 / 128, .until = 0.2, .cfl = 0.4}});
  bool no_xsph = false;
  command_line.add_flag("--no-xsph", no_xsph, "move particles with their own velocities");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&](const auto& s, auto policy) {
      if (no_xsph)
        shock_tube<sph::NoXsph>(s, policy);
      else
        shock_tube<sph::Xsph>(s, policy);
    });
  });
}
