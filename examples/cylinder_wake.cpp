// SPDX-License-Identifier: MIT
// A circular cylinder across a stream, whose wake sheds vortices in turn from its two sides. The
// stream comes in and goes out by openings; along y the cylinder repeats itself.
#include <sphmbs/sphmbs.hpp>

#include "reference/cylinder_wake_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_parameters.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

/// Lengths are in diameters of the cylinder and speeds in that of the stream, by D = 1 m, U = 1
/// m/s.
struct Wake {
  double reynolds = 100;
  double mach = 0.2;
  double upstream = 6;     // from the inlet to the cylinder [m]
  double downstream = 14;  // from the cylinder to the outlet [m]
  double width = 20;       // from one cylinder to the next [m]
  double gamma = 1.4;
  double vortex_strength = 0.4;  // of the start [m^2/s]
  double vortex_radius = 0.7;    // [m]
  Vec<2> vortex_place{2, 0};     // [m]

  void add(examples::Parameters& parameters) {
    parameters.add_number("stream.reynolds", reynolds, {.above = 0.0, .at_most = 200.0}, "",
                          "speed times diameter by kinematic viscosity", "--reynolds");
    parameters.add_number("stream.mach", mach, {.at_least = 0.05, .at_most = 0.5}, "",
                          "speed by that of sound", "--mach");
    parameters.add_number("stream.width", width, {.at_least = 4.0}, "m",
                          "from one cylinder to the next", "--width");
    parameters.add_number("stream.upstream", upstream, {.at_least = 2.0}, "m",
                          "from the inlet to the cylinder");
    parameters.add_number("stream.downstream", downstream, {.at_least = 4.0}, "m",
                          "from the cylinder to the outlet");
    examples::add_gamma(parameters, gamma);
    parameters.add_number("vortex.strength", vortex_strength, {}, "m^2/s",
                          "of the vortex behind the cylinder at the start");
    parameters.add_number("vortex.radius", vortex_radius, {.above = 0.0}, "m",
                          "of the vortex at the start");
    parameters.add_vector("vortex.place", vortex_place, {}, "m", "of the vortex at the start");
  }
};

/// Frictionless stream of speed 1 m/s around the cylinder with a vortex behind it, which spares the
/// long time in which a wake loses its symmetry. Pressure and density fit the speeds, so that
/// little sound is made by the start.
particles::State<2> start(const Wake& wake, const particles::State<2>& far, const Vec<2>& r) {
  const double square = norm2(r), a = 0.25 / (square * square);
  const Vec<2> around{1 - a * (r[0] * r[0] - r[1] * r[1]), -2 * a * r[0] * r[1]};
  const double strength = wake.vortex_strength, radius = wake.vortex_radius;
  const Vec<2> d = (1 / radius) * (r - wake.vortex_place);
  const double psi = strength * std::exp(-norm2(d));
  particles::State<2> state = far;
  state.v = around + (2 / radius * psi) * Vec<2>{-d[1], d[0]};
  state.p += 0.5 * far.rho * (1 - norm2(around)) - far.rho * math::power<2>(psi / radius);
  state.rho *= std::pow(state.p / far.p, 1 / wake.gamma);
  return state;
}

template <class Gas, class T, class Policy>
void cylinder_wake(const examples::Settings& settings, const Wake& wake, Policy policy) {
  const double dx = settings.spacing;
  for (const double length : {wake.upstream, wake.downstream, wake.width})
    examples::require(dx <= 0.25 && std::abs(length / dx - std::round(length / dx)) < 1e-6,
                      "--spacing", dx, "a whole fraction of all lengths, and at most 0.25 m");
  examples::require_memory((wake.upstream + wake.downstream) * wake.width / (dx * dx), dx);

  // Where: a stretch of the stream between two openings, one support deep.
  const double depth = 4 * dx;
  const geometry::Box<2> stretch{.lower = {-wake.upstream, -wake.width / 2},
                                 .upper = {wake.downstream, wake.width / 2}};
  const geometry::Domain<2> domain{
      .box = {stretch.lower - Vec<2>{depth, 0}, stretch.upper + Vec<2>{depth, 0}},
      .periodic = {false, true}};
  const geometry::Box<2> inlet{.lower = domain.box.lower,
                               .upper = {stretch.lower[0], stretch.upper[1]}};
  const geometry::Box<2> outlet{.lower = {stretch.upper[0], stretch.lower[1]},
                                .upper = domain.box.upper};
  const geometry::Ball<2> cylinder{.centre = {0, 0}, .radius = 0.5};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};

  // What: an ideal gas whose speed of sound and viscosity follow from the two numbers.
  const double c = 1 / wake.mach;
  const particles::State<2> stream{.rho = 1, .p = c * c / wake.gamma, .v = {1, 0}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(stretch - cylinder, domain), stream, {dx});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const particles::State<2> state = start(wake, stream, cloud.r[i]);
    cloud.v[i] = state.v;
    cloud.p[i] = state.p;
    cloud.m[i] *= state.rho / cloud.rho[i];
    cloud.rho[i] = state.rho;
  }
  const int surface =
      cloud.add_virtual(lattice.inner_points(cylinder, domain), stream, {dx}, cylinder);
  const auto add_opening = [&](const geometry::Box<2>& zone, int side) {
    cloud.add_opening({.lower = zone.lower,
                       .upper = zone.upper,
                       .axis = 0,
                       .side = side,
                       .far = stream,
                       .distance = wake.upstream + wake.downstream},
                      lattice.points(zone, domain), {dx});
  };
  add_opening(inlet, 1);
  add_opening(outlet, -1);

  Gas gas{.eos = {.gamma = wake.gamma}, .stress = {.viscosity = 1 / wake.reynolds}};
  if constexpr (Gas::Wall::surfaces) gas.background = stream.p;
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, domain, std::move(cloud), {}, policy);

  examples::Session session(settings, "cylinder_wake", "wake of a circular cylinder", fluid);
  session.note("gas", "2D, ideal gas gamma " + examples::format_exact(wake.gamma) + "; " +
                          examples::describe<Gas>());
  session.note("stream", "Reynolds number " + examples::format_exact(wake.reynolds) +
                             ", Mach number " + examples::format_exact(wake.mach) + ", cylinders " +
                             examples::format_exact(wake.width) + " D apart");
  session.record("drag_coefficient", "-", [&] { return 2 * fluid.force_on(surface)[0]; });
  session.record("lift_coefficient", "-", [&] { return 2 * fluid.force_on(surface)[1]; });
  session.record("particles_in", "-",
                 [&] { return static_cast<double>(fluid.traffic()[0].in.particles); });
  session.record("particles_out", "-",
                 [&] { return static_cast<double>(fluid.traffic()[1].out.particles); });
  session.run(time::PredictorCorrector{},
              settings.samples.value_or(std::max(400, static_cast<int>(20 * settings.until))),
              settings.fields.value_or(4));
  examples::draw_vorticity(session);
  examples::compare_with_literature(session, wake.reynolds == 100);
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters({.name = "cylinder_wake",
                                   .title = "wake of a circular cylinder in a stream",
                                   .backends = examples::backends(),
                                   .precisions = examples::precisions(),
                                   .defaults = {.spacing = 0.0625, .until = 60, .cfl = 0.4}});
  std::string scheme = "best";
  Wake wake;
  examples::add_scheme(parameters, scheme);
  wake.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      using Paper = sph::RiemannSph<kernels::QuinticSpline<2>, riemann::Acoustic, eos::IdealGas,
                                    sph::Newtonian>;
      using Best = sph::SmoothScheme<2, sph::Newtonian, boundary::NoSlip>;
      examples::with_scheme<Paper, Best>(
          scheme, [&]<class Gas>() { cylinder_wake<Gas, T>(s, wake, policy); });
    });
  });
}
