// SPDX-License-Identifier: MIT
// What passes between gas and bodies in one evaluation is the same on both sides.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/coupling/wetted_grid.hpp>
#include <sphmbs/coupling/wetted_line.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>

#include "support/ball_in_gas.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"
#include "support/state.hpp"

namespace {

namespace coupling = sphmbs::coupling;
namespace sph = sphmbs::sph;
using sphmbs::Vec;
using sphmbs::mbs::VectorXd;

double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Force, moment about the origin and power.
struct Total {
  Vec<2> force = {};
  double moment = 0;
  double power = 0;
  double size = 0;  // of the forces without their directions [N]
};

/// What the gas's particles get, from their rates.
template <class Ball>
Total on_gas(Ball& ball) {
  const auto rates = test::rates_by_id(ball.fluid);
  const auto state = test::state_of(ball.fluid);
  Total total;
  for (std::size_t i = 0; i < ball.fluid.gas_count(); ++i) {
    const Vec<2> f = state.m[i] * rates.v[i];
    total.force += f;
    total.moment += cross(state.r[i], f);
  }
  return total;
}

/// What the body gets, from its generalized force: by the virtual work of unit motions.
template <class Ball>
Total on_body(Ball& ball) {
  ball.system.read();
  const VectorXd Q = ball.system.load_at(0);
  const auto& q = ball.bodies.state().q;
  Total total;
  total.force = {Q[0], Q[1]};
  VectorXd turn(4);
  turn << -q[1], q[0], -q[3], q[2];
  total.moment = Q.dot(turn);
  total.power = Q.dot(ball.bodies.state().v);
  for (const Vec<2>& f : ball.surface.forces()) total.size += std::sqrt(norm2(f));
  return total;
}

}  // namespace

TEMPLATE_TEST_CASE("force, moment and power are the same for gas and body", "[coupling]",
                   sph::PaperScheme<2>, sph::SmoothScheme<2>, sph::ShockScheme<2>) {
  // Nothing but the gas touches the ball, and no particle sees across the box's periodic sides.
  test::BallInGas<TestType> ball({.velocity = {0.2, -0.1}, .spin = 0.7, .disorder = 5});
  ball.system.evaluate();
  const Total gas = on_gas(ball), body = on_body(ball);
  CHECK(body.size > 1);
  const auto accelerated = momentum(ball.body, ball.bodies.state().vdot);
  for (int k = 0; k < 2; ++k) {
    CHECK(gas.force[k] + body.force[k] == Approx(0).margin(1e-12 * body.size));
    CHECK(accelerated[k] == Approx(body.force[k]).margin(1e-12 * body.size));
  }
  CHECK(ball.surface.power(0) == Approx(body.power).margin(1e-12 * body.size));
  CHECK(ball.fluid.survey().wall_power == Approx(body.power).margin(1e-12 * body.size));
  double moment = 0;
  const auto state = test::state_of(ball.fluid);
  for (std::size_t i = 0; i < ball.surface.size(); ++i)
    moment += cross(state.r[ball.fluid.gas_count() + i], ball.surface.forces()[i]);
  CHECK(moment == Approx(body.moment).margin(1e-12 * body.size));
  double by_sets = 0;
  for (const auto& [set, place] : ball.surface.places())
    by_sets += ball.surface.moment_on(set, {0, 0})[0];
  CHECK(by_sets == Approx(body.moment).margin(1e-12 * body.size));
}

TEST_CASE("where gas sticks the force acts on the surface before a particle", "[coupling]") {
  using Gas = sph::SmoothScheme<2, sph::Newtonian, sphmbs::boundary::NoSlip>;
  test::BallInGas<Gas> ball({.velocity = {0.2, -0.1}, .spin = 0.7, .disorder = 5, .sticks = true});
  ball.system.evaluate();
  const Total gas = on_gas(ball), body = on_body(ball);
  for (int k = 0; k < 2; ++k)
    CHECK(gas.force[k] + body.force[k] == Approx(0).margin(1e-12 * body.size));
  CHECK(ball.fluid.survey().wall_power == Approx(body.power).margin(1e-12 * body.size));
  // The velocity that gas meets is that of the disk's rim.
  const auto state = test::state_of(ball.fluid);
  const double middle = 1.5, radius = 0.6, spin = 0.7;
  ball.fluid.commit(0, 0);
  const auto now = test::state_of(ball.fluid);
  for (std::size_t i = 0; i < ball.surface.size(); ++i) {
    const std::size_t k = ball.fluid.gas_count() + i;
    const Vec<2> d = state.r[k] - Vec<2>{middle, middle};
    const double length = std::sqrt(norm2(d));
    CHECK(now.v[k][0] == Approx(0.2 - spin * radius * d[1] / length).margin(1e-5));
    CHECK(now.v[k][1] == Approx(-0.1 + spin * radius * d[0] / length).margin(1e-5));
  }
}

TEST_CASE("points off their material point carry their lever", "[coupling]") {
  // The generalized force of a load on a point beside an ANCF-like line: against differences of the
  // point's place.
  using sphmbs::mbs::Marker;
  Marker<2> at{.index = {0, 1}, .N = sphmbs::mbs::Matrix<2, 2>::Identity()};
  Marker<2> normal{.index = {2, 3}, .N = sphmbs::mbs::Matrix<2, 2>::Identity()};
  normal.N << 0, -1.5, 1.5, 0;  // the quarter turn of a tangent
  coupling::PointRows<2> rows;
  rows.add({.at = at, .normal = normal, .offset = -0.3}, 0.1);
  rows.assemble();
  VectorXd q(4), v(4);
  q << 0.4, 0.5, 0.8, 0.9;
  v << 0.1, -0.2, 0.3, 0.5;
  const auto place = [&](const VectorXd& x) {
    return rows.depart<2>(x, v, VectorXd::Zero(4))[0].r;
  };
  const double step = 1e-6;
  const Vec<2> rate = (1 / (2 * step)) * (place(q + step * v) - place(q - step * v));
  const auto courses = rows.depart<2>(q, v, VectorXd::Zero(4));
  const Vec<2> f{0.7, -1.1};
  const VectorXd Q = rows.load<2>({f}, courses, 0, 4);
  const auto& c = courses[0];
  CHECK(Q.dot(v) == Approx(dot(f, c.u)).epsilon(1e-12));
  // Its velocity is the rate of its place; the one that gas meets belongs to a lever of -0.2.
  const Vec<2> bare{v[0], v[1]};
  for (int k = 0; k < 2; ++k) {
    CHECK(c.v[k] == Approx(rate[k]).epsilon(1e-8));
    CHECK(c.u[k] - bare[k] == Approx((c.v[k] - bare[k]) * 2 / 3).epsilon(1e-12));
  }
}

TEST_CASE("points off a plate turn with both of its gradients", "[coupling]") {
  using sphmbs::mbs::Marker;
  const auto three = [](int first) {
    return Marker<3>{.index = {first, first + 1, first + 2},
                     .N = sphmbs::mbs::Matrix<3, 3>::Identity()};
  };
  coupling::PointRows<3> rows;
  rows.add({.at = three(0), .offset = -0.3, .along = {three(3), three(6)}}, 0);
  rows.assemble();
  VectorXd q(9), v(9);
  q << 0.4, 0.5, 0.6, 1.1, 0.2, -0.1, 0.3, 0.9, 0.2;
  v << 0.1, -0.2, 0.3, 0.5, 0.7, -0.4, 0.2, 0.6, -0.9;
  const VectorXd none = VectorXd::Zero(9);
  const auto at = [&](const VectorXd& x) { return rows.depart<3>(x, v, none)[0]; };
  const double step = 1e-6;
  const auto ahead = at(q + step * v), behind = at(q - step * v);
  const auto c = at(q);
  for (int k = 0; k < 3; ++k) {
    CHECK(c.v[k] == Approx((ahead.r[k] - behind.r[k]) / (2 * step)).epsilon(1e-8));
    CHECK(c.m[k] == Approx((ahead.n[k] - behind.n[k]) / (2 * step)).epsilon(1e-8));
  }
  const Vec<3> f{0.7, -1.1, 0.4};
  CHECK(rows.load<3>({f}, {c}, 0, 9).dot(v) == Approx(dot(f, c.u)).epsilon(1e-12));
}

TEST_CASE("layers beside lines and grids ride at their distance from them", "[coupling]") {
  namespace mbs = sphmbs::mbs;
  SECTION("a cable on a quarter of a circle") {
    mbs::Structure<mbs::ancf::Cable<2>> structure;
    const auto line =
        mbs::ancf::line(structure, {.elements = 12,
                                    .radius = 0.01,
                                    .density = 1,
                                    .youngs_modulus = 1e5,
                                    .length = 1.5,
                                    .curve = {.value = [](double s) -> mbs::Vector<2> {
                                                return {std::cos(s), std::sin(s)};
                                              },
                                              .gradient = [](double s) -> mbs::Vector<2> {
                                                return {-std::sin(s), std::cos(s)};
                                              }}});
    sphmbs::particles::Cloud<2> cloud;
    std::vector<Vec<2>> patches, normals;
    for (double s = 0.05; s < 1.5; s += 0.1) {
      const auto r = line.point(s).at(structure.q());
      patches.push_back({r[0], r[1]});
      const auto t = line.gradient(s).at(structure.q()).normalized();
      normals.push_back({t[1], -t[0]});
    }
    const auto sides = cloud.add_sheet(patches, normals, {.rho = 1, .p = 1}, {.spacing = 0.1}, 2);
    for (const int set : {sides.front, sides.back}) {
      const auto points = coupling::points_of(line, structure.q(), cloud, set);
      REQUIRE(points.size() == 2 * patches.size());
      for (std::size_t k = 0; k < points.size(); ++k)
        CHECK(points[k].offset == Approx(k < patches.size() ? 0 : -0.1).margin(1e-12));
      coupling::WettedSurface<2> surface;
      surface.tie(cloud, set, points, structure.q());  // refuses other places and normals
    }
  }
  SECTION("a plate") {
    mbs::Structure<mbs::ancf::Plate36> structure;
    const auto grid = mbs::ancf::grid(
        structure,
        {.origin = {1, 2, 3},
         .edge_x = {0, 1, 0},
         .edge_y = {0, 0, 2},
         .elements = {2, 3},
         .plate = {.thickness = 0.01, .density = 1, .youngs_modulus = 1e5, .poisson_ratio = 0.3}});
    sphmbs::particles::Cloud<3> cloud;
    std::vector<Vec<3>> patches;
    for (double y = 2; y <= 3.001; y += 0.25)
      for (double z = 3; z <= 5.001; z += 0.25) patches.push_back({1, y, z});
    const auto sides = cloud.add_sheet(patches, std::vector<Vec<3>>(patches.size(), {-1, 0, 0}),
                                       {.rho = 1, .p = 1}, {.spacing = 0.25}, 2);
    for (const int set : {sides.front, sides.back}) {
      const auto points = coupling::points_of(grid, structure.q(), cloud, set);
      REQUIRE(points.size() == 2 * patches.size());
      for (std::size_t k = 0; k < points.size(); ++k)
        CHECK(points[k].offset == Approx(k < patches.size() ? 0 : -0.25).margin(1e-12));
      coupling::WettedSurface<3> surface;
      surface.tie(cloud, set, points, structure.q());
    }
  }
}

TEST_CASE("generalized-alpha passes a mean load on as momentum to rounding", "[coupling]") {
  using namespace sphmbs::mbs;
  for (const double radius : {0.0, 0.5, 0.8, 0.95}) {
    CAPTURE(radius);
    Structure<ncf::PlanarBody> structure;
    structure.add(ncf::PlanarBody{.inertia = {.mass = 3, .polar = 1}});
    Dynamics<decltype(structure)> bodies(structure);
    const GeneralizedAlpha integrator{.spectral_radius = radius};
    VectorXd Q = VectorXd::Zero(4);
    bodies.start_under(Q);
    MeanLoad load(Q);
    test::Random random(3);
    Vector<2> impulse = Vector<2>::Zero();
    for (int n = 0; n < 50; ++n) {
      const double h = n < 25 ? 0.01 : 0.007;
      Q.head<2>() << random.between(-1, 2), random.between(-3, 1);
      auto end = load.at_end(integrator, Q, h);
      bodies.equations().external_force() = end.load;
      integrator.step(bodies, [&] { return h; });
      load.accept(std::move(end), h);
      impulse += h * Q.head<2>();
      CHECK((3 * bodies.state().v.head<2>() - impulse).norm() < 1e-13);
    }
  }
}

TEST_CASE("forces that observers read are those of the moment", "[coupling]") {
  test::BallInGas<sph::SmoothScheme<2>> ball({.velocity = {0.2, 0}});
  int seen = 0;
  sphmbs::run(ball.system, coupling::Staggered<>{}, {.until = 0.05}, sphmbs::no_report,
              sphmbs::Every(0.02, [&](auto& system) {
                const Vec<2> now = system.fluid().force_on(ball.set);
                const Vec<2> read = system.surface().force_on(ball.set);
                for (int k = 0; k < 2; ++k) CHECK(read[k] == Approx(now[k]).margin(1e-13));
                ++seen;
              }));
  CHECK(seen == 4);
}

using EvolvedWithSlopes = sph::RiemannSph<sphmbs::kernels::QuinticSpline<2>, sphmbs::riemann::Hllc,
                                          sphmbs::eos::IdealGas, sphmbs::reconstruction::Muscl<>>;

TEMPLATE_TEST_CASE("bodies that go another way meet the forces of a whole evaluation there",
                   "[coupling]", sph::PaperScheme<2>, sph::SmoothScheme<2>, EvolvedWithSlopes) {
  test::BallInGas<TestType> ball({.velocity = {0.2, -0.1}, .spin = 0.7, .disorder = 5});
  ball.system.evaluate();
  const double half = 1e-4;
  ball.fluid.stage(half, half, 0.1 * ball.surface.smoothing_length());
  ball.fluid.follow(half);
  ball.system.read();
  const auto first = ball.surface.forces();
  const auto& old = ball.bodies.state();
  ball.system.depart(old.q, 1.3 * old.v, old.vdot);
  ball.fluid.follow(half);
  ball.system.read();
  const auto alone = ball.surface.forces();
  ball.fluid.rates(0);
  ball.system.read();
  const auto whole = ball.surface.forces();
  bool same = true, moved = false;
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (int k = 0; k < 2; ++k) {
      same = same && alone[i][k] == whole[i][k];
      moved = moved || alone[i][k] != first[i][k];
    }
  CHECK(same);
  CHECK(moved);
}

TEST_CASE("the strong coupling sums over the gas's pairs no more often than the staggered one",
          "[coupling]") {
  const auto pairs = [](const auto& scheme) {
    test::BallInGas<sph::SmoothScheme<2>> ball({.mass_ratio = 0.3, .velocity = {0.2, 0}});
    sphmbs::run(ball.system, scheme, {.until = 0.1, .step = 0.01}, sphmbs::no_report);
    return static_cast<double>(ball.fluid.statistics().pair_interactions);
  };
  CHECK(pairs(coupling::Strong<>{}) == Approx(pairs(coupling::Staggered<>{})).epsilon(1e-3));
}

TEST_CASE("a short step before a long one does not blow the load up", "[coupling]") {
  using namespace sphmbs::mbs;
  const GeneralizedAlpha integrator{.spectral_radius = 0.8};
  const VectorXd zero = VectorXd::Zero(1), one = VectorXd::Ones(1);
  MeanLoad load(zero);
  double largest = 0;
  for (const double h : {1.0, 1.0, 1e-4, 1.0, 1.0, 1.0}) {
    auto end = load.at_end(integrator, one, h);
    largest = std::max(largest, std::abs(end.load[0]));
    load.accept(std::move(end), h);
  }
  CHECK(largest < 10);
}

TEST_CASE("a system refuses bodies and surfaces that do not fit", "[coupling]") {
  using Gas = sph::SmoothScheme<2, sph::Newtonian, sphmbs::boundary::NoSlip>;
  CHECK(test::mentions(test::refusal([] { test::BallInGas<Gas> ball({.sticks = false}); }),
                       {"lever of the wetted surface", "gas sticks"}));
  CHECK(test::mentions(
      test::refusal([] { test::BallInGas<sph::PaperScheme<2>> ball({.sticks = true}); }),
      {"lever of the wetted surface"}));
}

TEST_CASE("a surface refuses what does not fit", "[coupling]") {
  using sphmbs::particles::Cloud;
  Cloud<2> cloud;
  const sphmbs::particles::State<2> still{.rho = 1, .p = 1};
  const int set = cloud.add_virtual({{0, 0}, {0.1, 0}}, still, {.spacing = 0.1});
  const VectorXd q = VectorXd::Zero(1);
  const sphmbs::mbs::Marker<2> origin;
  const auto points = coupling::points_beside(origin, q, cloud, set);
  const auto refused = [&](int number, auto some) {
    coupling::WettedSurface<2, sphmbs::execution::Serial> surface;
    return test::refusal([&] { surface.tie(cloud, number, some, q); });
  };
  CHECK(refused(set, points).empty());
  CHECK(test::mentions(refused(2, points), {"set of virtual particles = 2", "between 1 and 1"}));
  auto few = points;
  few.pop_back();
  CHECK(test::mentions(refused(set, few), {"points of set 1", "one for each", "2"}));
  auto off = points;
  off[1].at.x0[0] += 0.01;
  CHECK(test::mentions(refused(set, off), {"point 1: distance", "0.01"}));
  CHECK(test::mentions(test::refusal([&] {
                         coupling::WettedSurface<2, sphmbs::execution::Serial> deep;
                         deep.tie(cloud, set, points, q, 0);
                       }),
                       {"depth of a body", "positive"}));
  coupling::WettedSurface<2, sphmbs::execution::Serial> surface;
  CHECK(test::mentions(test::refusal([&] { surface.motion(); }), {"wetted particles = 0"}));
  surface.tie(cloud, set, points, q);
  CHECK(test::mentions(test::refusal([&] { surface.tie(cloud, set, points, q); }), {"tied once"}));
  surface.motion();
  const int late = cloud.add_virtual({{0.5, 0}}, still, {.spacing = 0.1});
  CHECK(test::mentions(test::refusal([&] {
                         surface.tie(cloud, late, coupling::points_beside(origin, q, cloud, late),
                                     q);
                       }),
                       {"tied after motion()", "before the gas is made"}));
  CHECK(test::mentions(test::refusal([&] { surface.force_on(2); }), {"rides on a body"}));

  const auto scheme = [](auto wrong) { return test::refusal([&] { wrong.check(); }); };
  CHECK(test::mentions(scheme(coupling::Staggered<>{.structure = {.spectral_radius = 1}}),
                       {"spectral_radius", "below 1"}));
  CHECK(test::mentions(scheme(coupling::Staggered<>{.structure = {.accuracy = 1e-3}}),
                       {"accuracy", "0.001"}));
  CHECK(test::mentions(scheme(coupling::Staggered<>{.gas_steps = 0}), {"gas_steps"}));
  CHECK(test::mentions(scheme(coupling::Strong<>{.tolerance = 0}), {"tolerance"}));
  CHECK(test::mentions(scheme(coupling::Strong<>{.repeat = {.most = 0}}), {"number of changes"}));
}
