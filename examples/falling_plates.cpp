// SPDX-License-Identifier: MIT
// Two hinged flexible plates that fall and swing under their weight (paper, sect. 5.4), without
// air. Where the paper's plates hang is lost with its figure; without air it makes no difference.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/grid.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

#include "reference/falling_plates_curves.hpp"
#include "support/backends.hpp"
#include "support/guarded_main.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

struct Options {
  int elements = 10;
  bool no_air = false;
};

template <class Policy>
void falling_plates(const examples::Settings& settings, const Options& options, Policy) {
  const double side = 2;  // [m]
  Structure<ancf::Plate36, joints::Joint<3>> plates;
  plates.gravity = {0, 0, -9.81};  // [m/s^2]
  const auto plate = [&](const Vector<3>& corner) {
    return ancf::grid(plates, {.origin = corner,
                               .edge_x = {side, 0, 0},
                               .edge_y = {0, side, 0},
                               .elements = {options.elements, options.elements},
                               .plate = {.thickness = 2e-3,        // [m]
                                         .density = 1000,          // [kg/m^3]
                                         .youngs_modulus = 1.0e7,  // [Pa]
                                         .poisson_ratio = 0.3}});
  };
  const auto I = plate({3, 1.5, 5}), II = plate({3 + side, 1.5, 5});

  // Hinges at three points of the edge of plate I, and at three between the plates.
  const char* const grounded[] = {"A", "B", "C"};
  const char* const between[] = {"D", "E", "F"};
  for (int k = 0; k < 3; ++k) {
    const double y = k * side / 2;
    plates.add(joints::pinned(I.point(0, y), plates.q(), grounded[k]));
    plates.add(joints::spherical(I.point(side, y), II.point(0, y), between[k]));
  }
  const auto P = II.point(side, side / 2);

  Dynamics<decltype(plates), solvers::SparseLDLT, Policy> system(plates);
  examples::Session session(settings, "falling_plates", "two hinged plates", system);
  const std::string n = std::to_string(options.elements);
  session.note("plates", "two of " + n + " x " + n + " ANCF elements, 2 m x 2 m x 2 mm");
  session.note("air", options.no_air ? "none (--no-air)" : "none");
  examples::trace_point(session, "P", P, "xz");
  examples::trace_velocity(session, "P", P, "xz");
  session.record("P_y", "m", [&] { return P.at(system.state().q)[1]; });
  for (int k = 0; k < 3; ++k) {
    examples::record_reaction<joints::Joint<3>>(session, 2 * k,
                                                std::string("force_") + grounded[k]);
    examples::record_reaction<joints::Joint<3>>(session, 2 * k + 1,
                                                std::string("force_") + between[k]);
  }
  session.run(examples::integrator_of(settings), 200, 50);
  examples::compare_with_reference(session, options.elements);
  session.finish();
}

int main(int argc, char** argv) {
  Options options;
  examples::CommandLine command_line({.name = "falling_plates",
                                      .title = "two hinged flexible plates that fall and swing",
                                      .backends = examples::backends(),
                                      .defaults = {.until = 1, .step = 5e-4, .threads = 1},
                                      .gas = false,
                                      .structure = true});
  command_line.add_whole_number("--elements", options.elements, {.at_least = 2, .at_most = 100}, "",
                                "elements along each side of a plate");
  command_line.add_flag("--no-air", options.no_air,
                        "names the run without air, the only one so far");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings,
                           [&](const auto& s, auto policy) { falling_plates(s, options, policy); });
  });
}
