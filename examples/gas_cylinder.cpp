// SPDX-License-Identifier: MIT
// Airflow around a circular cylinder in a pipe (paper, sect. 5.1). At --spacing 0.1, the paper's
// resolution, there are 469 567 gas and 14 296 virtual particles.
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "reference/gas_cylinder_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_parameters.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/reference_case.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

struct Flow {
  Vec<2> pipe{100, 50};       // length and height [m]
  Vec<2> centre{40, 25};      // of the cylinder [m]
  double radius = 10;         // of the cylinder [m]
  Vec<2> acceleration{3, 0};  // body force on the gas [m/s^2]
  examples::StillGas gas{.pressure = 841};

  void add(examples::Parameters& parameters) {
    parameters.add_vector("pipe.size", pipe, {.above = 0.0}, "m", "length and height of the pipe");
    parameters.add_vector("cylinder.centre", centre, {}, "m", "place of the cylinder's axis");
    parameters.add_number("cylinder.radius", radius, {.above = 0.0}, "m", "of the cylinder");
    parameters.add_vector("gas.acceleration", acceleration, {}, "m/s^2", "by a uniform body force");
    examples::add_still_gas(parameters, gas);
  }
  std::vector<examples::Requirement> requirements() const {
    std::vector<examples::Requirement> all;
    const std::string place =
        "[" + examples::format_exact(centre[0]) + ", " + examples::format_exact(centre[1]) + "]";
    for (int k = 0; k < 2; ++k)
      all.emplace_back(radius < centre[k] && centre[k] + radius < pipe[k], "cylinder.centre", place,
                       "so far inside the pipe that the cylinder, of radius " +
                           examples::length_text(radius) + ", touches no end or wall");
    return all;
  }
  bool operator==(const Flow&) const = default;
};

template <class Gas, class T, class Policy>
void gas_cylinder(const examples::Settings& settings, const Flow& flow, Policy policy) {
  const double dx = settings.spacing, length = flow.pipe[0], height = flow.pipe[1];
  auto required = flow.requirements();
  required.emplace_back(dx <= flow.radius / 5 && examples::is_whole(length, dx), "--spacing", dx,
                        "a whole fraction of the pipe's length, " + examples::length_text(length) +
                            ", and at most " + examples::length_text(flow.radius / 5));
  examples::require_all(required);
  examples::require_memory(length * height / (dx * dx), dx);

  // Where: a pipe, periodic along x, with a cylinder across it.
  const geometry::Box<2> pipe{.lower = {0, 0}, .upper = flow.pipe};
  const geometry::Ball<2> cylinder{.centre = flow.centre, .radius = flow.radius + 0.01 * dx};
  const geometry::Domain<2> domain{.box = pipe, .periodic = {true, false}};
  const geometry::Lattice<2> lattice{.spacing = dx};

  // What: an ideal gas at rest, set in motion by a uniform body force, between two walls of five
  // layers and around a ring of about seven layers. The gas's outermost particles lie on the walls'
  // lines, so that the walls' surface is half a spacing off.
  const particles::State<2> at_rest = flow.gas.state<2>();
  const geometry::Box<2> between{.lower = {-length, 0}, .upper = {2 * length, height}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(pipe - cylinder, domain), at_rest, {dx});
  cloud.add_virtual(lattice.inner_points(between.grown(5.5 * dx) - between, domain, 6 * dx),
                    at_rest, {dx}, outside(between.grown(dx / 2)));
  const int surface = cloud.add_virtual(examples::ring(lattice, domain, cylinder), at_rest, {dx},
                                        geometry::Ball<2>{cylinder.centre, flow.radius});

  Gas gas{.eos = {.gamma = flow.gas.gamma}, .acceleration = flow.acceleration};
  if constexpr (Gas::Wall::surfaces) gas.background = at_rest.p;
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, domain, std::move(cloud), {}, policy);

  examples::Session session(settings, "gas_cylinder", "airflow around a circular cylinder", fluid);
  session.note("gas", "2D, ideal gas gamma " + examples::format_exact(flow.gas.gamma) + "; " +
                          examples::describe<Gas>());
  const bool known = flow == Flow{};
  examples::note_reference(session, known);
  if (known) {
    session.probe("upstream", {25, 25});
    session.probe("above", {40, 40});
    session.probe("downstream", {55, 25});
    session.probe("far", {65, 40});
  }
  session.record("force", "N/m", [&] { return fluid.force_on(surface)[0]; });
  session.run(time::PredictorCorrector{}, *settings.samples, *settings.fields);
  examples::compare_if(known, session, [&] { examples::compare_with_reference(session); });
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters(
      {.name = "gas_cylinder",
       .title = "airflow around a circular cylinder in a pipe",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.5, .until = 1, .cfl = 0.4, .fields = 4, .samples = 400}});
  std::string scheme = "paper";
  Flow flow;
  examples::add_scheme(parameters, scheme);
  flow.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<2>, sph::SmoothScheme<2>>(
          scheme, [&]<class Gas>() { gas_cylinder<Gas, T>(s, flow, policy); });
    });
  });
}
