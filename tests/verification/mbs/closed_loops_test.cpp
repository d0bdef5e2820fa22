// SPDX-License-Identifier: MIT
// Spatial mechanisms: a top, and closed loops whose joints hold more than they need to.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/mbs/ncf/readout.hpp>
#include <sphmbs/mbs/ncf/rigid_body.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance, test::exactly, test::violation;

namespace {

using Planar = Structure<ncf::PlanarBody, joints::Joint<2>>;
using Spatial = Structure<ncf::RigidBody, joints::Joint<3>>;
using Motion = test::SingleThreaded<Spatial>;
using PlanarMotion = test::SingleThreaded<Planar>;
using Body = Placed<ncf::RigidBody>;

Vector<3> in_space(const Vector<2>& x) { return {x[0], x[1], 0}; }

/// Corners of a four-bar linkage; the last two stay where they are.
const std::array<Vector<2>, 4> corners{Vector<2>(0, 0), Vector<2>(0.2, 0.8), Vector<2>(1.6, 1.2),
                                       Vector<2>(1.5, 0)};
/// A point of each body, in its axes.
const Vector<3> somewhere(0.3, 0.1, 0.05);

/// Its three bodies with hinges at corners 0 to 3, all about z in space.
struct FourBar {
  Planar planar;
  Spatial spatial;
  std::vector<Placed<ncf::PlanarBody>> flat;
  std::vector<Body> bodies;

  FourBar() {
    planar.gravity = {0, -9.81};
    spatial.gravity = {0, -9.81, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector<2> along = corners[k + 1] - corners[k];
      const double angle = std::atan2(along[1], along[0]), half = along.norm() / 2;
      const double mass = std::array{1.0, 2.0, 1.5}[k];
      const ncf::Inertia inertia = ncf::shifted(ncf::box(mass, {2 * half, 0.2, 0.1}), {half, 0, 0});
      bodies.push_back(
          spatial.add(ncf::RigidBody{.inertia = inertia,
                                     .orientation = Eigen::AngleAxisd(angle, Vector<3>::UnitZ()),
                                     .position = in_space(corners[k])}));
      flat.push_back(planar.add(ncf::PlanarBody{
          .inertia = {.mass = mass, .centre = {half, 0}, .polar = inertia.tensor(2, 2)},
          .position = corners[k],
          .angle = angle}));
    }
    hinge(joints::ground_frame(in_space(corners[0])), ground(corners[0]), 0, 0, "A");
    for (std::size_t k = 0; k < 2; ++k) {
      const double length = (corners[k + 1] - corners[k]).norm();
      hinge(joints::frame(bodies[k], Vector<3>(length, 0, 0)), flat[k].point({length, 0}), k + 1, 0,
            k == 0 ? "B" : "C");
    }
    hinge(joints::ground_frame(in_space(corners[3])), ground(corners[3]), 2,
          (corners[3] - corners[2]).norm(), "D");
  }

 private:
  void hinge(const joints::Frame<3>& frame, const Marker<2>& point, std::size_t body, double at,
             const char* name) {
    const auto axis = bodies[body].vector({0, 0, 0}, {0, 0, 1});
    spatial.add(joints::revolute(frame, bodies[body].point({at, 0, 0}), axis, spatial.q(), name));
    planar.add(joints::revolute(point, flat[body].point({at, 0}), name));
  }
};

/// Bricard's loop of six equal links along the edges of a cube, the last of them fixed, hinged at
/// the corners about the directions square to both neighbours.
struct Bricard {
  static constexpr std::size_t n = 6;
  std::array<Vector<3>, n> start{Vector<3>(0, 0, 0),  Vector<3>(1, 0, 0),  Vector<3>(1, -1, 0),
                                 Vector<3>(1, -1, 1), Vector<3>(0, -1, 1), Vector<3>(0, 0, 1)};
  Spatial mechanism;
  std::vector<Body> links;

  Bricard() {
    mechanism.gravity = {0, -9.81, 0};
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const Vector<3> along = start[k + 1] - start[k], next = start[(k + 2) % n] - start[k + 1];
      links.push_back(mechanism.add(ncf::RigidBody{
          .inertia = ncf::shifted(ncf::box(1, {1, 0.1, 0.1}), {0.5, 0, 0}),
          .orientation = ncf::through_points(start[k], start[k + 1], start[k] + next.cross(along)),
          .position = start[k]}));
    }
    hinge(joints::ground_frame(start[0]), links[0].point({0, 0, 0}),
          links[0].vector({0, 0, 0}, {0, 0, 1}), 0);
    for (std::size_t k = 1; k < links.size(); ++k)
      hinge(joints::frame(links[k]), links[k - 1].point({1, 0, 0}), axis_at_end(k - 1), k);
    hinge(joints::ground_frame(start[5]), links[4].point({1, 0, 0}), axis_at_end(4), 5);
  }

  /// Cosines of the angles between links that meet.
  std::array<double, n> cosines(const VectorXd& q) const {
    std::array<Vector<3>, n> along;
    for (std::size_t k = 0; k < links.size(); ++k)
      along[k] = links[k].vector({0, 0, 0}, {1, 0, 0}).at(q);
    along[n - 1] = start[0] - start[n - 1];
    std::array<double, n> c;
    for (std::size_t k = 0; k < n; ++k) c[k] = along[k].dot(along[(k + n - 1) % n]);
    return c;
  }

 private:
  Marker<3> axis_at_end(std::size_t link) const { return links[link].vector({0, 0, 0}, {0, 1, 0}); }
  void hinge(const joints::Frame<3>& a, const Marker<3>& point, const Marker<3>& axis,
             std::size_t corner) {
    mechanism.add(joints::revolute(a, point, axis, mechanism.q(), "P" + std::to_string(corner)));
  }
};

struct TopErrors {
  double place, rate;
};

/// Heavy top on a fixed point that spins with 150 rad/s (Bruels, Cardona and Arnold 2012,
/// Mechanism and Machine Theory 48), at 0.5 s against the solution of Euler's equations.
TopErrors spin(double spectral_radius, double step) {
  Spatial mechanism;
  mechanism.gravity = {0, 0, -9.81};
  const Body top = mechanism.add(
      ncf::RigidBody{.inertia = ncf::principal(15, {0.234375, 0.46875, 0.234375}, {0, 1, 0}),
                     .angular_velocity = {0, 150, -4.61538},
                     .angular_velocity_in = ncf::Axes::body});
  mechanism.add(joints::pinned(top.point({0, 0, 0}), mechanism.q(), "foot"));
  Motion system(mechanism);
  advance(system, {.spectral_radius = spectral_radius, .newton = exactly}, 0.5, step);
  const auto& [q, v] = std::tie(system.state().q, system.state().v);
  const Vector<3> centre(-0.70246830, -0.02116518, -0.71140026),
      rates(-0.47105310, 150, 5.90108305);
  return {(top.point({0, 1, 0}).at(q) - centre).norm(),
          (ncf::body_angular_velocity(top, q, v) - rates).norm()};
}

}  // namespace

TEST_CASE("a heavy top follows Euler's equations at second order", "[mbs]") {
  for (const double rho : {1.0, 0.8}) {
    const TopErrors coarse = spin(rho, 1e-4), fine = spin(rho, 5e-5);
    CAPTURE(rho, fine.place, fine.rate);
    CHECK(fine.place < 5e-5);
    CHECK(fine.rate < 8e-3);
    CHECK(std::log2(coarse.place / fine.place) == Approx(2).margin(0.15));
    CHECK(std::log2(coarse.rate / fine.rate) == Approx(2).margin(0.25));
  }
}

TEST_CASE("a spatial four-bar with four revolutes moves as the planar one", "[mbs]") {
  FourBar model;
  Motion system(model.spatial);
  PlanarMotion planar(model.planar);
  CHECK(planar.start().redundant.empty());
  CHECK(system.start().redundant.size() == 3);
  REQUIRE(system.start().notes.size() == 1);
  CHECK(test::mentions(
      system.start().notes[0],
      {"3 redundant condition(s), already held by others: revolute '", "; removed"}));
  CHECK(system.start().notes[0].find("body") == std::string::npos);

  double apart = 0, aside = 0, faster = 0, worst = 0;
  const GeneralizedAlpha integrator{.newton = exactly};
  for (int step = 1; step <= 2000; ++step) {
    integrator.step(system, [] { return 1e-3; });
    integrator.step(planar, [] { return 1e-3; });
    for (std::size_t k = 0; k < 3; ++k) {
      const auto point = model.bodies[k].point(somewhere);
      const auto same = model.flat[k].point(somewhere.head<2>());
      const Vector<3> place = point.at(system.state().q), rate = point.rate(system.state().v);
      apart = std::max(apart, (place.head<2>() - same.at(planar.state().q)).norm());
      faster = std::max(faster, (rate.head<2>() - same.rate(planar.state().v)).norm());
      aside = std::max(aside, std::abs(place[2] - somewhere[2]));
    }
    worst = std::max(worst, violation(system));
  }
  CAPTURE(apart, aside, faster, worst);
  CHECK(apart < 1e-9);
  CHECK(aside < 1e-12);
  CHECK(faster < 1e-8);
  CHECK(worst < 1e-9 * system.size());
  // What the removed conditions could carry is shared, here nothing: all loads are in the plane.
  for (int hinge = 0; hinge < 4; ++hinge) {
    const VectorXd in_space = system.multipliers<joints::Joint<3>>(hinge);
    const VectorXd in_plane = planar.multipliers<joints::Joint<2>>(hinge);
    CHECK((in_space.head<2>() - in_plane).norm() < 1e-6 * in_plane.norm());
    CHECK(in_space.tail(3).norm() < 1e-9);
  }
}

TEST_CASE("loads across the plane of a four-bar are shared with the smallest norm", "[mbs]") {
  FourBar model;
  model.spatial.gravity = {0, 0, -9.81};
  Motion system(model.spatial);
  constexpr int own = ncf::RigidBody::conditions, held = 5;
  VectorXd reactions(3 * own + 4 * held);
  for (int k = 0; k < 3; ++k)
    reactions.segment<own>(k * own) = system.multipliers<ncf::RigidBody>(k);
  for (int k = 0; k < 4; ++k)
    reactions.segment<held>(3 * own + k * held) = system.multipliers<joints::Joint<3>>(k);
  // The force of the ground's hinges is the weight.
  const double weight = 4.5 * 9.81;
  const double carried = reactions[3 * own + 2] + reactions[3 * own + 3 * held + 2];
  CHECK(std::abs(carried - weight) < 1e-9 * weight);
  // Of the smallest norm is what Phi_q spans: it has no part that exerts nothing.
  system.equations().evaluate(system.state());
  const MatrixXd phi_q = MatrixXd(system.equations().jacobian());
  REQUIRE(phi_q.rows() == reactions.size());
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(1e-9);
  qr.compute(phi_q);
  CHECK(qr.rank() == phi_q.rows() - 3);
  const double idle = (reactions - phi_q * qr.solve(reactions)).norm();
  CHECK(idle < 1e-9 * reactions.norm());
}

TEST_CASE("Bricard's loop moves with its one degree of freedom for ten seconds", "[mbs]") {
  Bricard model;
  Motion system(model.mechanism);
  // 5 links of 6 freedoms and 6 hinges of 5 conditions: none would be left but for the redundant
  // one.
  CHECK(system.start().redundant.size() == 1);
  const double start = system.energies().total(), turnover = 5 * 9.81;
  double drift = 0, worst = 0, apart = 0, lowest = 1, highest = -1;
  advance(system, {.newton = exactly}, 10, 2e-3, [&](Motion& s) {
    drift = std::max(drift, std::abs(s.energies().total() - start));
    worst = std::max(worst, violation(s));
    // Every other angle is the same, and the two are related.
    const auto c = model.cosines(s.state().q);
    for (std::size_t k = 2; k < c.size(); ++k) apart = std::max(apart, std::abs(c[k] - c[k % 2]));
    apart = std::max(apart, std::abs(c[0] * c[1] + c[0] + c[1]));
    lowest = std::min(lowest, c[0]);
    highest = std::max(highest, c[0]);
  });
  CAPTURE(drift, worst, apart, lowest, highest);
  CHECK(drift < 2e-6 * turnover);
  CHECK(worst < 1e-9 * system.size());
  CHECK(apart < 1e-10);
  CHECK(highest - lowest > 0.8);
}

TEST_CASE("redundant conditions of closed loops are refused where asked, contradictory ones always",
          "[mbs][fault]") {
  Bricard model;
  CHECK(test::mentions(test::refusal([&] {
                         Motion system(model.mechanism,
                                       StartOptions{.redundant = Redundant::refuse});
                       }),
                       {"1 redundant condition(s), already held by others: revolute '"}));
  // A further hinge that would be met 5e-7 m away.
  FourBar linkage;
  const Vector<3> off(0, 0, 5e-7);
  linkage.spatial.add(joints::spherical(
      linkage.bodies[1].point({0.5, 0, 0}),
      ground<3>(linkage.bodies[1].point({0.5, 0, 0}).at(linkage.spatial.q()) + off), "prop"));
  const std::string text = test::refusal([&] { Motion system(linkage.spatial); });
  CHECK(test::mentions(text, {"contradicts other conditions", "'"}));
}
