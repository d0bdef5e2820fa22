// SPDX-License-Identifier: MIT
// A run that is saved, forgotten and restored goes on with the same bits as one that is not.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include <sphmbs/io/checkpoints.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/mbs/solvers/sparse_ldlt.hpp>

#include "support/ball_in_gas.hpp"
#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/policies.hpp"
#include "support/setups.hpp"

namespace {

using namespace sphmbs;
using test::same_bits;

/// A system and what its run is stepped by: `make` builds it as at time 0.
template <class Make, class Step, class State>
void check(const Make& make, const Step& step, const State& state_of, int steps) {
  const auto path =
      std::filesystem::temp_directory_path() / ("sphmbs_restart_" + std::to_string(::getpid()));
  const auto straight = make();
  for (int k = 0; k < steps; ++k) step(*straight);
  const auto expected = state_of(*straight);
  for (const int saved : {1, 7, steps - 1}) {
    CAPTURE(saved);
    io::Checkpoints checkpoints(path);
    {
      const auto first = make();
      for (int k = 0; k < saved; ++k) step(*first);
      checkpoints.write(1, {}, [&](io::StateWriter& w) { w("system", *first); });
    }
    const auto second = make();
    io::CheckpointFile file(checkpoints.list().at(0));
    io::StateReader reader(file);
    reader("system", *second);
    for (int k = saved; k < steps; ++k) step(*second);
    CHECK(same_bits(state_of(*second), expected));
  }
  std::filesystem::remove_all(path);
}

/// All numbers of the particles, in the order in which they are kept.
template <class Fluid>
std::vector<double> stored_state(Fluid& fluid) {
  using Policy = typename Fluid::PolicyType;
  const auto f = fluid.particles().fields();
  std::vector<double> all{fluid.time(), fluid.exchange().wall_work(), fluid.exchange().body_work(),
                          static_cast<double>(fluid.statistics().pair_interactions)};
  const auto add = [&]<class T>(const T* field) {
    std::vector<T> numbers(fluid.size());
    Policy::download(numbers.data(), field, fluid.size() * sizeof(T));
    all.insert(all.end(), numbers.begin(), numbers.end());
  };
  for (int k = 0; k < Fluid::dim; ++k) {
    add(f.r[k]);
    add(f.v[k]);
  }
  add(f.rho);
  add(f.e);
  add(f.h);
  add(f.id);
  return all;
}

constexpr auto step_gas = [](auto& fluid) {
  time::PredictorCorrector{}.step(fluid, [&] { return sph::step_limit(fluid.survey(), 0.3).dt; });
};

template <class Policy, class Setup>
void check_gas(const Setup& setup) {
  using Fluid = decltype(setup.template fluid<Policy>());
  check([&] { return std::make_unique<Fluid>(setup.template fluid<Policy>()); }, step_gas,
        [](Fluid& fluid) { return stored_state(fluid); }, 24);
}

/// Coordinates, rates, accelerations, multipliers and energies.
template <class Bodies>
std::vector<double> motion_of(Bodies& bodies) {
  const mbs::State& s = bodies.state();
  const mbs::Energies e = bodies.energies();
  std::vector<double> all{s.t, e.total(), e.dissipated, e.work};
  for (const mbs::VectorXd* x : {&s.q, &s.v, &s.vdot, &s.lambda})
    all.insert(all.end(), x->begin(), x->end());
  return all;
}

using Mechanism = mbs::Structure<mbs::ancf::Cable<2>, mbs::ncf::Bar, mbs::joints::Joint<2>,
                                 mbs::joints::Sliding<mbs::ancf::Cable<2>>>;

/// A bar that slides along a cable, from element to element.
Mechanism slider() {
  Mechanism m;
  m.gravity = {0, -9.81};
  const auto cable = mbs::ancf::line(m, {.from = {0, 0},
                                         .to = {1, -0.3},
                                         .elements = 12,
                                         .radius = 0.002,
                                         .density = 1100,
                                         .youngs_modulus = 5e6});
  m.add(mbs::joints::pinned(cable.start(), m.q(), "left"));
  m.add(mbs::joints::pinned(cable.end(), m.q(), "right"));
  const mbs::Vector<2> at = cable.point(0.2).at(m.q());
  const auto bar = m.add(
      mbs::ncf::Bar{.from = at, .to = at - mbs::Vector<2>(0, 0.3), .density = 780, .area = 1e-4});
  m.add(mbs::joints::sliding(m, cable.elements, {.slider = bar.start(), .at = 0.2}));
  return m;
}

template <class Solver>
struct Sliding {
  Mechanism mechanism = slider();
  mbs::Dynamics<Mechanism, Solver> bodies{mechanism};
  template <Archive A>
  void visit_state(A& archive) {
    bodies.visit_state(archive);
  }
};

/// A disk that drifts and spins in gas.
struct Coupled {
  test::BallInGas<sph::SmoothScheme<2>, execution::OpenMP> ball{
      {.velocity = {0.3, 0}, .spin = 0.5, .disorder = 3}};
  template <Archive A>
  void visit_state(A& archive) {
    ball.system.visit_state(archive);
  }
};

template <class Coupling>
void check_ball(const Coupling& coupling) {
  check([] { return std::make_unique<Coupled>(); },
        [&](Coupled& c) {
          coupling.step(c.ball.system,
                        [&] { return sph::step_limit(c.ball.system.survey(), 0.3).dt; });
        },
        [](Coupled& c) {
          std::vector<double> all = stored_state(c.ball.fluid);
          const std::vector<double> motion = motion_of(c.ball.bodies);
          all.insert(all.end(), motion.begin(), motion.end());
          return all;
        },
        20);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("restored gas goes on to the bit: periodic, 1D to 3D", "[restart][fault]",
                        test::Policies) {
  check_gas<TestType>(test::cube_setup<test::Gas<1>>(60));
  check_gas<TestType>(test::cube_setup<sph::SmoothScheme<2, sph::Newtonian>>(20));
  check_gas<TestType>(test::cube_setup<sph::ShockScheme<3>>(10));
}

TEMPLATE_LIST_TEST_CASE(
    "restored gas goes on to the bit: walls, thin plate, moving walls, openings",
    "[restart][fault]", test::Policies) {
  check_gas<TestType>(test::channel_setup<sph::SmoothScheme<2>>());
  check_gas<TestType>(test::cavity_setup());
  check_gas<TestType>(test::stream_setup());
}

TEMPLATE_TEST_CASE("restored bodies go on to the bit, along a sliding joint", "[restart][fault]",
                   mbs::solvers::SparseLU, mbs::solvers::SparseLDLT) {
  using System = Sliding<TestType>;
  const auto run = [&](const mbs::GeneralizedAlpha& integrator, int steps) {
    check([] { return std::make_unique<System>(); },
          [&](System& s) { integrator.step(s.bodies, [] { return 2e-3; }); },
          [](System& s) { return motion_of(s.bodies); }, steps);
  };
  run({.spectral_radius = 0.8}, 200);
  run({.spectral_radius = 0.8, .accuracy = 1e-6}, 200);
}

TEST_CASE("a restored body in gas goes on to the bit", "[restart][fault]") {
  check_ball(coupling::Staggered<>{});
  check_ball(coupling::Strong<>{});
}
