// SPDX-License-Identifier: MIT
#include <cmath>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::double_pendulum;
using test::mentions;
using test::PlanarMechanism;
using test::thin_bar;

namespace {

constexpr double g = 9.81;

/// omega^2 of the hanging double pendulum of thin bars: the roots of det(K - omega^2 M), with
/// M = [4/3, 1/2; 1/2, 1/3] and K = g [3/2, 0; 0, 1/2].
Vector<2> squares_of_double_pendulum() {
  const double a = 4.0 / 9 - 0.25, b = g * (0.5 + 2.0 / 3), c = 0.75 * g * g;
  const double root = std::sqrt(b * b - 4 * a * c);
  return {(b - root) / (2 * a), (b + root) / (2 * a)};
}

/// A bar pinned at the origin and the rest of the state, at an angle from +x, in equilibrium.
State pinned_bar(PlanarMechanism& mechanism, const Vector<2>& direction) {
  mechanism.gravity = {0, -g};
  const auto bar = mechanism.add(thin_bar({0, 0}, direction));
  mechanism.add(joints::pinned(bar.start(), mechanism.q()));
  return Dynamics(mechanism).state();
}

}  // namespace

TEST_CASE("modes of a mechanism are those of its minimal coordinates", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  const Equilibrium hanging = equilibrium(mechanism);
  const Modes modes = eigenmodes(mechanism, hanging.state);
  REQUIRE(modes.squares.size() == 2);
  const Vector<2> exact = squares_of_double_pendulum();
  CHECK(modes.squares[0] == Approx(exact[0]).epsilon(1e-8));
  CHECK(modes.squares[1] == Approx(exact[1]).epsilon(1e-8));
  CHECK(modes.frequency(1) == Approx(std::sqrt(exact[1])).epsilon(1e-8));
}

TEST_CASE("modes have unit modal mass and move no joint", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  const Equilibrium hanging = equilibrium(mechanism);
  const Modes modes = eigenmodes(mechanism, hanging.state);
  Equations equations(mechanism);
  equations.evaluate(hanging.state);
  const MatrixXd& x = modes.shapes;
  CHECK((x.transpose() * (equations.mass() * x) - MatrixXd::Identity(2, 2)).norm() < 1e-12);
  CHECK((equations.jacobian() * x).norm() < 1e-12);
}

TEST_CASE("an upright pendulum is unstable: its mode has no frequency", "[mbs]") {
  PlanarMechanism mechanism;
  const Modes modes = eigenmodes(mechanism, pinned_bar(mechanism, {0, 1}));
  REQUIRE(modes.squares.size() == 1);
  CHECK(modes.squares[0] == Approx(-1.5 * g).epsilon(1e-10));
  CHECK(modes.frequency(0) == 0);
}

TEST_CASE("conditions that are held twice leave the modes as they are", "[mbs]") {
  PlanarMechanism mechanism;
  mechanism.gravity = {0, -g};
  const auto bar = mechanism.add(thin_bar({0, 0}, {0, -1}));
  mechanism.add(joints::pinned(bar.start(), mechanism.q(), "once"));
  mechanism.add(joints::pinned(bar.start(), mechanism.q(), "again"));
  const Modes modes = eigenmodes(mechanism, Dynamics(mechanism).state());
  REQUIRE(modes.squares.size() == 1);
  CHECK(modes.squares[0] == Approx(1.5 * g).epsilon(1e-10));
}

TEST_CASE("a structure free of stress needs no state, and a free one moves at no frequency",
          "[mbs]") {
  PlanarMechanism mechanism;
  mechanism.add(thin_bar({0, 0}, {1, 0}));
  const Modes modes = eigenmodes(mechanism);
  REQUIRE(modes.squares.size() == 3);
  CHECK(modes.squares.cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a motion without mass has no mode", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum();
  mechanism.add_node(VectorXd::Zero(2));
  const std::string text =
      test::complaint<sphmbs::NumericalFailure>([&] { eigenmodes(mechanism); });
  CHECK(mentions(text, {"Eigenmodes: ", "no mass"}));
}

TEST_CASE("more coordinates than a dense matrix serves are refused", "[mbs]") {
  PlanarMechanism mechanism;
  for (int k = 0; k < 1501; ++k) mechanism.add(thin_bar({0, 0}, {1, 0}));
  CHECK(mentions(test::refusal([&] { eigenmodes(mechanism); }),
                 {"number of coordinates = 6004", "at most 6000"}));
}

TEST_CASE("the state of another structure is refused", "[mbs]") {
  PlanarMechanism mechanism = double_pendulum(), other;
  State state = pinned_bar(other, {0, -1});
  CHECK(mentions(test::refusal([&] { eigenmodes(mechanism, state); }),
                 {"state: number of coordinates = 4", "8"}));
  state.q = state.v = VectorXd::Zero(8);
  CHECK(mentions(test::refusal([&] { eigenmodes(mechanism, state); }),
                 {"state: number of multipliers = 3", "6"}));
}
