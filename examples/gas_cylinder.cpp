// SPDX-License-Identifier: MIT
// Airflow around a circular cylinder in a pipe (paper, sect. 5.1). At --spacing 0.1, the paper's
// resolution, there are 469 567 gas and 14 296 virtual particles.
#include <sphmbs/sphmbs.hpp>

#include "reference/gas_cylinder_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

template <class Gas, class T, class Policy>
void gas_cylinder(const examples::Settings& settings, Policy policy) {
  const double dx = settings.spacing;
  examples::require(dx <= 2 && std::abs(100 / dx - std::round(100 / dx)) < 1e-6, "--spacing", dx,
                    "a whole fraction of the pipe's length, 100 m, and at most 2 m");
  examples::require_memory(5000 / (dx * dx), dx);

  // Where: a pipe, periodic along x, with a cylinder across it.
  const geometry::Box<2> pipe{.lower = {0, 0}, .upper = {100, 50}};                // [m]
  const geometry::Ball<2> cylinder{.centre = {40, 25}, .radius = 10 + 0.01 * dx};  // [m]
  const geometry::Domain<2> domain{.box = pipe, .periodic = {true, false}};
  const geometry::Lattice<2> lattice{.spacing = dx};

  // What: an ideal gas at rest, set in motion by a uniform body force, between two walls of five
  // layers and around a ring of about seven layers. The gas's outermost particles lie on the walls'
  // lines, so that the walls' surface is half a spacing off.
  const particles::State<2> at_rest{.rho = 1, .p = 841};  // [kg/m^3], [Pa]
  const geometry::Box<2> between{.lower = {-100, 0}, .upper = {200, 50}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(pipe - cylinder, domain), at_rest, {dx});
  cloud.add_virtual(lattice.inner_points(between.grown(5.5 * dx) - between, domain, 6 * dx),
                    at_rest, {dx}, outside(between.grown(dx / 2)));
  const int surface = cloud.add_virtual(examples::ring(lattice, domain, cylinder), at_rest, {dx},
                                        geometry::Ball<2>{cylinder.centre, 10});

  Gas gas{.eos = {.gamma = 1.4}, .acceleration = {3, 0}};  // [-], [m/s^2]
  if constexpr (Gas::Wall::surfaces) gas.background = at_rest.p;
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, domain, std::move(cloud), {}, policy);

  examples::Session session(settings, "gas_cylinder", "airflow around a circular cylinder", fluid);
  session.note("gas", "2D, ideal gas gamma 1.4; " + examples::describe<Gas>());
  session.probe("upstream", {25, 25});
  session.probe("above", {40, 40});
  session.probe("downstream", {55, 25});
  session.probe("far", {65, 40});
  session.record("force", "N/m", [&] { return fluid.force_on(surface)[0]; });
  session.run(time::PredictorCorrector{}, 400, 4);
  examples::compare_with_reference(session);
  session.finish();
}

int main(int argc, char** argv) {
  examples::CommandLine command_line({.name = "gas_cylinder",
                                      .title = "airflow around a circular cylinder in a pipe",
                                      .backends = examples::backends(),
                                      .precisions = examples::precisions(),
                                      .defaults = {.spacing = 0.5, .until = 1, .cfl = 0.4}});
  std::string scheme = "paper";
  examples::add_scheme(command_line, scheme);
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<2>, sph::SmoothScheme<2>>(
          scheme, [&]<class Gas>() { gas_cylinder<Gas, T>(s, policy); });
    });
  });
}
