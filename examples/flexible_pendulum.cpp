// SPDX-License-Identifier: MIT
// Soft pendulum of ANCF cable elements, let go from the horizontal (Escalona, Hussien and Shabana
// 1998; Berzeri and Shabana 2000). It stretches by a tenth, so that its measure of strain counts.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

#include "reference/flexible_pendulum_curves.hpp"
#include "support/backends.hpp"
#include "support/guarded_main.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;
using Cable = ancf::Cable<2, ancf::Green>;

template <class Policy>
void flexible_pendulum(const examples::Settings& settings, int elements, Policy) {
  const double area = 0.0018, second_moment = 1.215e-8;  // [m^2], [m^4]
  const double density = 5540, youngs_modulus = 7.0e5;   // [kg/m^3], [Pa]
  Structure<Cable, joints::Joint<2>> pendulum;
  pendulum.gravity = {0, -9.81};  // [m/s^2]
  const auto cable =
      ancf::line(pendulum, {.from = {0, 0},
                            .to = {1.2, 0},  // [m]
                            .elements = elements,
                            .prototype = Cable{.axial_stiffness = youngs_modulus * area,
                                               .bending_stiffness = youngs_modulus * second_moment,
                                               .mass_per_length = density * area}});
  const int hinge = pendulum.add(joints::pinned(cable.start(), pendulum.q(), "hinge"));

  Dynamics<decltype(pendulum), solvers::SparseLDLT, Policy> system(pendulum);
  examples::Session session(settings, "flexible_pendulum", "soft flexible pendulum", system);
  session.note("pendulum", std::to_string(elements) + " ANCF elements, 1.2 m, Green's strain");
  examples::trace_point(session, "tip", cable.end(), "xy");
  examples::trace_point(session, "middle", cable.point(cable.length / 2), "xy");
  examples::record_reaction<joints::Joint<2>>(session, hinge, "force");
  session.run(examples::integrator_of(settings), 400, 50);
  examples::compare_with_reference(session, elements);
  session.finish();
}

int main(int argc, char** argv) {
  int elements = 12;
  examples::CommandLine command_line({.name = "flexible_pendulum",
                                      .title = "soft flexible pendulum",
                                      .backends = examples::host_backends(),
                                      .defaults = {.until = 1, .step = 2.5e-4, .threads = 1},
                                      .gas = false,
                                      .structure = true});
  command_line.add_whole_number("--elements", elements, {.at_least = 2, .at_most = 1000}, "",
                                "number of elements");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_host_backend(
        settings, [&](const auto& s, auto policy) { flexible_pendulum(s, elements, policy); });
  });
}
