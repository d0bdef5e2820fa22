// SPDX-License-Identifier: MIT
// Rigid double pendulum that slides along a flexible cable (paper, sect. 5.3), without air. O, P
// and B are where the paper's particle counts put them: its figure is lost.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>

#include "reference/pendulum_on_cable_curves.hpp"
#include "support/backends.hpp"
#include "support/guarded_main.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

struct Options {
  int elements = 24;
  std::string measure = "green";
  bool no_air = false;
};

template <class Measure, class Policy>
void pendulum_on_cable(const examples::Settings& settings, const Options& options, Policy) {
  using Cable = ancf::Cable<2, Measure>;
  using Sliding = joints::Sliding<Cable>;
  const Vector<2> O(2.98, 6.5), P(7, 6.5), B(6, 6.5), C(6, 5.5);  // [m]
  const double side = 0.0874;                                     // of the pendulum's section [m]

  Structure<Cable, ncf::Bar, joints::Joint<2>, Sliding> mechanism;
  mechanism.gravity = {0, -9.81};  // [m/s^2]
  const auto cable = ancf::line(mechanism, {.from = O,
                                            .to = P,
                                            .elements = options.elements,
                                            .radius = 0.0015,            // [m]
                                            .density = 5208.39,          // [kg/m^3]
                                            .youngs_modulus = 2.0e11});  // [Pa]
  const auto bar = [&](const Vector<2>& from, const Vector<2>& to) {
    return mechanism.add(
        ncf::Bar{.from = from, .to = to, .density = 349.45, .area = side * side, .height = side});
  };
  const auto AB = bar(P, B), BC = bar(B, C);
  const int pin_O = mechanism.add(joints::pinned(cable.start(), mechanism.q(), "O"));
  const int pin_P = mechanism.add(joints::pinned(cable.end(), mechanism.q(), "P"));
  mechanism.add(joints::revolute(AB.end(), BC.start(), "B"));
  const int slider = mechanism.add(joints::sliding(
      mechanism, cable.elements, {.slider = AB.start(), .at = cable.length, .name = "A"}));

  Dynamics<decltype(mechanism), solvers::SparseLDLT, Policy> system(mechanism);
  examples::Session session(settings, "pendulum_on_cable", "double pendulum on a cable", system);
  session.note("cable", std::to_string(options.elements) + " ANCF elements, strain measure " +
                            options.measure + ", pinned at O and P");
  session.note("air", options.no_air ? "none (--no-air)" : "none");
  examples::trace_point(session, "A", AB.start(), "xy");
  examples::trace_point(session, "C", BC.end(), "xy");
  session.record(
      "s", "m", [&] { return mechanism.template all<Sliding>()[0].arc().at(system.state().q)[0]; });
  examples::record_reaction<joints::Joint<2>>(session, pin_O, "force_O");
  examples::record_reaction<joints::Joint<2>>(session, pin_P, "force_P");
  examples::record_reaction<Sliding>(session, slider, "force_A");
  session.run(examples::integrator_of(settings), 400, 50);
  examples::compare_with_reference(session, options.measure);
  session.finish();
}

int main(int argc, char** argv) {
  Options options;
  examples::CommandLine command_line({.name = "pendulum_on_cable",
                                      .title = "double pendulum that slides along a cable",
                                      .backends = examples::backends(),
                                      .defaults = {.until = 1, .step = 2.5e-4, .threads = 1},
                                      .gas = false,
                                      .structure = true});
  command_line.add_whole_number("--elements", options.elements, {.at_least = 2, .at_most = 1000},
                                "", "number of elements of the cable");
  command_line.add_choice("--measure", options.measure, {"green", "engineering"},
                          "strain measure of the cable");
  command_line.add_flag("--no-air", options.no_air,
                        "names the run without air, the only one so far");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&](const auto& s, auto policy) {
      if (options.measure == "green")
        pendulum_on_cable<ancf::Green>(s, options, policy);
      else
        pendulum_on_cable<ancf::Engineering>(s, options, policy);
    });
  });
}
