// SPDX-License-Identifier: MIT
// Heavy top: a spinning rigid body that turns about a fixed point under its weight (Bruels, Cardona
// and Arnold 2012).
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/ncf/rigid_body.hpp>

#include "reference/spinning_top_curves.hpp"
#include "support/backends.hpp"
#include "support/guarded_main.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

template <class Policy>
void spinning_top(const examples::Settings& settings, double spin, Policy) {
  Structure<ncf::RigidBody, joints::Joint<3>> space;
  space.gravity = {0, 0, -9.81};  // [m/s^2]
  const auto top = space.add(ncf::RigidBody{
      .inertia = ncf::principal(15, {0.234375, 0.46875, 0.234375}, {0, 1, 0}),  // [kg], [kg m^2]
      .angular_velocity = {0, spin, -4.61538},                                  // [rad/s]
      .outline_points = examples::top_outline()});
  const int joint = space.add(joints::pinned(top.point({0, 0, 0}), space.q(), "fixed point"));

  Dynamics<decltype(space), solvers::SparseLDLT, Policy> system(space);
  examples::Session session(settings, "spinning_top", "heavy top", system);
  session.note("top", "15 kg, centre of mass 1 m from the fixed point, spin " +
                          examples::format_exact(spin) + " rad/s");
  examples::trace_point(session, "centre", top.point({0, 1, 0}), "xyz");
  examples::trace_top(session, top);
  examples::record_reaction<joints::Joint<3>>(session, joint, "force");
  session.run(examples::integrator_of(settings), 400, 50);
  examples::compare_with_reference(session, spin == 150);
  session.finish();
}

int main(int argc, char** argv) {
  double spin = 150;
  examples::CommandLine command_line({.name = "spinning_top",
                                      .title = "heavy top that turns about a fixed point",
                                      .backends = examples::host_backends(),
                                      .defaults = {.until = 2, .step = 1e-4, .threads = 1},
                                      .gas = false,
                                      .structure = true});
  command_line.add_number("--spin", spin, {.at_least = -1000, .at_most = 1000}, "rad/s",
                          "angular velocity about the axis of the top");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_host_backend(settings,
                                [&](const auto& s, auto policy) { spinning_top(s, spin, policy); });
  });
}
