// SPDX-License-Identifier: MIT
// Two hinged flexible plates that fall and swing under their weight (paper, sect. 5.4), in air or
// without. Where the paper's plates hang is lost with its figure: here in the middle along y, 5 m
// high.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/grid.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/sphmbs.hpp>

#include <sphmbs/coupling/wetted_grid.hpp>

#include "cases/falling_plates.hpp"
#include "reference/falling_plates_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/guarded_main.hpp"
#include "support/reference_case.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

using Case = examples::PlatesCase;

struct Options {
  Case data{};
  int elements = 10;
  std::string scheme = "paper";
  std::string coupling = "strong";  // the plates' corners are lighter than the air at them
  bool no_air = false;
};

/// The two plates, in a row along x, and their hinges: three points of the edge of plate I on the
/// ground, and three between the plates.
struct Plates {
  static constexpr const char* grounded[] = {"A", "B", "C"};
  static constexpr const char* between[] = {"D", "E", "F"};
  using Mechanism = Structure<ancf::Plate36, joints::Joint<3>>;

  Plates(const Case& given, int elements)
      : data(given),
        I(plate(elements, {data.corner[0], data.corner[1], data.corner[2]})),
        II(plate(elements, {data.corner[0] + data.side, data.corner[1], data.corner[2]})),
        P(II.point(data.side, data.side / 2)) {
    mechanism.gravity = {data.gravity[0], data.gravity[1], data.gravity[2]};
    const double side = data.side;
    for (int k = 0; k < 3; ++k) {
      const double y = k * side / 2;
      mechanism.add(joints::pinned(I.point(0, y), mechanism.q(), grounded[k]));
      mechanism.add(joints::spherical(I.point(side, y), II.point(0, y), between[k]));
    }
  }

  /// Notes, the trajectory of P, and joint forces.
  template <class System>
  void record(examples::Session<System>& session, int elements) {
    const std::string n = std::to_string(elements);
    session.note("plates", "two of " + n + " x " + n + " ANCF elements, " +
                               examples::format_exact(data.side) + " m x " +
                               examples::format_exact(data.side) + " m x " +
                               examples::format_exact(1e3 * data.thickness) + " mm");
    examples::trace_point(session, "P", P, "xz");
    examples::trace_velocity(session, "P", P, "xz");
    session.record("P_y", "m",
                   [this, &system = session.system()] { return P.at(system.state().q)[1]; });
    for (int k = 0; k < 3; ++k) {
      examples::record_reaction<joints::Joint<3>>(session, 2 * k,
                                                  std::string("force_") + grounded[k]);
      examples::record_reaction<joints::Joint<3>>(session, 2 * k + 1,
                                                  std::string("force_") + between[k]);
    }
  }

  Case data;
  Mechanism mechanism;
  ancf::Grid<ancf::Plate36> I, II;
  Marker<3> P;  // middle of the free edge

 private:
  ancf::Grid<ancf::Plate36> plate(int elements, const Vector<3>& corner) {
    return ancf::grid(mechanism, {.origin = corner,
                                  .edge_x = {data.side, 0, 0},
                                  .edge_y = {0, data.side, 0},
                                  .elements = {elements, elements},
                                  .plate = {.thickness = data.thickness,
                                            .density = data.density,
                                            .youngs_modulus = data.youngs_modulus,
                                            .poisson_ratio = data.poisson_ratio}});
  }
};

void without_air(examples::Settings settings, const Options& options) {
  if (!settings.step) settings.step = 5e-4;
  Plates plates(options.data, options.elements);
  Dynamics<Plates::Mechanism, solvers::SparseLDLT> system(plates.mechanism);
  examples::Session session(settings, "falling_plates", "two hinged plates", system);
  plates.record(session, options.elements);
  session.note("air", "none (--no-air)");
  examples::record_body_loads(session, "I", plates.I.elements);
  examples::record_body_loads(session, "II", plates.II.elements);
  const bool known = options.data == Case{};
  examples::note_reference(session, known);
  session.run(examples::integrator_of(settings), *settings.samples, settings.fields.value_or(50));
  examples::compare_if(known, session,
                       [&] { examples::compare_with_reference(session, options.elements); });
  session.finish();
}

template <class Gas, class T, class Policy>
void in_air(const examples::Settings& settings, const Options& options, Policy policy) {
  const double dx = settings.spacing;
  const Case& data = options.data;
  const double side = data.side, x = data.corner[0], y = data.corner[1], z = data.corner[2];
  // Plates lie on the lattice, and their sides run midway between its points.
  bool fits =
      dx <= side / 10 + 1e-9 && !examples::is_whole(y, dx) && !examples::is_whole(y + side, dx);
  for (const double length : {data.channel[0], data.channel[1], data.channel[2], side, x, z})
    fits = fits && examples::is_whole(length, dx);
  auto required = data.requirements();
  required.emplace_back(
      fits, "--spacing", dx,
      data == Case{}
          ? "1 m by an odd number, at least 5: 0.2, 0.111111 or 0.0666667 are the paper's"
          : "at most a tenth of a plate's side, and a whole fraction of it, of the channel's sides "
            "and "
            "of x and z of the corner, but not of its y");
  examples::require_all(required);
  examples::require_memory(data.channel[0] * data.channel[1] * data.channel[2] / (dx * dx * dx),
                           dx);
  Plates plates(options.data, options.elements);
  const VectorXd q = plates.mechanism.q();

  // Where: a channel, periodic along x, whose walls' faces belong to the gas's lattice.
  const geometry::Box<3> channel{.lower = {0, 0, 0}, .upper = data.channel};
  const geometry::Domain<3> domain{.box = channel, .periodic = {true, false, false}};
  const geometry::Lattice<3> lattice{.spacing = dx, .origin = {0, 0, 0}};

  // What: air; walls of four layers; and in place of the lattice's points that the plates cover one
  // layer of virtual particles that rides on them, which gas on both sides sees, or in the best
  // scheme layers for each side.
  const particles::State<3> still = data.air.state<3>();
  const geometry::Box<3> sheet{.lower = {x - dx / 2, y, z - dx / 2},
                               .upper = {x + 2 * side + dx / 2, y + side, z + dx / 2}};
  const geometry::Box<3> between{.lower = {-10 * data.channel[0], 0, 0},
                                 .upper = {20 * data.channel[0], data.channel[1], data.channel[2]}};
  particles::Cloud<3> cloud;
  cloud.add_gas(lattice.inner_points(channel.grown(dx / 2) - sheet, domain, dx), still, {dx});
  cloud.add_virtual(
      lattice.inner_points(between.grown(4.5 * dx) - between.grown(dx / 2), domain, 5 * dx), still,
      {dx}, outside(between.grown(dx / 2)));
  coupling::WettedSurface<3, Policy> surface;
  const auto wet = [&](const ancf::Grid<ancf::Plate36>& plate, double from, double to) {
    std::vector<Vec<3>> patches;
    for (const Vec<3>& r : lattice.inner_points(sheet, domain))
      if (r[0] > from && r[0] < to) patches.push_back(r);
    std::vector<int> own;
    if constexpr (Gas::Wall::surfaces) {
      const auto sides =
          cloud.add_sheet(patches, std::vector<Vec<3>>(patches.size(), {0, 0, 1}), still, {dx});
      own = {sides.front, sides.back};
    } else {
      own = {cloud.add_virtual(patches, still, {dx})};
    }
    for (const int set : own) surface.tie(cloud, set, coupling::points_of(plate, q, cloud, set), q);
    return own;
  };
  const double hinge = x + side + dx / 2;  // particles on it ride on plate I
  const std::vector<int> sets_I = wet(plates.I, 0, hinge),
                         sets_II = wet(plates.II, hinge, data.channel[0]);

  const Gas gas{
      .eos = {.gamma = data.air.gamma}, .acceleration = data.gravity, .background = still.p};
  sph::Fluid<Gas, Policy, coupling::Riding<3>, T> fluid(gas, domain, std::move(cloud),
                                                        surface.motion(), policy);
  Dynamics<Plates::Mechanism, solvers::SparseLDLT> bodies(plates.mechanism);
  coupling::Immersed system(fluid, bodies, surface);
  examples::Session session(settings, "falling_plates", "two hinged plates in air", system);
  plates.record(session, options.elements);
  const bool known = data == Case{};
  examples::note_reference(session, known);
  session.note("air", "3D, ideal gas gamma " + examples::format_exact(data.air.gamma) + "; " +
                          examples::describe<Gas>() + "; coupling " + options.coupling);
  for (const auto& [name, plate, sets] :
       {std::tuple("I", plates.I, sets_I), std::tuple("II", plates.II, sets_II)})
    examples::record_body_loads(session, name, plate.elements, sets,
                                plate.point(side / 2, side / 2));
  examples::with_coupling(options.coupling, settings, [&](const auto& scheme) {
    session.run(scheme, *settings.samples, settings.fields.value_or(20));
  });
  examples::compare_if(known, session, [&] {
    examples::compare_with_motion_without_air(session, options.elements);
  });
  session.finish();
}

int main(int argc, char** argv) {
  Options options;
  examples::Parameters parameters(
      {.name = "falling_plates",
       .title = "two hinged flexible plates that fall and swing in air",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.2, .until = 1, .cfl = 0.4, .samples = 200},
       .gas = true,
       .structure = true,
       .dim = 3});
  parameters.add_whole_number("plates.elements", options.elements, {.at_least = 2, .at_most = 100},
                              "", "elements along each side of a plate", "--elements");
  parameters.add_flag("run.no_air", options.no_air,
                      "the bodies alone, by fixed steps of 5e-4 s where --step says no other",
                      "--no-air");
  options.data.add(parameters);
  examples::add_scheme(parameters, options.scheme);
  examples::add_coupling(parameters, options.coupling);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    if (options.no_air)
      return examples::with_host_backend(settings,
                                         [&](const auto& s, auto) { without_air(s, options); });
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<3>, sph::SmoothScheme<3>>(
          options.scheme, [&]<class Gas>() { in_air<Gas, T>(s, options, policy); });
    });
  });
}
