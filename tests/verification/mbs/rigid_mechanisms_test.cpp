// SPDX-License-Identifier: MIT
// Planar mechanisms of rigid bodies against solutions of their equations in minimal coordinates.
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <sphmbs/mbs/forces/spring_damper.hpp>
#include <sphmbs/mbs/forces/torque.hpp>
#include <sphmbs/mbs/joints/prismatic.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/mbs/ncf/readout.hpp>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance, test::exactly, test::thin_bar, test::violation;

namespace {

using Mechanism = Structure<ncf::Bar, ncf::PlanarBody, joints::Joint<2>, forces::Torque<2>,
                            forces::SpringDamper<2>>;
using System = test::SingleThreaded<Mechanism>;
using Body = Placed<ncf::PlanarBody>;
using Bar = Placed<ncf::Bar>;

/// Andrews' squeezing mechanism: seven bodies, of which the first is driven by a torque and the
/// third is held by a spring (Hairer and Wanner, Solving Ordinary Differential Equations II, VII.7;
/// Test Set for IVP Solvers, 2003).
struct Squeezer {
  Mechanism mechanism;
  std::vector<Body> bodies;  // K1 to K7
  std::array<int, 3> loops;  // the joints that close the loops, with the test set's multipliers

  Squeezer() {
    const double mass[] = {.04325, .00365, .02373, .00706, .07050, .00706, .05498};
    const double inertia[] = {2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5};
    const Vector<2> O(0, 0), A(-.06934, -.00227), B(-.03635, .03273), C(.014, .072);
    const double beta = -0.0617138900142764496, gamma = 0.455279819163070380,
                 phi = 0.222668390165885885, delta = 0.487364979543842550,
                 omega = -0.222668390165885885, epsilon = 1.23054744454982119;
    const double rr = .007, d = .028, ss = .035, e = .02, zf = .02, zt = .04, u = .04;
    const auto add = [&](std::size_t k, const Vector<2>& centre, const Vector<2>& place,
                         double angle) {
      return mechanism.add(ncf::PlanarBody{
          .inertia = {.mass = mass[k - 1], .centre = centre, .polar = inertia[k - 1]},
          .position = place,
          .angle = angle});
    };
    const auto k1 = add(1, {.00092, 0}, O, beta);
    const auto k2 = add(2, {-.0115, 0}, k1.point({rr, 0}).at(mechanism.q()), beta);
    const auto k3 = add(3, {.01874, -.01043}, B, gamma);
    const auto k5 = add(5, {.02308, .00916}, A, delta);
    const auto k7 = add(7, {.01228, -.00449}, A, epsilon);
    const auto k4 = add(4, {0, .01421 - e}, k5.point({zt, 0}).at(mechanism.q()), phi + delta);
    const auto k6 = add(6, {zf - .01421, 0}, k7.point({0, -u}).at(mechanism.q()), omega + epsilon);
    bodies = {k1, k2, k3, k4, k5, k6, k7};

    for (const Body& body : {k1, k3, k5, k7})
      mechanism.add(joints::pinned(body.point({0, 0}), mechanism.q()));
    mechanism.add(joints::revolute(k1.point({rr, 0}), k2.point({0, 0})));
    mechanism.add(joints::revolute(k5.point({zt, 0}), k4.point({0, 0})));
    mechanism.add(joints::revolute(k7.point({0, -u}), k6.point({0, 0})));
    const auto tip = k2.point({-d, 0});
    loops = {mechanism.add(joints::revolute(tip, k3.point({0, -ss}))),
             mechanism.add(joints::revolute(tip, k4.point({0, -e}))),
             mechanism.add(joints::revolute(tip, k6.point({zf, 0})))};
    mechanism.add(forces::Torque<2>{.on = k1.vector({0, 0}, {1, 0}), .value = .033});
    mechanism.add(forces::SpringDamper<2>{.from = ground(C),
                                          .to = k3.point({.02, -.018}),
                                          .stiffness = 4530,
                                          .natural_length = .07785});
  }
};

struct SqueezerErrors {
  double angle = 0, rate = 0, multiplier = 0, violation = 0;
};

/// At t = 0.03 against the test set's solution.
SqueezerErrors squeeze(double step) {
  using std::numbers::pi;
  const double beta = 15.81077119629904, theta = -15.75637105984298, gamma = 0.04082224013073101,
               phi = -0.5347301163226948, delta = 0.5244099658805304, omega = 0.5347301163226948,
               epsilon = 1.048080741042263;
  const std::array<double, 7> angles{beta,  beta + theta,    gamma,  phi + delta,
                                     delta, omega + epsilon, epsilon};
  const double beta_rate = 1139.920302151208, theta_rate = -1424.379294994111,
               gamma_rate = 11.03291221937134, phi_rate = 19.29337464421385,
               delta_rate = 0.5735699284790808, omega_rate = -19.29337464421385,
               epsilon_rate = 0.3231791658026955;
  const std::array<double, 7> rates{
      beta_rate,  beta_rate + theta_rate,    gamma_rate,  phi_rate + delta_rate,
      delta_rate, omega_rate + epsilon_rate, epsilon_rate};
  const std::array<Vector<2>, 3> multipliers{Vector<2>(199.1753333731910, -29.75531228015052),
                                             Vector<2>(23.06654119098399, 31.45271365475927),
                                             Vector<2>(22.64249232082739, 11.61740700019673)};
  Squeezer squeezer;
  System system(squeezer.mechanism);
  SqueezerErrors worst;
  advance(system, {.newton = exactly}, 0.03, step,
          [&](System& s) { worst.violation = std::max(worst.violation, violation(s) / s.size()); });
  const auto& [q, v] = std::tie(system.state().q, system.state().v);
  for (std::size_t k = 0; k < 7; ++k) {
    const Body& body = squeezer.bodies[k];
    const double turn = std::remainder(ncf::angle(body, q) - angles[k], 2 * pi);
    worst.angle = std::max(worst.angle, std::abs(turn));
    worst.rate = std::max(worst.rate, std::abs(ncf::angular_velocity(body, q, v) - rates[k]));
  }
  for (std::size_t k = 0; k < 3; ++k)
    worst.multiplier =
        std::max(worst.multiplier,
                 (system.multipliers<joints::Joint<2>>(squeezer.loops[k]) - multipliers[k]).norm());
  return worst;
}

struct Place {
  double t, x, y;
};

/// A mechanism of parallelograms in a row with bars of 1 m and 1 kg, cranks upright and their tops
/// moving along +x with 1 m/s (IFToMM benchmark A02).
struct FourBars {
  Mechanism mechanism;
  Marker<2> top;  // of the first crank

  explicit FourBars(int loops) {
    mechanism.gravity = {0, -9.81};
    std::vector<Bar> cranks;
    for (int k = 0; k <= loops; ++k) {
      ncf::Bar crank = thin_bar({k, 0}, {k, 1});
      crank.angular_velocity = -1;
      cranks.push_back(mechanism.add(crank));
      mechanism.add(joints::pinned(cranks.back().start(), mechanism.q()));
    }
    for (std::size_t k = 0; k + 1 < cranks.size(); ++k) {
      const double x = static_cast<double>(k);
      ncf::Bar coupler = thin_bar({x, 1}, {x + 1, 1});
      coupler.velocity = {1, 0};
      const Bar placed = mechanism.add(coupler);
      mechanism.add(joints::revolute(cranks[k].end(), placed.start()));
      mechanism.add(joints::revolute(cranks[k + 1].end(), placed.end()));
    }
    top = cranks.front().end();
  }
};

/// Bar of the sliding double pendulum: 1 m, 2.67 kg, of square section.
ncf::Bar square_bar(const Vector<2>& from, const Vector<2>& to) {
  return {.from = from, .to = to, .density = 349.45, .area = 0.0874 * 0.0874, .height = 0.0874};
}

/// Largest distance of a point from a table of its places.
template <std::size_t rows>
double largest_distance(Mechanism& mechanism, const Marker<2>& point,
                        const GeneralizedAlpha& integrator, double step,
                        const std::array<Place, rows>& table) {
  System system(mechanism);
  double largest = 0;
  for (const auto& [t, x, y] : table) {
    advance(system, integrator, t, step);
    largest = std::max(largest, (point.at(system.state().q) - Vector<2>(x, y)).norm());
  }
  return largest;
}

struct SliderCrankErrors {
  double angle, rate, slider;
};

/// Crank of 0.1 m under a constant torque, rod of 0.3 m and slider, from rest with the crank along
/// the guide, against the solution of the equation of the crank's angle at t = 1 s.
SliderCrankErrors turn_slider_crank(double step, double spectral_radius) {
  Mechanism mechanism;
  const auto crank = mechanism.add(thin_bar({0, 0}, {.1, 0}, .2));
  const auto rod = mechanism.add(thin_bar({.1, 0}, {.4, 0}, .2));
  const auto slider =
      mechanism.add(ncf::PlanarBody{.inertia = {.mass = .4, .polar = 1e-3}, .position = {.4, 0}});
  const auto pin = slider.point({0, 0});
  mechanism.add(joints::pinned(crank.start(), mechanism.q(), "bearing"));
  mechanism.add(joints::revolute(crank.end(), rod.start(), "crank pin"));
  mechanism.add(joints::revolute(rod.end(), pin, "piston pin"));
  mechanism.add(joints::prismatic(joints::ground_frame<2>({0, 0}), joints::frame(slider),
                                  ground<2>({1, 0}), mechanism.q(), "guide"));
  mechanism.add(forces::Torque<2>{.on = crank.vector({0, 0}, {1, 0}), .value = .1});
  System system(mechanism);
  double turned = 0, last = 0;
  advance(system, {.spectral_radius = spectral_radius, .newton = exactly}, 1, step, [&](System& s) {
    const double angle = ncf::angle(crank, s.state().q);
    turned += std::remainder(angle - last, 2 * std::numbers::pi);
    last = angle;
  });
  const auto& [q, v] = std::tie(system.state().q, system.state().v);
  return {std::abs(turned - 14.12789222),
          std::abs(ncf::angular_velocity(crank, q, v) - 20.53748285),
          std::abs(pin.at(q)[0] - 0.283771692)};
}

}  // namespace

TEST_CASE("Andrews' squeezing mechanism ends as the test set for IVP solvers says", "[mbs]") {
  const SqueezerErrors coarse = squeeze(1e-5), fine = squeeze(5e-6);
  CAPTURE(fine.angle, fine.rate, fine.multiplier, fine.violation);
  CHECK(fine.angle < 2e-4);        // of 15.8 rad
  CHECK(fine.rate < 0.1);          // of 1424 rad/s
  CHECK(fine.multiplier < 0.025);  // of 200 N
  CHECK(std::log2(coarse.angle / fine.angle) == Approx(2).margin(0.1));
  CHECK(std::log2(coarse.rate / fine.rate) == Approx(2).margin(0.1));
  CHECK(std::log2(coarse.multiplier / fine.multiplier) == Approx(2).margin(0.15));
  CHECK(fine.violation < 1e-9);
}

TEST_CASE("a physical double pendulum follows its equations of minimal coordinates", "[mbs]") {
  constexpr std::array<Place, 7> tip{{{0.1, -1.000757736, -1.055138571},
                                      {0.2, -1.012237553, -1.219242493},
                                      {0.3, -1.063205028, -1.472535499},
                                      {0.4, -1.154571708, -1.630156519},
                                      {0.5, -0.916897204, -1.495833566},
                                      {1, 1.444584735, -0.545810850},
                                      {2, -0.460987110, -1.570857623}}};
  const auto error = [&](double rho, double step) {
    Mechanism mechanism = test::double_pendulum<Mechanism>(square_bar({0, 0}, {-1, 0}),
                                                           square_bar({-1, 0}, {-1, -1}));
    const Marker<2> end = mechanism.all<ncf::Bar>()[1].end();
    return largest_distance(mechanism, end, {.spectral_radius = rho}, step, tip);
  };
  for (const double rho : {1.0, 0.8}) {
    const double coarse = error(rho, 1e-3), fine = error(rho, 5e-4);
    CAPTURE(rho, coarse, fine);
    CHECK(fine < 4e-5);
    CHECK(std::log2(coarse / fine) > 1.8);
  }
}

TEST_CASE("a slider-crank turns as the equation of its angle says", "[mbs]") {
  for (const double rho : {1.0, 0.8}) {
    const SliderCrankErrors coarse = turn_slider_crank(1e-3, rho),
                            fine = turn_slider_crank(5e-4, rho);
    CAPTURE(rho, fine.angle, fine.rate, fine.slider);
    CHECK(fine.angle < 1.5e-3);  // of 14 rad
    CHECK(fine.rate < 1e-2);
    CHECK(fine.slider < 1.5e-4);
    CHECK(std::log2(coarse.angle / fine.angle) == Approx(2).margin(0.2));
  }
}

TEST_CASE("parallelograms in a row pass through the positions with all bars in line", "[mbs]") {
  // Both loops could fold there; Phi_q loses rank.
  constexpr std::array<Place, 6> top{{{1, -0.195020302, -0.980799206},
                                      {2, 0.057815796, 0.998327268},
                                      {3, -0.549339739, -0.835599097},
                                      {4, 0.117616102, 0.993059138},
                                      {5, -0.811310461, -0.584615545},
                                      {10, 0.328458112, 0.944518538}}};
  for (const double rho : {1.0, 0.8, 0.5}) {
    FourBars model(2);
    const double largest =
        largest_distance(model.mechanism, model.top, {.spectral_radius = rho}, 1e-3, top);
    CAPTURE(rho, largest);
    CHECK(largest < 1.5e-3);
  }
  FourBars model(2);
  System system(model.mechanism);
  const double start = system.energies().total();
  double drift = 0, worst = 0;
  int in_line = 0;
  bool above = true;
  advance(system, {}, 10, 1e-3, [&](System& s) {
    drift = std::max(drift, std::abs(s.energies().total() - start));
    worst = std::max(worst, violation(s));
    const bool now = model.top.at(s.state().q)[1] > 0;
    in_line += now != above;
    above = now;
  });
  CHECK(in_line >= 10);
  CHECK(drift < 1e-4 * start);
  CHECK(worst < 1e-9 * system.size());
}
