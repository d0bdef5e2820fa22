// SPDX-License-Identifier: MIT
// Heavy top: a spinning rigid body that turns about a fixed point under its weight (Bruels, Cardona
// and Arnold 2012).
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/ncf/rigid_body.hpp>

#include "reference/spinning_top_curves.hpp"
#include "support/backends.hpp"
#include "support/body_loads.hpp"
#include "support/guarded_main.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

struct Top {
  double spin = 150;                            // about its axis [rad/s]
  double precession = -4.61538;                 // about the vertical, at the start [rad/s]
  double mass = 15;                             // [kg]
  Vec<3> moments{0.234375, 0.46875, 0.234375};  // of inertia about the centre [kg m^2]
  double distance = 1;                          // of the centre from the fixed point [m]
  Vec<3> gravity{0, 0, -9.81};                  // [m/s^2]

  void add(examples::Parameters& parameters) {
    parameters.add_number("top.spin", spin, {.at_least = -1000, .at_most = 1000}, "rad/s",
                          "angular velocity about the axis of the top", "--spin");
    parameters.add_number("top.precession", precession, {.at_least = -1000, .at_most = 1000},
                          "rad/s", "angular velocity about the vertical at the start");
    parameters.add_number("top.mass", mass, {.above = 0.0}, "kg", "of the top");
    parameters.add_vector("top.moments", moments, {.above = 0.0}, "kg m^2",
                          "principal moments of inertia about the centre of mass, axis second");
    parameters.add_number("top.distance", distance, {.above = 0.0}, "m",
                          "of the centre of mass from the fixed point");
    parameters.add_vector("forces.gravity", gravity, {}, "m/s^2", "acceleration by weight");
  }
  bool operator==(const Top&) const = default;
};

template <class Policy>
void spinning_top(const examples::Settings& settings, const Top& data, Policy) {
  const Vector<3> centre{0, data.distance, 0};
  Structure<ncf::RigidBody, joints::Joint<3>> space;
  space.gravity = {data.gravity[0], data.gravity[1], data.gravity[2]};
  const auto top = space.add(ncf::RigidBody{
      .inertia =
          ncf::principal(data.mass, {data.moments[0], data.moments[1], data.moments[2]}, centre),
      .angular_velocity = {0, data.spin, data.precession},
      .outline_points = examples::top_outline()});
  const int joint = space.add(joints::pinned(top.point({0, 0, 0}), space.q(), "fixed point"));

  Dynamics<decltype(space), solvers::SparseLDLT, Policy> system(space);
  examples::Session session(settings, "spinning_top", "heavy top", system);
  session.note("top", examples::format_exact(data.mass) + " kg, centre of mass " +
                          examples::format_exact(data.distance) + " m from the fixed point, spin " +
                          examples::format_exact(data.spin) + " rad/s");
  examples::trace_point(session, "centre", top.point(centre), "xyz");
  examples::trace_top(session, top);
  examples::record_reaction<joints::Joint<3>>(session, joint, "force");
  examples::record_body_loads(session, "top", std::vector{top});
  session.run(examples::integrator_of(settings), *settings.samples, *settings.fields);
  examples::compare_with_reference(session, data == Top{});
  session.finish();
}

int main(int argc, char** argv) {
  Top top;
  examples::Parameters parameters(
      {.name = "spinning_top",
       .title = "heavy top that turns about a fixed point",
       .backends = examples::host_backends(),
       .defaults = {.until = 2, .step = 1e-4, .threads = 1, .fields = 50, .samples = 400},
       .gas = false,
       .structure = true});
  top.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_host_backend(settings,
                                [&](const auto& s, auto policy) { spinning_top(s, top, policy); });
  });
}
