// SPDX-License-Identifier: MIT
// A rigid bar hangs from a flexible cable and swings: bodies without gas, and without the support
// of the other cases.
#include <cstdio>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>

using namespace sphmbs;
using namespace sphmbs::mbs;
using Mechanism = Structure<ancf::Cable<2>, ncf::Bar, joints::Joint<2>>;

void swing() {
  Mechanism mechanism;
  mechanism.gravity = {0, -9.81};                                     // [m/s^2]
  const auto cable = ancf::line(mechanism, {.from = {0, 0},           // [m]
                                            .to = {1, 0},             // [m]
                                            .elements = 10,           //
                                            .radius = 0.002,          // [m]
                                            .density = 1100,          // [kg/m^3]
                                            .youngs_modulus = 5e6});  // [Pa]
  const auto bar = mechanism.add(
      ncf::Bar{.from = {1, 0}, .to = {1.5, 0}, .density = 7800, .area = 1e-4, .height = 0.01});
  const int hook = mechanism.add(joints::pinned(cable.start(), mechanism.q(), "hook"));
  mechanism.add(joints::revolute(cable.end(), bar.start(), "knot"));

  Dynamics system(mechanism);
  const Marker<2> tip = bar.end();
  run(system, GeneralizedAlpha{.spectral_radius = 0.8}, {.until = 1, .step = 1e-3}, no_report,
      Every(0.1, [&](auto& s) {
        const Vector<2> r = tip.at(s.state().q);
        const VectorXd force = s.template multipliers<joints::Joint<2>>(hook);
        std::printf("t = %.1f s  tip (%+.4f, %+.4f) m  pull on the hook %.2f N  energy %+.6f J\n",
                    s.time(), r.x(), r.y(), force.norm(), s.energies().total());
      }));
}

int main() {
  try {
    swing();
  } catch (const Error& error) {  // one sentence: what is wrong, its value, what is allowed
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
