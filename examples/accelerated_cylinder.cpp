// SPDX-License-Identifier: MIT
// A circular cylinder in gas at rest without bounds, set in motion by a constant acceleration or by
// an impulse, against linear acoustics: the gas resists first by sound, then by its added mass.
// Radius, density and sound speed are 1; waves do not come back within the time of the run.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/sphmbs.hpp>

#include "reference/accelerated_cylinder_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/gas_parameters.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

struct Start {
  std::string drive = "acceleration";
  double mass_ratio = 1;   // of the cylinder to the gas in its place, for an impulse
  double mach = 0.01;      // an impulse's first speed, or an acceleration's last one, by sound
  double heaviness = 1e6;  // mass ratio of a cylinder that is not to mind the gas
  double margin = 1.2;     // of the box, beyond half the way of sound [m]
  double gamma = 1.4;

  void add(examples::Parameters& parameters) {
    parameters.add_choice("start.drive", drive, {"acceleration", "impulse"},
                          "what sets the cylinder in motion", "--drive");
    parameters.add_number("start.mass_ratio", mass_ratio, {.above = 0.0}, "",
                          "cylinder to gas in its place, for an impulse", "--mass-ratio");
    parameters.add_number("start.mach", mach, {.above = 0.0, .at_most = 0.3}, "",
                          "first speed after an impulse, or last one under an acceleration",
                          "--mach");
    parameters.add_number("start.heaviness", heaviness, {.above = 0.0}, "",
                          "cylinder to gas in its place, under an acceleration");
    parameters.add_number("box.margin", margin, {.above = 1.0}, "m",
                          "of the box around the cylinder, beyond half the way of sound");
    examples::add_gamma(parameters, gamma);
  }
};

template <class Gas, class T, class Policy>
void accelerated_cylinder(const examples::Settings& settings, const Start& start,
                          const std::string& coupling, Policy policy) {
  const double dx = settings.spacing, until = settings.until;
  examples::require(dx <= 0.25, "--spacing", dx, "at most 0.25 m, a quarter of the radius");
  const double side = dx * 2 * std::ceil((until / 2 + start.margin) / dx);
  examples::require_memory(side * side / (dx * dx), dx);

  // Where: a box that repeats, whose sides are too far away to be felt.
  const geometry::Box<2> box{.lower = {-side / 2, -side / 2}, .upper = {side / 2, side / 2}};
  const geometry::Domain<2> domain{.box = box, .periodic = {true, true}};
  const geometry::Ball<2> cylinder{.centre = {0, 0}, .radius = 1};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
  const particles::State<2> still{.rho = 1, .p = 1 / start.gamma};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(box - cylinder, domain), still, {dx});
  const int set = cloud.add_virtual(lattice.inner_points(cylinder, domain), still, {dx}, cylinder);

  // What: a rigid disk. One that is not to mind the gas is very heavy and falls.
  const double displaced = math::pi;  // [kg/m]
  const bool falls = start.drive == "acceleration";
  const double mass = displaced * (falls ? start.heaviness : start.mass_ratio);
  const double acceleration = falls ? start.mach / until : 0;
  mbs::Structure<mbs::ncf::PlanarBody> structure;
  structure.gravity = {acceleration, 0};
  const auto body = structure.add(mbs::ncf::PlanarBody{.inertia = {.mass = mass, .polar = mass / 2},
                                                       .velocity = {falls ? 0 : start.mach, 0}});
  coupling::WettedSurface<2, Policy> surface;
  surface.tie(cloud, set, coupling::points_of(body, structure.q(), cloud, set), structure.q());
  Gas gas{.eos = {.gamma = start.gamma}};
  if constexpr (Gas::Wall::surfaces) gas.background = still.p;
  sph::Fluid<Gas, Policy, coupling::Riding<2>, T> fluid(gas, domain, std::move(cloud),
                                                        surface.motion(), policy);
  mbs::Dynamics<decltype(structure), mbs::solvers::SparseLU> bodies(structure);
  coupling::Immersed system(fluid, bodies, surface);

  examples::Session session(settings, "accelerated_cylinder", "a cylinder set in motion in gas",
                            system);
  session.note("gas", "2D, ideal gas gamma " + examples::format_exact(start.gamma) + "; " +
                          examples::describe<Gas>());
  session.note("start", falls ? "constant acceleration"
                              : "impulse; mass " + examples::format_exact(start.mass_ratio) +
                                    " times that of the gas in its place");
  session.note("coupling", coupling);
  session.record("force", "-",
                 [&] { return falls ? -fluid.force_on(set)[0] / (displaced * acceleration) : 0; });
  session.record("speed", "-", [&] {
    return body.point({0, 0}).rate(bodies.state().v)[0] / start.mach;
  });
  examples::with_coupling(coupling, settings, [&](const auto& scheme) {
    session.run(scheme, *settings.samples, *settings.fields);
  });
  examples::compare_with_acoustics(session, falls, start.mass_ratio);
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters(
      {.name = "accelerated_cylinder",
       .title = "a cylinder set in motion in gas",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.05, .until = 6, .cfl = 0.4, .fields = 4, .samples = 200},
       .gas = true,
       .structure = true});
  std::string scheme = "best", coupling = "strong";
  Start start;
  examples::add_scheme(parameters, scheme);
  examples::add_coupling(parameters, coupling);
  start.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::require(settings.until <= 10, "--until", settings.until, "at most 10 s");
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<2>, sph::SmoothScheme<2>>(
          scheme, [&]<class Gas>() { accelerated_cylinder<Gas, T>(s, start, coupling, policy); });
    });
  });
}
