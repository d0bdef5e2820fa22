// SPDX-License-Identifier: MIT
// Lagrange's gun in GUN_DIM = 1 or 2 dimensions: gas at rest drives a free piston into a vacuum,
// against the exact motion. p = rho = 1, gamma 1.4, a piston of 1 kg per square metre and 3 m of
// gas, the far end of which is not felt before 2.5 s.
#include <sphmbs/mbs.hpp>
#include <sphmbs/sphmbs.hpp>

#include "reference/lagrange_gun_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/gas_parameters.hpp"
#include "support/guarded_main.hpp"
#include "support/piston.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;
constexpr int dim = GUN_DIM;
const std::string case_name = dim == 1 ? "lagrange_gun" : "lagrange_gun_2d";
const std::string title = "Lagrange's gun in " + std::to_string(dim) + "D";

struct Gun {
  double mass = 1;    // of the piston [kg/m^2]
  double length = 3;  // of the gas at the start [m]
  double way = 4;     // from the start of the piston to the end of the tube [m]
  examples::StillGas gas{};

  void add(examples::Parameters& parameters) {
    parameters.add_number("piston.mass", mass, {.above = 0.0}, "kg/m^2", "of the piston");
    parameters.add_number("tube.gas_length", length, {.above = 0.0}, "m",
                          "of the gas behind the piston at the start");
    parameters.add_number("tube.way", way, {.above = 0.0}, "m",
                          "from the start of the piston to the end of the tube");
    examples::add_still_gas(parameters, gas);
  }
  /// When the expansion reaches the far end of the gas, rounded down to tenths [s].
  double latest() const { return std::floor(10 * length / gas.sound_speed()) / 10; }
};

template <class Gas, class T, class Policy>
void lagrange_gun(const examples::Settings& settings, const Gun& data, const std::string& coupling,
                  Policy policy) {
  const double dx = settings.spacing, length = data.length;
  examples::require_all({{dx <= length / 30 && examples::is_whole(length, dx), "--spacing", dx,
                          "a whole fraction of " + examples::length_text(length) +
                              ", and at most " + examples::length_text(length / 30)},
                         {settings.until <= data.latest(), "--until", settings.until,
                          "at most " + examples::format_exact(data.latest()) +
                              " s, when the expansion comes back from the far end"}});
  examples::require_memory(length / dx * (dim > 1 ? 10 : 1), dx);

  // Where: a tube along x, periodic across, closed at -3 m. The piston begins at 0.
  const double layers = 5 * dx, width = dim > 1 ? 10 * dx : 1;
  const auto stretch = [&](double from, double to) {
    geometry::Box<dim> box{Vec<dim>::all(0.0), Vec<dim>::all(width)};
    box.lower[0] = from;
    box.upper[0] = to;
    return box;
  };
  geometry::Domain<dim> domain{.box = stretch(-length - 1, data.way)};
  if (dim > 1) domain.periodic[dim - 1] = true;
  const geometry::Lattice<dim> lattice{.spacing = dx, .origin = Vec<dim>::all(dx / 2)};

  // What: gas, the wall behind it and the piston, whose virtual particles ride on it. Solids are
  // endless across, where the tube is periodic.
  const auto solid = [&](double from, double to) {
    geometry::Box<dim> box = stretch(from, to);
    if (dim > 1) box.lower[dim - 1] = -100, box.upper[dim - 1] = 100;
    return box;
  };
  const particles::State<dim> still = data.gas.state<dim>();
  particles::Cloud<dim> cloud;
  cloud.add_gas(lattice.points(stretch(-length, 0), domain), still, {dx});
  cloud.add_virtual(lattice.points(stretch(-length - layers, -length), domain), still, {dx},
                    solid(-length - 1, -length));
  const int face =
      cloud.add_virtual(lattice.points(stretch(0, layers), domain), still, {dx}, solid(0, 1));

  mbs::Structure<examples::Piston> gun;
  const auto piston = gun.add(examples::Piston{.mass = data.mass * width});
  coupling::WettedSurface<dim, Policy> surface;
  surface.tie(cloud, face, coupling::points_beside(piston.point({0, 0}), gun.q(), cloud, face),
              gun.q());
  sph::Fluid<Gas, Policy, coupling::Riding<dim>, T> fluid(
      Gas{.eos = {.gamma = data.gas.gamma}}, domain, std::move(cloud), surface.motion(), policy);
  mbs::Dynamics<decltype(gun), mbs::solvers::SparseLU> bodies(gun);
  coupling::Immersed system(fluid, bodies, surface);

  examples::Session session(settings, case_name, title, system);
  session.note("gas", "ideal gas gamma " + examples::format_exact(data.gas.gamma) + "; " +
                          examples::describe<Gas>());
  session.note("piston", examples::format_exact(data.mass) + " kg/m^2, free; coupling " + coupling);
  session.record("way", "m", [&] { return bodies.state().q[0]; });
  session.record("speed", "m/s", [&] { return bodies.state().v[0]; });
  session.record("face_pressure", "Pa", [&] { return fluid.force_on(face)[0] / width; });
  examples::with_coupling(coupling, settings, [&](const auto& scheme) {
    session.run(scheme, *settings.samples, *settings.fields);
  });
  examples::compare_with_exact(session, {.mass = data.mass,
                                         .pressure = data.gas.pressure,
                                         .sound_speed = data.gas.sound_speed(),
                                         .gamma = data.gas.gamma});
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters({.name = case_name,
                                   .title = title,
                                   .backends = examples::backends(),
                                   .precisions = examples::precisions(),
                                   .defaults = {.spacing = 0.0075,
                                                .until = 1,
                                                .cfl = 0.4,
                                                .threads = dim == 1 ? 1 : 2,
                                                .fields = 4,
                                                .samples = 200},
                                   .gas = true,
                                   .structure = true,
                                   .dim = dim});
  std::string scheme = "best", coupling = "strong";
  Gun gun;
  examples::add_scheme(parameters, scheme);
  examples::add_coupling(parameters, coupling);
  gun.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<dim>, sph::SmoothScheme<dim>>(
          scheme, [&]<class Gas>() { lagrange_gun<Gas, T>(s, gun, coupling, policy); });
    });
  });
}
