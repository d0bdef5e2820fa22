// SPDX-License-Identifier: MIT
// Mechanisms whose motion is prescribed in part, and what happens where it cannot be followed.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <sphmbs/mbs/joints/driven_angle.hpp>
#include <sphmbs/mbs/joints/prismatic.hpp>
#include <sphmbs/mbs/joints/reaction.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using std::numbers::pi;
using test::advance, test::exactly, test::thin_bar, test::violation;

namespace {

using Mechanism = Structure<ncf::Bar, ncf::PlanarBody, joints::Joint<2>>;
using System = test::SingleThreaded<Mechanism>;

/// Slider-crank, crank of 0.1 m and 0.2 kg and rod of 0.3 m and 0.2 kg, slider of 0.4 kg, as the
/// crank's angle has it: place and speed of the slider, and the kinetic energy.
struct Kinematics {
  double x, speed, energy;

  Kinematics(double angle, double rate) {
    const double r = 0.1, L = 0.3, c = std::cos(angle), s = std::sin(angle);
    const double rod = std::asin(-r * s / L), turning = -r * c * rate / (L * std::cos(rod));
    x = r * c + L * std::cos(rod);
    speed = -r * s * rate - L * std::sin(rod) * turning;
    const Vector<2> centre(-r * s * rate - L / 2 * std::sin(rod) * turning,
                           r * c * rate + L / 2 * std::cos(rod) * turning);
    energy = 0.5 * (0.2 * r * r / 3 * rate * rate + 0.2 * centre.squaredNorm() +
                    0.2 * L * L / 12 * turning * turning + 0.4 * speed * speed);
  }
};

struct DriveErrors {
  double x = 0, speed = 0, torque = 0, balance = 0;
};

/// The crank turns by 20 rad in 2 s, smoothly from and to rest.
DriveErrors drive_slider_crank(double step, double spectral_radius) {
  const joints::TimeFunction angle = joints::SmoothStep{.to = 20, .begin = 0, .end = 2};
  Mechanism mechanism;
  const auto crank = mechanism.add(thin_bar({0, 0}, {0.1, 0}, 0.2));
  const auto rod = mechanism.add(thin_bar({0.1, 0}, {0.4, 0}, 0.2));
  const auto slider =
      mechanism.add(ncf::PlanarBody{.inertia = {.mass = 0.4, .polar = 1e-3}, .position = {0.4, 0}});
  const auto pin = slider.point({0, 0});
  mechanism.add(joints::pinned(crank.start(), mechanism.q(), "bearing"));
  mechanism.add(joints::revolute(crank.end(), rod.start(), "crank pin"));
  mechanism.add(joints::revolute(rod.end(), pin, "piston pin"));
  mechanism.add(joints::prismatic(joints::ground_frame<2>({0, 0}), joints::frame(slider),
                                  ground<2>({1, 0}), mechanism.q(), "guide"));
  const int drive = mechanism.add(
      joints::driven_angle(crank.vector({0, 0}, {0.1, 0}), angle, mechanism.q(), "drive"));
  System system(mechanism);
  DriveErrors largest;
  advance(system, {.spectral_radius = spectral_radius, .newton = exactly}, 2, step, [&](System& s) {
    const double t = s.time();
    const auto at = [&](double time) { return Kinematics(angle.value(time), angle.rate(time)); };
    const auto worse = [](double& worst, double error) {
      worst = std::max(worst, std::abs(error));
    };
    worse(largest.x, pin.at(s.state().q)[0] - at(t).x);
    worse(largest.speed, pin.rate(s.state().v)[0] - at(t).speed);
    worse(largest.balance, s.energies().total());
    if (t < 0.1 || t > 1.9) return;  // power over rate is 0/0 at the ends
    const double d = 1e-4, power = (at(t + d).energy - at(t - d).energy) / (2 * d);
    const auto reaction =
        joints::reaction(mechanism.all<joints::Joint<2>>()[static_cast<std::size_t>(drive)],
                         s.state().q, t, s.multipliers<joints::Joint<2>>(drive));
    worse(largest.torque, reaction.couple[0] - power / angle.rate(t));
  });
  return largest;
}

/// Error of the angle of a thin bar of 1 m from the vertical after 2 s, hung at 0.3 rad from a
/// pivot that moves sideways and up and down.
double shake_pendulum(double step) {
  const double across = 0.3, up = 0.2, f_across = 1.1, f_up = 2.3, start = 0.3, g = 9.81;
  Mechanism mechanism;
  mechanism.gravity = {0, -g};
  ncf::Bar hung = thin_bar({0, 0}, {std::sin(start), -std::cos(start)});
  hung.velocity = {across * 2 * pi * f_across, 0};
  const auto bar = mechanism.add(hung);
  mechanism.add(joints::driven(
      bar.start(),
      joints::Path<2>(
          joints::Sine{.amplitude = across, .frequency = f_across},
          joints::Sine{.amplitude = up, .frequency = f_up, .phase = pi / 2, .mean = -up}),
      "pivot"));
  System system(mechanism);
  advance(system, {.newton = exactly}, 2, step);
  const Vector<2> along = bar.end().at(system.state().q) - bar.start().at(system.state().q);
  const auto reference = test::runge_kutta(
      std::array<double, 2>{start, 0}, 2, 20000, [&](double t, const std::array<double, 2>& y) {
        const double w_across = 2 * pi * f_across, w_up = 2 * pi * f_up;
        const double ax = -across * w_across * w_across * std::sin(w_across * t),
                     ay = -up * w_up * w_up * std::cos(w_up * t);
        return std::array<double, 2>{y[1],
                                     -1.5 * ((g + ay) * std::sin(y[0]) + ax * std::cos(y[0]))};
      });
  return std::abs(std::remainder(std::atan2(along[0], -along[1]) - reference[0], 2 * pi));
}

/// Runs until the mechanism cannot go on, and then says so, with a joint; the last
/// good state is left.
void expect_stop(System& system) {
  const std::string text =
      test::complaint<sphmbs::NumericalFailure>([&] { advance(system, {}, 3, 1e-2); });
  INFO(text);
  CHECK(test::mentions(
      text, {"Newton's method does not converge at t = 0.", "after 10 halvings", "largest residual",
             "the most loaded joint is ", "iteration  largest correction"}));
  CHECK(system.statistics().halvings == 10);
  CHECK(system.state().q.allFinite());
  CHECK(system.state().v.allFinite());
  CHECK(violation(system) < 1e-9 * system.size());
}

}  // namespace

TEST_CASE("a driven slider-crank follows its kinematics, and the drive does the work", "[mbs]") {
  for (const double rho : {1.0, 0.8}) {
    const DriveErrors coarse = drive_slider_crank(2e-3, rho), fine = drive_slider_crank(1e-3, rho);
    CAPTURE(rho, fine.x, fine.speed, fine.torque, fine.balance);
    CHECK(fine.x < 1e-11);
    CHECK(fine.speed < 2e-4);
    CHECK(fine.torque < (rho < 1 ? 2e-5 : 4e-4));
    CHECK(fine.balance < 4e-4);
    CHECK(std::log2(coarse.balance / fine.balance) > 1.8);
  }
}

TEST_CASE("a pendulum on a pivot that moves on a given path follows its equation", "[mbs]") {
  const double coarse = shake_pendulum(1e-3), fine = shake_pendulum(5e-4);
  CAPTURE(coarse, fine);
  CHECK(fine < 4e-4);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.1));
}

TEST_CASE("a mechanism that is driven beyond its reach stops there, in its last good state",
          "[mbs][fault]") {
  Mechanism mechanism;
  mechanism.gravity = {0, -9.81};
  SECTION("two bars of 1 m pulled apart by a winch") {
    const double x = 0.7, y = -std::sqrt(1 - x * x);
    const auto first = mechanism.add(thin_bar({0, 0}, {x, y})),
               second = mechanism.add(thin_bar({x, y}, {2 * x, 0}));
    mechanism.add(joints::pinned(first.start(), mechanism.q(), "root"));
    mechanism.add(joints::revolute(first.end(), second.start(), "knee"));
    const joints::TimeFunction pull =
        joints::SmoothStep{.from = 2 * x, .to = 2.5, .begin = 0, .end = 1};
    mechanism.add(joints::driven(second.end(), joints::Path<2>(pull, 0.0), "winch"));
    System system(mechanism);
    expect_stop(system);
    const double reached = second.end().at(system.state().q)[0];
    CHECK(reached < 2);
    CHECK(reached > 2 - 1e-4);
  }
  SECTION("a crank that the other bars cannot follow") {
    const double y = std::sqrt(0.36 - 0.25);
    const auto crank = mechanism.add(thin_bar({0, 0}, {0.5, 0})),
               coupler = mechanism.add(thin_bar({0.5, 0}, {1, y})),
               rocker = mechanism.add(thin_bar({1, y}, {1.5, 0}));
    mechanism.add(joints::pinned(crank.start(), mechanism.q(), "A"));
    mechanism.add(joints::revolute(crank.end(), coupler.start(), "B"));
    mechanism.add(joints::revolute(coupler.end(), rocker.start(), "C"));
    mechanism.add(joints::pinned(rocker.end(), mechanism.q(), "D"));
    mechanism.add(joints::driven_angle(crank.vector({0, 0}, {0.5, 0}),
                                       joints::SmoothStep{.to = 3, .begin = 0, .end = 2},
                                       mechanism.q(), "drive"));
    System system(mechanism);
    expect_stop(system);
    const Vector<2> pin = crank.end().at(system.state().q);
    const double needed = (Vector<2>(1.5, 0) - pin).norm();
    CHECK(needed < 1.2);
    CHECK(needed > 1.2 - 1e-4);
  }
}
