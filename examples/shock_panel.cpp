// SPDX-License-Identifier: MIT
// A shock of Mach 1.21 runs over a thin steel panel that is clamped to the floor of a channel
// (after the shock-tube experiments of Giordano et al., Shock Waves 14, 2005), against an
// independent solution.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/clamped.hpp>
#include <sphmbs/sphmbs.hpp>

#include <sphmbs/coupling/wetted_line.hpp>

#include "cases/shock_panel.hpp"
#include "reference/shock_panel_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

using Setup = examples::PanelSetup;
using Choice = examples::PanelChoice;

/// Gas behind a shock that runs in the direction of x, from the jump conditions.
particles::State<2> behind_shock(const particles::State<2>& ahead, double mach, double gamma) {
  const double square = mach * mach, c = std::sqrt(gamma * ahead.p / ahead.rho);
  const double denser = (gamma + 1) * square / ((gamma - 1) * square + 2);
  return {.rho = ahead.rho * denser,
          .p = ahead.p * (1 + 2 * gamma / (gamma + 1) * (square - 1)),
          .v = {mach * c * (1 - 1 / denser), 0}};
}

/// Gas, walls and the panel's virtual particles.
template <class Gas>
struct Channel {
  Channel(const Setup& setup, double dx) {
    const auto columns = [dx](double length) { return (std::round(length / dx) + 0.5) * dx; };
    // The first column of the panel's virtual particles takes the place of one of gas: lengths are
    // measured from half a spacing before and behind it.
    const double from = -columns(-setup.opening), to = columns(setup.end), deep = 4 * dx;
    const geometry::Box<2> inside{.lower = {from, 0}, .upper = {to, setup.height}};
    domain.box = {.lower = {from - deep, 0}, .upper = inside.upper};
    const geometry::Lattice<2> lattice{.spacing = dx, .origin = {0, dx / 2}};
    const particles::State<2> ahead = setup.ahead.state<2>();
    const particles::State<2> behind = behind_shock(ahead, setup.mach, setup.ahead.gamma);

    std::vector<Vec<2>> shocked, still, patches;
    for (const Vec<2>& r : lattice.points(inside, domain))
      (r[0] < setup.shock - dx / 4                      ? shocked
       : std::abs(r[0]) < dx / 4 && r[1] < setup.length ? patches
                                                        : still)
          .push_back(r);
    cloud.add_gas(shocked, behind, {dx});
    cloud.add_gas(still, ahead, {dx});
    const geometry::Box<2> hollow{.lower = {-100, 0}, .upper = inside.upper};
    cloud.add_virtual(lattice.points(hollow.grown(deep) - hollow, domain, 2 * deep), ahead, {dx},
                      outside(hollow));
    if constexpr (Gas::Wall::surfaces) {
      const auto sides =
          cloud.add_sheet(patches, std::vector<Vec<2>>(patches.size(), {-1, 0}), ahead, {dx});
      panel = {sides.front, sides.back};
    } else {
      panel = {cloud.add_virtual(patches, ahead, {dx})};
    }
    const geometry::Box<2> zone{.lower = domain.box.lower, .upper = {from, setup.height}};
    cloud.add_opening({.lower = zone.lower,
                       .upper = zone.upper,
                       .axis = 0,
                       .side = 1,
                       .far = behind,
                       .distance = to - from},
                      lattice.points(zone, domain), {dx});
    gas = {.eos = {.gamma = setup.ahead.gamma}, .background = ahead.p};
  }

  template <class T, class Motion, class Policy>
  auto fluid(const Motion& motion, Policy policy) {
    return sph::Fluid<Gas, Policy, Motion, T>(gas, domain, std::move(cloud), motion, policy);
  }

  geometry::Domain<2> domain;
  particles::Cloud<2> cloud;
  std::vector<int> panel;  // its sets of virtual particles
  Gas gas;
};

/// Notes, force on the panel and pressures.
template <class System, class Fluid>
void record(examples::Session<System>& session, Fluid& fluid, const std::vector<int>& panel,
            double height) {
  const double dx = session.settings().spacing;
  session.note("gas", "2D, ideal gas gamma " + examples::format_exact(fluid.scheme().eos.gamma) +
                          "; " + examples::describe<typename Fluid::SchemeType>());
  for (const int k : {0, 1})
    session.record(std::string("force_") + "xy"[k], "N/m", [&fluid, panel, k] {
      double force = 0;
      for (const int set : panel) force += fluid.force_on(set)[k];
      return force;
    });
  const auto pressure = [&](const std::string& name, const Vec<2>& x) {
    session.record("p_" + name, "Pa", [&fluid, x] { return fluid.sample(x).p; });
  };
  pressure("front", {-0.04, 0.02});
  pressure("behind", {0.04, 0.02});
  pressure("floor_front", {-0.01, dx / 2});
  pressure("floor_behind", {0.01, dx / 2});
  pressure("top", {0, height - dx / 2});
}

template <class Gas, class T, class Policy>
void rigid_panel(const examples::Settings& settings, const Choice& choice, const Setup& setup,
                 Policy policy) {
  Channel<Gas> channel(setup, settings.spacing);
  auto fluid = channel.template fluid<T>(boundary::Fixed{}, policy);
  examples::Session session(settings, "shock_panel", "shock on a rigid panel", fluid);
  session.note("panel", "rigid (--rigid); set-up " + choice.setup);
  record(session, fluid, channel.panel, setup.height);
  session.run(time::PredictorCorrector{}, *settings.samples, *settings.fields);
  examples::compare_rigid(session, choice.known());
  session.finish();
}

template <class Gas, class T, class Policy>
void flexible_panel(const examples::Settings& settings, const Choice& choice, const Setup& setup,
                    Policy policy) {
  using Cable = mbs::ancf::Cable<2>;
  mbs::Structure<Cable, mbs::joints::Joint<2>> structure;
  const auto line = mbs::ancf::line(
      structure, {.from = {0, 0},
                  .to = {0, setup.length},
                  .elements = choice.elements,
                  .prototype = Cable{.axial_stiffness = setup.youngs_modulus * setup.thickness,
                                     .bending_stiffness = setup.stiffness(),
                                     .mass_per_length = setup.density * setup.thickness}});
  const int foot = structure.add(
      mbs::joints::clamped<2>(line.start(), {line.gradient(0)}, structure.q(), "foot"));

  Channel<Gas> channel(setup, settings.spacing);
  coupling::WettedSurface<2, Policy> surface;
  for (const int set : channel.panel)
    surface.tie(channel.cloud, set, coupling::points_of(line, structure.q(), channel.cloud, set),
                structure.q());
  auto fluid = channel.template fluid<T>(surface.motion(), policy);
  mbs::Dynamics<decltype(structure), mbs::solvers::SparseLDLT> bodies(structure);
  coupling::Immersed system(fluid, bodies, surface);
  examples::Session session(settings, "shock_panel", "shock on a flexible panel", system);
  session.note("panel", std::to_string(choice.elements) + " ANCF cable elements, clamped; set-up " +
                            choice.setup + "; coupling " + choice.coupling);
  record(session, fluid, channel.panel, setup.height);
  examples::record_body_loads(session, "panel", line.elements, channel.panel, line.start());
  examples::record_reaction<mbs::joints::Joint<2>>(session, foot, "force_foot");
  for (const auto& [name, point] :
       {std::pair("tip", line.end()), std::pair("middle", line.point(setup.length / 2))})
    for (const int k : {0, 1})
      session.record(std::string(name) + "_" + "xy"[k], "m", [&bodies, point = point, k] {
        return point.at(bodies.state().q)[k] - (k == 1 ? point.x0[1] : 0);
      });
  examples::with_coupling(choice.coupling, settings, [&](const auto& scheme) {
    session.run(scheme, *settings.samples, *settings.fields);
  });
  examples::compare_flexible(session, choice.known());
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters(
      {.name = "shock_panel",
       .title = "shock on a thin panel in a channel",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 1e-3, .until = 5e-3, .cfl = 0.4, .fields = 20, .samples = 500},
       .gas = true,
       .structure = true});
  std::string scheme = "best";
  Choice choice;
  bool rigid = false;
  examples::add_scheme(parameters, scheme);
  examples::add_coupling(parameters, choice.coupling);
  parameters.add_choice("channel.setup", choice.setup, {"reference", "experiment"},
                        "the reference's channel, or a lower one as in the experiment", "--setup");
  parameters.add_whole_number("panel.elements", choice.elements, {.at_least = 2, .at_most = 200},
                              "", "number of elements of the panel", "--elements");
  parameters.add_flag("panel.rigid", rigid, "a panel that does not move", "--rigid");
  choice.own.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    const double dx = settings.spacing;
    examples::require(choice.setup == "reference" || choice.own == Setup{}, "channel.setup",
                      choice.setup,
                      "reference where channel, shock, gas or panel are changed by parameters");
    const Setup setup =
        choice.setup == "reference" ? choice.own : examples::setup_named(choice.setup);
    auto required = setup.requirements();
    for (const double length : {setup.length, setup.height})
      required.emplace_back(dx <= setup.length / 10 && examples::is_whole(length, dx), "--spacing",
                            dx,
                            "a whole fraction of " + examples::format_exact(1e3 * setup.length) +
                                " mm, the panel's length, and of the channel's height");
    examples::require_all(required);
    examples::require_memory((setup.end - setup.opening) * setup.height / (dx * dx), dx);
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      examples::with_scheme<sph::PaperScheme<2>, sph::ShockScheme<2>>(scheme, [&]<class Gas>() {
        if (rigid)
          rigid_panel<Gas, T>(s, choice, setup, policy);
        else
          flexible_panel<Gas, T>(s, choice, setup, policy);
      });
    });
  });
}
