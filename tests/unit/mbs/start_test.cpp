// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::double_pendulum;
using test::PlanarMechanism;
using test::thin_bar;

TEST_CASE("initial accelerations and multipliers satisfy the equations of motion", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  // Turns about the root with 3 rad/s.
  VectorXd v = VectorXd::Zero(8);
  for (const int k : {0, 2, 4, 6}) {
    v[k] = -3 * mechanism.q()[k + 1];
    v[k + 1] = 3 * mechanism.q()[k];
  }
  mechanism.start_from(mechanism.q(), v);
  Dynamics system(mechanism);
  auto& equations = system.equations();
  equations.evaluate(system.state());
  VectorXd r;
  equations.residual(system.state().vdot, r);
  CHECK(r.cwiseAbs().maxCoeff() < 1e-12);
  // The first bar's end is on a circle of 1 m: centripetal acceleration 9 m/s^2.
  CHECK(system.state().vdot[2] == Approx(-9).epsilon(1e-12));
}

TEST_CASE("small errors of the start are projected and reported", "[mbs][fault]") {
  PlanarMechanism mechanism = double_pendulum();
  VectorXd q = mechanism.q(), v = VectorXd::Zero(8);
  q[7] += 3e-7;  // the second bar is too short
  v[3] = 2e-4;
  mechanism.start_from(q, v);
  Dynamics system(mechanism);
  auto& equations = system.equations();
  equations.evaluate(system.state());
  CHECK(equations.conditions_residual().cwiseAbs().maxCoeff() < 1e-14);
  CHECK((equations.jacobian() * system.state().v).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(system.start().position_correction > 1e-8);
  CHECK(system.start().position_correction < 1e-6);
  CHECK(system.start().notes.size() == 2);
}

TEST_CASE("a start that violates a joint is refused by the joint's name", "[mbs][fault]") {
  PlanarMechanism mechanism = double_pendulum();
  VectorXd q = mechanism.q();
  q[4] += 1e-3;
  q[6] += 1e-3;
  mechanism.start_from(q);
  CHECK(test::mentions(test::refusal([&] { Dynamics system(mechanism); }),
                       {"Initial positions violate revolute 'knee' by 0.001"}));

  PlanarMechanism moving = double_pendulum();
  VectorXd v = VectorXd::Zero(8);
  v[0] = 0.5;
  moving.start_from(moving.q(), v);
  CHECK(test::mentions(test::refusal([&] { Dynamics system(moving); }),
                       {"Initial velocities violate", "by 0.5"}));
}

TEST_CASE("redundant conditions are named, and removed or refused", "[mbs][fault]") {
  PlanarMechanism twice = double_pendulum();
  const auto knee_again = joints::revolute(twice.all<ncf::Bar>()[0].end(),
                                           twice.all<ncf::Bar>()[1].start(), "knee again");
  twice.add(knee_again);
  CHECK(test::mentions(
      test::refusal([&] { Dynamics system(twice, StartOptions{.redundant = Redundant::refuse}); }),
      {"2 redundant condition(s)", "knee"}));
  Dynamics doubled(twice);
  CHECK(doubled.start().redundant.size() == 2);
  REQUIRE(doubled.start().notes.size() == 1);
  CHECK(doubled.start().notes[0].find("knee") != std::string::npos);

  // The motion is that of the mechanism without the second knee, the reaction half of it in each.
  PlanarMechanism once = double_pendulum();
  Dynamics plain(once);
  const GeneralizedAlpha integrator{.newton = {.tolerance = 1e-13, .acceleration_tolerance = 1e-9}};
  test::advance(doubled, integrator, 0.2, 1e-3);
  test::advance(plain, integrator, 0.2, 1e-3);
  CHECK((doubled.state().q - plain.state().q).cwiseAbs().maxCoeff() < 1e-10);
  const VectorXd whole = plain.multipliers<joints::Joint<2>>(1);
  for (const int knee : {1, 2})
    CHECK((doubled.multipliers<joints::Joint<2>>(knee) - whole / 2).norm() < 1e-6 * whole.norm());
}

TEST_CASE("contradictory conditions are refused", "[mbs][fault]") {
  PlanarMechanism mechanism = double_pendulum();
  VectorXd elsewhere = mechanism.q();
  elsewhere[0] = 5e-7;  // within the tolerance of each joint alone
  mechanism.add(joints::pinned(mechanism.all<ncf::Bar>()[0].start(), elsewhere, "elsewhere"));
  CHECK(test::mentions(test::refusal([&] { Dynamics system(mechanism); }),
                       {"contradicts other conditions"}));
}

TEST_CASE("a coordinate without mass and condition is refused", "[mbs][fault]") {
  PlanarMechanism mechanism = double_pendulum();
  mechanism.add_node(Vector<2>(0, 0));
  CHECK(
      test::mentions(test::complaint<sphmbs::NumericalFailure>([&] { Dynamics system(mechanism); }),
                     {"singular at t = 0", "neither mass nor a condition"}));
}
