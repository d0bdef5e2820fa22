// SPDX-License-Identifier: MIT
// Rigid double pendulum that slides along a flexible cable (paper, sect. 5.3), in air or without.
// O, P and B are where the paper's particle counts put them: its figure is lost.
#include <algorithm>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/sphmbs.hpp>

#include "cases/pendulum_on_cable.hpp"
#include "reference/pendulum_on_cable_curves.hpp"
#include "support/backends.hpp"
#include "support/coupled_session.hpp"
#include "support/guarded_main.hpp"
#include "support/reference_case.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

using Case = examples::PendulumCase;

struct Options {
  Case data{};
  int elements = 24;
  std::string measure = "green";
  std::string scheme = "paper";
  std::string coupling = "staggered";
  bool no_air = false;
};

/// The cable from O to P, bars AB and BC, and their joints; A is at P at the start.
template <class Measure>
struct Pendulum {
  using Cable = ancf::Cable<2, Measure>;
  using Sliding = joints::Sliding<Cable>;
  using Mechanism = Structure<Cable, ncf::Bar, joints::Joint<2>, Sliding>;

  const Case data;
  const Vector<2> O{data.O[0], data.O[1]}, P{data.P[0], data.P[1]};
  const Vector<2> B{P[0] - data.AB, P[1]}, C{B[0], B[1] - data.BC};

  Pendulum(const Case& given, int elements)
      : data(given),
        cable(ancf::line(mechanism, {.from = O,
                                     .to = P,
                                     .elements = elements,
                                     .radius = data.radius,
                                     .density = data.density,
                                     .youngs_modulus = data.youngs_modulus})),
        AB(bar(P, B)),
        BC(bar(B, C)) {
    mechanism.gravity = {data.gravity[0], data.gravity[1]};
    pin_O = mechanism.add(joints::pinned(cable.start(), mechanism.q(), "O"));
    pin_P = mechanism.add(joints::pinned(cable.end(), mechanism.q(), "P"));
    mechanism.add(joints::revolute(AB.end(), BC.start(), "B"));
    slider = mechanism.add(joints::sliding(
        mechanism, cable.elements, {.slider = AB.start(), .at = cable.length, .name = "A"}));
  }

  /// Notes, trajectories of A and C, and joint forces.
  template <class System>
  void record(examples::Session<System>& session, const Options& options) {
    session.note("cable", std::to_string(options.elements) + " ANCF elements, strain measure " +
                              options.measure + ", pinned at O and P");
    examples::trace_point(session, "A", AB.start(), "xy");
    examples::trace_point(session, "C", BC.end(), "xy");
    session.record("s", "m", [this, &system = session.system()] {
      return mechanism.template all<Sliding>()[0].arc().at(system.state().q)[0];
    });
    examples::record_reaction<joints::Joint<2>>(session, pin_O, "force_O");
    examples::record_reaction<joints::Joint<2>>(session, pin_P, "force_P");
    examples::record_reaction<Sliding>(session, slider, "force_A");
  }

  Mechanism mechanism;
  ancf::Line<Cable> cable;
  Placed<ncf::Bar> AB, BC;
  int pin_O, pin_P, slider;

 private:
  Placed<ncf::Bar> bar(const Vector<2>& from, const Vector<2>& to) {
    return mechanism.add(ncf::Bar{.from = from,
                                  .to = to,
                                  .density = data.bar_density,
                                  .area = data.side * data.side,
                                  .height = data.side});
  }
};

template <class Measure>
void without_air(examples::Settings settings, const Options& options) {
  if (!settings.step) settings.step = 2.5e-4;
  Pendulum<Measure> pendulum(options.data, options.elements);
  Dynamics<typename Pendulum<Measure>::Mechanism, solvers::SparseLDLT> system(pendulum.mechanism);
  examples::Session session(settings, "pendulum_on_cable", "double pendulum on a cable", system);
  pendulum.record(session, options);
  session.note("air", "none (--no-air)");
  examples::record_body_loads(session, "AB", std::vector{pendulum.AB});
  examples::record_body_loads(session, "BC", std::vector{pendulum.BC});
  const bool known = options.data == Case{};
  examples::note_reference(session, known);
  session.run(examples::integrator_of(settings), *settings.samples, settings.fields.value_or(50));
  examples::compare_if(known, session,
                       [&] { examples::compare_with_reference(session, options.measure); });
  session.finish();
}

template <class Measure, class Gas, class T, class Policy>
void in_air(const examples::Settings& settings, const Options& options, Policy policy) {
  const double dx = settings.spacing;
  const Case& data = options.data;
  auto required = data.requirements();
  for (const double length : {data.room[0], data.room[1], data.P[0], data.P[1], data.AB, data.BC})
    required.emplace_back(
        dx <= 0.1 * std::min(data.AB, data.BC) && examples::is_whole(length, dx), "--spacing", dx,
        data == Case{} ? "a whole fraction of 0.5 m, and at most 0.1 m"
                       : "a whole fraction of the room's sides, the coordinates of P "
                         "and the bars' lengths, and at most a tenth of these");
  examples::require_all(required);
  examples::require_memory(data.room[0] * data.room[1] / (dx * dx), dx);
  Pendulum<Measure> pendulum(options.data, options.elements);
  const VectorXd q = pendulum.mechanism.q();

  // Where: a room, periodic along x, whose floor and ceiling belong to the gas's lattice.
  const geometry::Box<2> room{.lower = {0, 0}, .upper = data.room};
  const geometry::Domain<2> domain{.box = room, .periodic = {true, false}};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {0, 0}};

  // What: air; walls of four layers; and on each bar, in place of the lattice's points that it
  // covers but its ends, virtual particles that ride on it: a file of them, which gas on both sides
  // sees, or in the best scheme layers for each side.
  const particles::State<2> still = data.air.state<2>();
  const auto file = [&](const Vector<2>& from, const Vector<2>& to) {
    const int pieces = static_cast<int>(std::lround((to - from).norm() / dx));
    std::vector<Vec<2>> points;
    for (int k = 1; k < pieces; ++k) {
      const Vector<2> r = from + (to - from) * k / pieces;
      points.push_back({r[0], r[1]});
    }
    return points;
  };
  const auto on_AB = file(pendulum.P, pendulum.B), on_BC = file(pendulum.B, pendulum.C);
  const auto covered = [&](const Vec<2>& r) {
    const auto near = [&](const Vec<2>& p) { return norm2(p - r) < 1e-6 * dx * dx; };
    return std::any_of(on_AB.begin(), on_AB.end(), near) ||
           std::any_of(on_BC.begin(), on_BC.end(), near);
  };
  const geometry::Box<2> between{.lower = {-10 * data.room[0], 0},
                                 .upper = {20 * data.room[0], data.room[1]}};
  std::vector<Vec<2>> air = lattice.points(room.grown(dx / 2), domain, dx);
  std::erase_if(air, covered);
  particles::Cloud<2> cloud;
  cloud.add_gas(air, still, {dx});
  cloud.add_virtual(lattice.inner_points(between.grown(4.5 * dx) - between, domain, 5 * dx), still,
                    {dx}, outside(between.grown(dx / 2)));
  coupling::WettedSurface<2, Policy> surface;
  const auto wet = [&](const Placed<ncf::Bar>& bar, const std::vector<Vec<2>>& points,
                       const Vec<2>& normal) {
    std::vector<int> sets;
    if constexpr (Gas::Wall::surfaces) {
      const auto sides =
          cloud.add_sheet(points, std::vector<Vec<2>>(points.size(), normal), still, {dx});
      sets = {sides.front, sides.back};
    } else {
      sets = {cloud.add_virtual(points, still, {dx})};
    }
    for (const int set : sets)
      surface.tie(cloud, set, coupling::points_of(bar, q, cloud, set), q, data.side);
    return sets;
  };
  const std::vector<int> sets_AB = wet(pendulum.AB, on_AB, {0, 1});
  const std::vector<int> sets_BC = wet(pendulum.BC, on_BC, {1, 0});

  // Without a background pressure the gas presses on the bars where the other one, at the hinge, is
  // in its place: with 20 N at 0.1 m, three quarters of a bar's weight.
  const Gas gas{
      .eos = {.gamma = data.air.gamma}, .acceleration = data.gravity, .background = still.p};
  sph::Fluid<Gas, Policy, coupling::Riding<2>, T> fluid(gas, domain, std::move(cloud),
                                                        surface.motion(), policy);
  Dynamics<typename Pendulum<Measure>::Mechanism, solvers::SparseLDLT> bodies(pendulum.mechanism);
  coupling::Immersed system(fluid, bodies, surface);
  examples::Session session(settings, "pendulum_on_cable", "double pendulum on a cable in air",
                            system);
  pendulum.record(session, options);
  const bool known = data == Case{};
  examples::note_reference(session, known);
  session.note("air", "2D, ideal gas gamma " + examples::format_exact(data.air.gamma) + "; " +
                          examples::describe<Gas>() + "; bars " +
                          examples::format_exact(data.side) + " m deep; coupling " +
                          options.coupling);
  for (const auto& [name, bar, sets] :
       {std::tuple("AB", pendulum.AB, sets_AB), std::tuple("BC", pendulum.BC, sets_BC)}) {
    const auto middle = bar.point((bar.part.start() + bar.part.end()) / 2);
    examples::record_body_loads(session, name, std::vector{bar}, sets, middle);
  }
  examples::with_coupling(options.coupling, settings, [&](const auto& scheme) {
    session.run(scheme, *settings.samples, settings.fields.value_or(20));
  });
  examples::compare_if(
      known, session, [&] { examples::compare_with_motion_without_air(session, options.measure); });
  session.finish();
}

int main(int argc, char** argv) {
  Options options;
  examples::Parameters parameters(
      {.name = "pendulum_on_cable",
       .title = "double pendulum that slides along a cable in air",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.05, .until = 1, .cfl = 0.4, .samples = 400},
       .gas = true,
       .structure = true});
  parameters.add_whole_number("cable.elements", options.elements, {.at_least = 2, .at_most = 1000},
                              "", "number of elements of the cable", "--elements");
  parameters.add_choice("cable.measure", options.measure, {"green", "engineering"},
                        "strain measure of the cable", "--measure");
  parameters.add_flag("run.no_air", options.no_air,
                      "the bodies alone, by fixed steps of 2.5e-4 s where --step says no other",
                      "--no-air");
  options.data.add(parameters);
  examples::add_scheme(parameters, options.scheme);
  examples::add_coupling(parameters, options.coupling);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    const auto with_measure = [&](const auto& simulate) {
      if (options.measure == "green")
        simulate.template operator()<ancf::Green>();
      else
        simulate.template operator()<ancf::Engineering>();
    };
    if (options.no_air)
      return examples::with_host_backend(settings, [&](const auto& s, auto) {
        with_measure([&]<class Measure>() { without_air<Measure>(s, options); });
      });
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      with_measure([&]<class Measure>() {
        examples::with_scheme<sph::PaperScheme<2>, sph::SmoothScheme<2>>(
            options.scheme, [&]<class Gas>() { in_air<Measure, Gas, T>(s, options, policy); });
      });
    });
  });
}
