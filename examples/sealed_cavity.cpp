// SPDX-License-Identifier: MIT
// Compression of gas in a sealed square cavity whose walls all move inwards (paper, sect. 5.2). At
// --spacing 0.01, the paper's resolution, there are 10 000 gas and 2 100 virtual particles.
#include <sphmbs/sphmbs.hpp>

#include "reference/sealed_cavity_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_parameters.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/reference_case.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

struct Compression {
  double side = 1;     // of the cavity at the start [m]
  double speed = 0.5;  // of each wall, inwards [m/s]
  examples::StillGas gas{.density = 1.293, .pressure = 1e4};

  double meeting() const { return side / (2 * speed); }  // of the walls [s]
  void add(examples::Parameters& parameters) {
    parameters.add_number("cavity.side", side, {.above = 0.0}, "m", "of the cavity at the start");
    parameters.add_number("cavity.speed", speed, {.above = 0.0}, "m/s", "of each wall, inwards");
    examples::add_still_gas(parameters, gas);
  }
  bool operator==(const Compression&) const = default;
};

template <class Gas, class T, class Policy>
void sealed_cavity(const examples::Settings& settings, const Compression& compression,
                   Policy policy) {
  const double dx = settings.spacing, side = compression.side;
  const double meeting = compression.meeting();
  examples::require_all({{examples::is_whole(side, dx) && dx <= side / 10, "--spacing", dx,
                          "a whole fraction of the side, " + examples::length_text(side) +
                              ", of at least ten particles"},
                         {settings.until <= 0.9 * meeting, "--until", settings.until,
                          "at most " + examples::format_exact(0.9 * meeting) +
                              " s: the walls meet at " + examples::format_exact(meeting) + " s"}});
  examples::require_memory(side * side / (dx * dx), dx);

  // Where: a square around the origin; particles lie half a spacing off the walls, which are five
  // layers of virtual particles that contract with the cavity.
  const geometry::Box<2> cavity{.lower = Vec<2>::all(-side / 2), .upper = Vec<2>::all(side / 2)};
  const geometry::Domain<2> domain{.box = cavity};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = cavity.lower + Vec<2>::all(dx / 2)};
  const boundary::Contraction walls{.length = side, .speed = compression.speed};

  const particles::State<2> at_rest = compression.gas.state<2>();
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(cavity, domain), at_rest, {dx});
  cloud.add_virtual(lattice.points(cavity.grown(5 * dx) - cavity, domain, 5 * dx), at_rest, {dx},
                    outside(cavity));

  const Gas gas{.eos = {.gamma = compression.gas.gamma}};
  sph::Fluid<Gas, Policy, boundary::Contraction, T> fluid(gas, domain, std::move(cloud), walls,
                                                          policy);

  examples::Session session(settings, "sealed_cavity", "gas compressed in a sealed cavity", fluid);
  session.note("gas", "2D, ideal gas gamma " + examples::format_exact(compression.gas.gamma) +
                          "; " + examples::describe<Gas>());
  const bool known = compression == Compression{};
  examples::note_reference(session, known);
  session.probe("centre", {0, 0});
  examples::record_energies(session, fluid);
  session.run(time::PredictorCorrector{}, *settings.samples, *settings.fields);
  examples::compare_if(known, session, [&] { examples::compare_with_reference(session, walls); });
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters(
      {.name = "sealed_cavity",
       .title = "gas compressed in a sealed cavity",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.02, .until = 0.8, .cfl = 0.4, .fields = 8, .samples = 80}});
  std::string scheme = "paper";
  Compression compression;
  examples::add_scheme(parameters, scheme);
  compression.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<2>, sph::SmoothScheme<2>>(
          scheme, [&]<class Gas>() { sealed_cavity<Gas, T>(s, compression, policy); });
    });
  });
}
