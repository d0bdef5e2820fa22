// SPDX-License-Identifier: MIT
// Soft pendulum of ANCF cable elements, let go from the horizontal (Escalona, Hussien and Shabana
// 1998; Berzeri and Shabana 2000). It stretches by a tenth, so that its measure of strain counts.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

#include "reference/flexible_pendulum_curves.hpp"
#include "support/backends.hpp"
#include "support/body_loads.hpp"
#include "support/guarded_main.hpp"
#include "support/reference_case.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;
using Cable = ancf::Cable<2, ancf::Green>;

struct Rod {
  double length = 1.2;              // [m]
  double area = 0.0018;             // of its section [m^2]
  double second_moment = 1.215e-8;  // of its section [m^4]
  double density = 5540;            // [kg/m^3]
  double youngs_modulus = 7.0e5;    // [Pa]
  Vec<2> gravity{0, -9.81};         // [m/s^2]

  void add(examples::Parameters& parameters) {
    const auto add = [&](const char* key, double& value, const char* unit, const char* meaning) {
      parameters.add_number(key, value, {.above = 0.0}, unit, meaning);
    };
    add("rod.length", length, "m", "of the pendulum");
    add("rod.area", area, "m^2", "of the section");
    add("rod.second_moment", second_moment, "m^4", "of the section's area");
    add("rod.density", density, "kg/m^3", "of the material");
    add("rod.youngs_modulus", youngs_modulus, "Pa", "of the material");
    parameters.add_vector("forces.gravity", gravity, {}, "m/s^2", "acceleration by weight");
  }
  bool operator==(const Rod&) const = default;
};

template <class Policy>
void flexible_pendulum(const examples::Settings& settings, const Rod& rod, int elements, Policy) {
  Structure<Cable, joints::Joint<2>> pendulum;
  pendulum.gravity = {rod.gravity[0], rod.gravity[1]};
  const auto cable = ancf::line(
      pendulum, {.from = {0, 0},
                 .to = {rod.length, 0},
                 .elements = elements,
                 .prototype = Cable{.axial_stiffness = rod.youngs_modulus * rod.area,
                                    .bending_stiffness = rod.youngs_modulus * rod.second_moment,
                                    .mass_per_length = rod.density * rod.area}});
  const int hinge = pendulum.add(joints::pinned(cable.start(), pendulum.q(), "hinge"));

  Dynamics<decltype(pendulum), solvers::SparseLDLT, Policy> system(pendulum);
  examples::Session session(settings, "flexible_pendulum", "soft flexible pendulum", system);
  session.note("pendulum", std::to_string(elements) + " ANCF elements, " +
                               examples::format_exact(rod.length) + " m, Green's strain");
  const bool known = rod == Rod{};
  examples::note_reference(session, known);
  examples::trace_point(session, "tip", cable.end(), "xy");
  examples::trace_point(session, "middle", cable.point(cable.length / 2), "xy");
  examples::record_reaction<joints::Joint<2>>(session, hinge, "force");
  examples::record_body_loads(session, "pendulum", cable.elements);
  session.run(examples::integrator_of(settings), *settings.samples, *settings.fields);
  examples::compare_if(known, session,
                       [&] { examples::compare_with_reference(session, elements); });
  session.finish();
}

int main(int argc, char** argv) {
  int elements = 12;
  Rod rod;
  examples::Parameters parameters(
      {.name = "flexible_pendulum",
       .title = "soft flexible pendulum",
       .backends = examples::host_backends(),
       .defaults = {.until = 1, .step = 2.5e-4, .threads = 1, .fields = 50, .samples = 400},
       .gas = false,
       .structure = true});
  parameters.add_whole_number("rod.elements", elements, {.at_least = 2, .at_most = 1000}, "",
                              "number of elements", "--elements");
  rod.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_host_backend(
        settings, [&](const auto& s, auto policy) { flexible_pendulum(s, rod, elements, policy); });
  });
}
