// SPDX-License-Identifier: MIT
// A free piston between two closed columns of gas, 1 m each, swings on them as on springs; against
// the exact period of small swings, with the gas's own mass. p = rho = 1, gamma 1.4, in 1D.
#include <sphmbs/mbs.hpp>
#include <sphmbs/sphmbs.hpp>

#include "reference/gas_spring_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/gas_parameters.hpp"
#include "support/guarded_main.hpp"
#include "support/piston.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

struct Swing {
  double mass = 10;   // of the piston [kg/m^2]
  double way = 0.01;  // out of the middle at the start, at rest [m]
  double length = 1;  // of each column [m]
  examples::StillGas gas{};

  void add(examples::Parameters& parameters) {
    parameters.add_number("piston.mass", mass, {.above = 0.0}, "kg/m^2", "of the piston", "--mass");
    parameters.add_number("piston.way", way, {.above = 0.0, .at_most = 0.5}, "m",
                          "of the piston out of the middle at the start", "--way");
    parameters.add_number("gas.length", length, {.above = 0.0}, "m", "of each column of gas");
    examples::add_still_gas(parameters, gas);
  }
};

template <class Gas, class T, class Policy>
void gas_spring(const examples::Settings& settings, const Swing& swing, const std::string& coupling,
                Policy policy) {
  const double dx = settings.spacing;
  const double length = swing.length, gamma = swing.gas.gamma;
  const int count = static_cast<int>(std::lround(length / dx));
  examples::require_all(
      {{dx <= length / 10 && std::abs(count * dx - length) < 1e-6 * length, "--spacing", dx,
        "a whole fraction of " + examples::length_text(length) + ", and at most " +
            examples::length_text(length / 10)},
       {swing.way <= length / 2, "piston.way", swing.way,
        "at most half the length of a column, " + examples::length_text(length)}});

  // Where: the piston is as thick as gas sees on both sides, the columns lie beside it.
  const double half = 5 * dx, end = length + half;
  const auto evenly = [](double from, double to, int n) {
    std::vector<Vec<1>> points;
    for (int i = 0; i < n; ++i) points.push_back({from + (i + 0.5) * (to - from) / n});
    return points;
  };
  const geometry::Domain<1> domain{.box = {.lower = {-end - 5 * dx}, .upper = {end + 5 * dx}}};

  // What: both columns compressed or stretched along an isentrope, walls, and the piston, whose
  // virtual particles ride on it.
  particles::Cloud<1> cloud;
  const auto add_column = [&](double from, double to) {
    const double ratio = length / (to - from);
    cloud.add_gas(
        evenly(from, to, count),
        {.rho = swing.gas.density * ratio, .p = swing.gas.pressure * std::pow(ratio, gamma)},
        {(to - from) / count});
  };
  add_column(-end, swing.way - half);
  add_column(swing.way + half, end);
  const auto add_solid = [&](double from, double to, const geometry::Box<1>& solid) {
    const int layers = static_cast<int>(std::lround((to - from) / dx));
    return cloud.add_virtual(evenly(from, to, layers), swing.gas.state<1>(), {dx}, solid);
  };
  add_solid(-end - 5 * dx, -end, {.lower = {-end - 1}, .upper = {-end}});
  add_solid(end, end + 5 * dx, {.lower = {end}, .upper = {end + 1}});
  const double left = swing.way - half, right = swing.way + half;
  const int faces = add_solid(left, right, {.lower = {left}, .upper = {right}});

  mbs::Structure<examples::Piston> structure;
  const auto piston = structure.add(examples::Piston{.mass = swing.mass, .position = swing.way});
  coupling::WettedSurface<1, Policy> surface;
  surface.tie(cloud, faces,
              coupling::points_beside(piston.point({0, 0}), structure.q(), cloud, faces),
              structure.q());
  sph::Fluid<Gas, Policy, coupling::Riding<1>, T> fluid(Gas{.eos = {.gamma = gamma}}, domain,
                                                        std::move(cloud), surface.motion(), policy);
  mbs::Dynamics<decltype(structure), mbs::solvers::SparseLU> bodies(structure);
  coupling::Immersed system(fluid, bodies, surface);

  examples::Session session(settings, "gas_spring", "a piston between two columns of gas", system);
  session.note(
      "gas", "ideal gas gamma " + examples::format_exact(gamma) + "; " + examples::describe<Gas>());
  session.note("piston", examples::format_exact(swing.mass) + " kg/m^2, let go " +
                             examples::format_exact(swing.way) + " m off; coupling " + coupling);
  session.record("way", "m", [&] { return bodies.state().q[0]; });
  session.record("speed", "m/s", [&] { return bodies.state().v[0]; });
  session.record("force", "N", [&] { return fluid.force_on(faces)[0]; });
  session.record("total_energy", "J",
                 [&] { return fluid.totals().energy() + bodies.energies().kinetic; });
  examples::with_coupling(coupling, settings, [&](const auto& scheme) {
    session.run(scheme,
                settings.samples.value_or(std::max(400, static_cast<int>(40 * settings.until))),
                settings.fields.value_or(4));
  });
  examples::compare_with_exact(session, {.mass = swing.mass,
                                         .density = swing.gas.density,
                                         .sound_speed = swing.gas.sound_speed(),
                                         .length = length});
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters(
      {.name = "gas_spring",
       .title = "a piston between two columns of gas",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.01, .until = 62, .cfl = 0.4, .threads = 1},
       .gas = true,
       .structure = true,
       .dim = 1});
  std::string scheme = "best", coupling = "strong";
  Swing swing;
  examples::add_scheme(parameters, scheme);
  examples::add_coupling(parameters, coupling);
  swing.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<1>, sph::SmoothScheme<1>>(
          scheme, [&]<class Gas>() { gas_spring<Gas, T>(s, swing, coupling, policy); });
    });
  });
}
