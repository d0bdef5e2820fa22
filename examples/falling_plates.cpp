// SPDX-License-Identifier: MIT
// Two hinged flexible plates that fall and swing under their weight (paper, sect. 5.4), in air or
// without. Where the paper's plates hang is lost with its figure: here in the middle along y, 5 m
// high.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/grid.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/sphmbs.hpp>

#include <sphmbs/coupling/wetted_grid.hpp>

#include "reference/falling_plates_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

struct Options {
  int elements = 10;
  std::string scheme = "paper";
  std::string coupling = "strong";  // the plates' corners are lighter than the air at them
  bool no_air = false;
};

/// The two plates, in a row along x, and their hinges: three points of the edge of plate I on the
/// ground, and three between the plates.
struct Plates {
  static constexpr double side = 2;  // [m]
  static constexpr const char* grounded[] = {"A", "B", "C"};
  static constexpr const char* between[] = {"D", "E", "F"};
  using Mechanism = Structure<ancf::Plate36, joints::Joint<3>>;

  explicit Plates(int elements)
      : I(plate(elements, {3, 1.5, 5})),
        II(plate(elements, {3 + side, 1.5, 5})),
        P(II.point(side, side / 2)) {
    mechanism.gravity = {0, 0, -9.81};  // [m/s^2]
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
    session.note("plates", "two of " + n + " x " + n + " ANCF elements, 2 m x 2 m x 2 mm");
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

  Mechanism mechanism;
  ancf::Grid<ancf::Plate36> I, II;
  Marker<3> P;  // middle of the free edge

 private:
  ancf::Grid<ancf::Plate36> plate(int elements, const Vector<3>& corner) {
    return ancf::grid(mechanism, {.origin = corner,
                                  .edge_x = {side, 0, 0},
                                  .edge_y = {0, side, 0},
                                  .elements = {elements, elements},
                                  .plate = {.thickness = 2e-3,        // [m]
                                            .density = 1000,          // [kg/m^3]
                                            .youngs_modulus = 1.0e7,  // [Pa]
                                            .poisson_ratio = 0.3}});
  }
};

void without_air(examples::Settings settings, const Options& options) {
  if (!settings.step) settings.step = 5e-4;
  Plates plates(options.elements);
  Dynamics<Plates::Mechanism, solvers::SparseLDLT> system(plates.mechanism);
  examples::Session session(settings, "falling_plates", "two hinged plates", system);
  plates.record(session, options.elements);
  session.note("air", "none (--no-air)");
  session.run(examples::integrator_of(settings), 200, 50);
  examples::compare_with_reference(session, options.elements);
  session.finish();
}

template <class Gas, class T, class Policy>
void in_air(const examples::Settings& settings, const Options& options, Policy policy) {
  const double dx = settings.spacing;
  const auto whole = [dx](double length) {
    return std::abs(length / dx - std::round(length / dx)) < 1e-6;
  };
  examples::require(dx <= 0.2 + 1e-9 && whole(1) && !whole(0.5), "--spacing", dx,
                    "1 m by an odd number, at least 5: 0.2, 0.111111 or 0.0666667 are the paper's");
  examples::require_memory(350 / (dx * dx * dx), dx);
  Plates plates(options.elements);
  const VectorXd q = plates.mechanism.q();

  // Where: a channel, periodic along x, whose walls' faces belong to the gas's lattice.
  const geometry::Box<3> channel{.lower = {0, 0, 0}, .upper = {10, 5, 7}};
  const geometry::Domain<3> domain{.box = channel, .periodic = {true, false, false}};
  const geometry::Lattice<3> lattice{.spacing = dx, .origin = {0, 0, 0}};

  // What: air; walls of four layers; and in place of the lattice's points that the plates cover one
  // layer of virtual particles that rides on them, which gas on both sides sees, or in the best
  // scheme layers for each side.
  const particles::State<3> still{.rho = 1.293, .p = 1e4};  // [kg/m^3], [Pa]
  const geometry::Box<3> sheet{.lower = {3 - dx / 2, 1.5, 5 - dx / 2},
                               .upper = {7 + dx / 2, 3.5, 5 + dx / 2}};
  const geometry::Box<3> between{.lower = {-100, 0, 0}, .upper = {200, 5, 7}};
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
  const double hinge = 3 + Plates::side + dx / 2;  // particles on it ride on plate I
  const std::vector<int> sets_I = wet(plates.I, 0, hinge), sets_II = wet(plates.II, hinge, 10);

  const Gas gas{.eos = {.gamma = 1.4}, .acceleration = {0, 0, -9.81}, .background = still.p};
  sph::Fluid<Gas, Policy, coupling::Riding<3>, T> fluid(gas, domain, std::move(cloud),
                                                        surface.motion(), policy);
  Dynamics<Plates::Mechanism, solvers::SparseLDLT> bodies(plates.mechanism);
  coupling::Immersed system(fluid, bodies, surface);
  examples::Session session(settings, "falling_plates", "two hinged plates in air", system);
  plates.record(session, options.elements);
  session.note("air", "3D, ideal gas gamma 1.4; " + examples::describe<Gas>() + "; coupling " +
                          options.coupling);
  for (const auto& [name, plate, sets] :
       {std::tuple("I", plates.I, sets_I), std::tuple("II", plates.II, sets_II)}) {
    examples::record_gas_load(session, name, sets, plate.point(Plates::side / 2, Plates::side / 2));
    examples::record_total_force(session, name, plate.elements);
  }
  examples::with_coupling(options.coupling, settings,
                          [&](const auto& scheme) { session.run(scheme, 200, 20); });
  examples::compare_with_motion_without_air(session, options.elements);
  session.finish();
}

int main(int argc, char** argv) {
  Options options;
  examples::CommandLine command_line(
      {.name = "falling_plates",
       .title = "two hinged flexible plates that fall and swing in air",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.2, .until = 1, .cfl = 0.4},
       .gas = true,
       .structure = true});
  command_line.add_whole_number("--elements", options.elements, {.at_least = 2, .at_most = 100}, "",
                                "elements along each side of a plate");
  command_line.add_flag("--no-air", options.no_air,
                        "the bodies alone, by fixed steps of 5e-4 s where --step says no other");
  examples::add_scheme(command_line, options.scheme);
  examples::add_coupling(command_line, options.coupling);
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    if (options.no_air)
      return examples::with_host_backend(settings,
                                         [&](const auto& s, auto) { without_air(s, options); });
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<3>, sph::SmoothScheme<3>>(
          options.scheme, [&]<class Gas>() { in_air<Gas, T>(s, options, policy); });
    });
  });
}
