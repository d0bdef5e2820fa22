// SPDX-License-Identifier: MIT
// Compression of gas in a sealed square cavity whose walls all move inwards (paper, sect. 5.2). At
// --spacing 0.01, the paper's resolution, there are 10 000 gas and 2 100 virtual particles.
#include <sphmbs/sphmbs.hpp>

#include "reference/sealed_cavity_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

template <class Gas, class T, class Policy>
void sealed_cavity(const examples::Settings& settings, Policy policy) {
  const double dx = settings.spacing;
  examples::require(std::abs(1 / dx - std::round(1 / dx)) < 1e-6 && dx <= 0.1, "--spacing", dx,
                    "a whole fraction of the side, 1 m, of at least ten particles");
  examples::require_memory(1 / (dx * dx), dx);
  examples::require(settings.until <= 0.9, "--until", settings.until,
                    "at most 0.9 s: the walls meet at 1 s");

  // Where: a square around the origin; particles lie half a spacing off the walls, which are five
  // layers of virtual particles that contract with the cavity.
  const geometry::Box<2> cavity{.lower = {-0.5, -0.5}, .upper = {0.5, 0.5}};  // [m]
  const geometry::Domain<2> domain{.box = cavity};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = cavity.lower + Vec<2>::all(dx / 2)};
  const boundary::Contraction walls{.length = 1, .speed = 0.5};  // [m], [m/s]

  const particles::State<2> at_rest{.rho = 1.293, .p = 1e4};  // [kg/m^3], [Pa]
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(cavity, domain), at_rest, {dx});
  cloud.add_virtual(lattice.points(cavity.grown(5 * dx) - cavity, domain, 5 * dx), at_rest, {dx},
                    outside(cavity));

  const Gas gas{.eos = {.gamma = 1.4}};
  sph::Fluid<Gas, Policy, boundary::Contraction, T> fluid(gas, domain, std::move(cloud), walls,
                                                          policy);

  examples::Session session(settings, "sealed_cavity", "gas compressed in a sealed cavity", fluid);
  session.note("gas", "2D, ideal gas gamma 1.4; " + examples::describe<Gas>());
  session.probe("centre", {0, 0});
  examples::record_energies(session, fluid);
  session.run(time::PredictorCorrector{}, 80, 8);
  examples::compare_with_reference(session, walls);
  session.finish();
}

int main(int argc, char** argv) {
  examples::CommandLine command_line({.name = "sealed_cavity",
                                      .title = "gas compressed in a sealed cavity",
                                      .backends = examples::backends(),
                                      .precisions = examples::precisions(),
                                      .defaults = {.spacing = 0.02, .until = 0.8, .cfl = 0.4}});
  std::string scheme = "paper";
  examples::add_scheme(command_line, scheme);
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<2>, sph::SmoothScheme<2>>(
          scheme, [&]<class Gas>() { sealed_cavity<Gas, T>(s, policy); });
    });
  });
}
