// SPDX-License-Identifier: MIT
#include <limits>

#include <sphmbs/mbs/forces/contact.hpp>
#include <sphmbs/mbs/forces/point_force.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance, test::complaint, test::mentions, test::refusal, test::thin_bar;

namespace {

using Wall = forces::Contact<forces::Plane<2>>;
using Mechanism =
    Structure<ncf::Bar, ncf::PlanarBody, joints::Joint<2>, forces::PointForce<2>, Wall>;
using System = test::SingleThreaded<Mechanism>;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("what cannot move at all is refused before any work", "[mbs][fault]") {
  Mechanism empty;
  CHECK(mentions(refusal([&] { System system(empty); }), {"number of coordinates = 0", "part"}));
  Mechanism weighed = test::double_pendulum<Mechanism>();
  weighed.gravity = {0, not_a_number};
  CHECK(mentions(refusal([&] { System system(weighed); }), {"gravity = ", "finite [m/s^2]"}));
}

TEST_CASE("markers and loads that are nowhere are refused", "[mbs]") {
  Mechanism mechanism = test::double_pendulum<Mechanism>();
  const auto bar = mechanism.all<ncf::Bar>()[1];
  CHECK(mentions(refusal([&] {
                   (void)bar.point({not_a_number, 0});
                 }),
                 {"bar 1: a material point = not finite"}));
  CHECK(mentions(refusal([&] {
                   mechanism.add(forces::PointForce<2>{.value = {1, 0}});
                 }),
                 {"at = missing: must be a point of a part"}));
}

TEST_CASE("bodies of a micrometre start as well as large ones", "[mbs]") {
  for (const double scale : {1e-6, 1e3}) {
    Mechanism mechanism;
    const auto a = mechanism.add(ncf::PlanarBody{
        .inertia = {.mass = 1, .polar = scale * scale}, .position = {0, 0}, .angle = 0.3});
    const auto b = mechanism.add(ncf::PlanarBody{.inertia = {.mass = 1, .polar = scale * scale},
                                                 .position = a.point({scale, 0}).at(mechanism.q()),
                                                 .angle = 0.7,
                                                 .angular_velocity = 1});
    mechanism.add(joints::revolute(a.point({scale, 0}), b.point({0, 0})));
    System system(mechanism, {.velocity_tolerance = 2});
    const double start = system.energies().total();
    advance(system, {}, 0.1, 1e-3);
    CHECK(system.statistics().halvings == 0);
    CHECK(system.energies().total() == Approx(start).epsilon(1e-4));
    CHECK(start > 0);
  }
}

TEST_CASE("a structure that changes under its equations is refused", "[mbs]") {
  Mechanism mechanism = test::double_pendulum<Mechanism>();
  System system(mechanism);
  const GeneralizedAlpha integrator;
  integrator.step(system, [] { return 1e-3; });
  const VectorXd before = system.state().q;
  mechanism.add(thin_bar({5, 0}, {6, 0}));
  CHECK(mentions(refusal([&] { integrator.step(system, [] { return 1e-3; }); }),
                 {"structure = changed since its equations were made"}));
  CHECK(system.state().q == before);
}

TEST_CASE("multipliers are asked for by a number that exists", "[mbs]") {
  Mechanism mechanism = test::double_pendulum<Mechanism>();
  System system(mechanism);
  CHECK(system.multipliers<joints::Joint<2>>(1).size() == 2);
  CHECK(mentions(refusal([&] { system.multipliers<ncf::Bar>(2); }), {"= 2: must be from 0 to 1"}));
  CHECK(mentions(refusal([&] { system.multipliers<joints::Joint<2>>(-1); }), {"= -1: must be"}));
}

TEST_CASE("a force that is not a number ends the run with its part, a table and the last state",
          "[mbs][fault]") {
  Mechanism mechanism = test::double_pendulum<Mechanism>();
  mechanism.add(forces::PointForce<2>{
      .at = mechanism.all<ncf::Bar>()[1].end(),
      .history = [](double t) { return Vector<2>(t > 0.0501 ? not_a_number : 0.0, 0.0); }});
  System system(mechanism);
  const std::string text =
      complaint<sphmbs::NumericalFailure>([&] { advance(system, {}, 0.1, 1e-3); });
  CAPTURE(text);
  CHECK(mentions(text, {"the residual of bar 1 (nodes 2, 3) is not a number",
                        "iteration  largest correction", "after 10 halvings", "          0  "}));
  CHECK(system.time() == Approx(0.0501).margin(1e-3));
  CHECK(system.state().q.allFinite());
}

TEST_CASE("forces with a potential do no work from outside", "[mbs]") {
  Mechanism mechanism;
  mechanism.gravity = {0, -9.81};
  const auto ball =
      mechanism.add(ncf::PlanarBody{.inertia = {.mass = 1, .polar = 0.1}, .position = {0, 0.2}});
  mechanism.add(Wall{.point = ball.point({0, 0}),
                     .frame = forces::frame(ground<2>({0, 0}), ground<2>({1, 0})),
                     .law = {.stiffness = 1e4}});
  mechanism.add(forces::PointForce<2>{.at = ball.point({0, 0}), .value = {0.5, 0}});
  System system(mechanism);
  const double start = system.energies().total();
  advance(system, {.spectral_radius = 1}, 0.6, 1e-4);
  const Energies e = system.energies();
  CHECK(e.work == 0);
  CHECK(ball.point({0, 0}).at(system.state().q)[1] > 0.05);  // it has bounced
  CHECK(std::abs(e.total() - start) < 1e-3 * 9.81 * 0.2);
  CHECK(std::abs(e.total() - start) > 0);
}
