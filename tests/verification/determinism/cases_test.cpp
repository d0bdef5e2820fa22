// SPDX-License-Identifier: MIT
// The set-ups of the cases, at a coarse spacing: every bit of every particle after fifty steps is
// the same in one thread, in several, and without threads.
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "reference/gas_cylinder_curves.hpp"
#include "reference/shock_tube_curves.hpp"
#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::Vec;

template <int Dim, class MotionType = sphmbs::boundary::Fixed>
struct Setup {
  sphmbs::geometry::Domain<Dim> domain;
  sphmbs::particles::Cloud<Dim> cloud;
  test::Gas<Dim> gas{.eos = {.gamma = 1.4}};
  MotionType motion{};
};

template <int Dim>
struct End {
  test::State<Dim> state;
  double time;
  double wall_work;
  double body_work;
  Vec<Dim> impulse;
  sphmbs::sph::Totals<Dim> totals;
  std::uint64_t pairs;
  std::uint64_t rebuilds;
};

template <class Policy, int Dim, class Motion>
End<Dim> fifty_steps(const Setup<Dim, Motion>& setup) {
  sphmbs::sph::Fluid<test::Gas<Dim>, Policy, Motion> fluid(setup.gas, setup.domain, setup.cloud,
                                                           setup.motion);
  const sphmbs::time::PredictorCorrector integrator;
  for (int step = 0; step < 50; ++step)
    integrator.step(fluid, [&] { return sphmbs::sph::step_limit(fluid.survey(), 0.25).dt; });
  return {test::state_of(fluid),
          fluid.time(),
          fluid.exchange().wall_work(),
          fluid.exchange().body_work(),
          fluid.exchange().impulse(),
          fluid.totals(),
          fluid.statistics().pair_interactions,
          fluid.statistics().rebuilds};
}

template <int Dim, class Motion>
void check(const Setup<Dim, Motion>& setup) {
  const auto expected = fifty_steps<sphmbs::execution::Serial>(setup);
  // Something happened that could go differently.
  CHECK(expected.rebuilds > 1);
  CHECK(expected.totals.kinetic > 0);
  for (const int count : {1, 2, 3, 4}) {
    CAPTURE(count);
    const test::Threads threads(count);
    const auto end = fifty_steps<sphmbs::execution::OpenMP>(setup);
    CHECK(same_bits(end.state, expected.state));
    CHECK(test::same_bits(end.time, expected.time));
    CHECK(test::same_bits(end.wall_work, expected.wall_work));
    CHECK(test::same_bits(end.body_work, expected.body_work));
    CHECK(test::same_bits(end.impulse, expected.impulse));
    CHECK(test::same_bits(end.totals, expected.totals));
    CHECK(end.pairs == expected.pairs);
    CHECK(end.rebuilds == expected.rebuilds);
  }
}

}  // namespace

TEST_CASE("a pipe with walls and a cylinder has the same bits on any threads",
          "[determinism][fault]") {
  const double dx = 1;
  const sphmbs::geometry::Box<2> pipe{.lower = {0, 0}, .upper = {100, 50}};
  const sphmbs::geometry::Box<2> between{.lower = {-100, 0}, .upper = {200, 50}};
  const sphmbs::geometry::Ball<2> cylinder{.centre = {40, 25}, .radius = 10 + 0.01 * dx};
  const sphmbs::geometry::Lattice<2> lattice{.spacing = dx};
  const sphmbs::particles::State<2> at_rest{.rho = 1, .p = 841};
  Setup<2> setup{.domain = {.box = pipe, .periodic = {true, false}}, .cloud = {}};
  setup.cloud.add_gas(lattice.points(pipe - cylinder, setup.domain), at_rest, {dx});
  setup.cloud.add_virtual(
      lattice.inner_points(between.grown(5.5 * dx) - between, setup.domain, 6 * dx), at_rest, {dx});
  setup.cloud.add_virtual(sphmbs::examples::ring(lattice, setup.domain, cylinder), at_rest, {dx});
  setup.gas.acceleration = {3, 0};
  check(setup);
}

TEST_CASE("a cavity with moving walls has the same bits on any threads", "[determinism][fault]") {
  const double dx = 0.05;
  const sphmbs::geometry::Box<2> cavity{.lower = {-0.5, -0.5}, .upper = {0.5, 0.5}};
  const sphmbs::geometry::Lattice<2> lattice{.spacing = dx,
                                             .origin = cavity.lower + Vec<2>::all(dx / 2)};
  const sphmbs::particles::State<2> at_rest{.rho = 1.293, .p = 1e4};
  // Walls a hundred times faster than the case's, so that fifty steps move them by many spacings.
  Setup<2, sphmbs::boundary::Contraction> setup{
      .domain = {.box = cavity}, .cloud = {}, .motion = {.length = 1, .speed = 50}};
  setup.cloud.add_gas(lattice.points(cavity, setup.domain), at_rest, {dx});
  setup.cloud.add_virtual(lattice.points(cavity.grown(5 * dx) - cavity, setup.domain, 5 * dx),
                          at_rest, {dx});
  check(setup);
}

TEST_CASE("a shock tube has the same bits on any threads", "[determinism][fault]") {
  const sphmbs::examples::SodTube<1> tube(0.5 / 712);
  Setup<1> setup{.domain = tube.domain(), .cloud = {}};
  tube.fill(setup.cloud);
  check(setup);
}

TEST_CASE("a periodic box in 3D has the same bits on any threads", "[determinism][fault]") {
  const double dx = 0.1;
  const Setup<3> setup{.domain = test::cube<3>(12 * dx, true),
                       .cloud = test::disordered_cloud<3>(12, dx, 31)};
  check(setup);
}
