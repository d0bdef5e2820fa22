// SPDX-License-Identifier: MIT
// Lists and rates where gas and walls move fast, against all pairs.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"

namespace {

using namespace sphmbs;

/// Ordered pairs inside their support at the present stage, by all pairs.
template <class Fluid>
std::uint64_t true_pairs(Fluid& fluid) {
  constexpr int dim = Fluid::dim;
  const auto space = fluid.domain().template periodicity<double>();
  const double* records = fluid.particles().records();
  std::uint64_t count = 0;
  for (std::size_t a = 0; a < fluid.size(); ++a)
    for (std::size_t b = 0; b < fluid.size(); ++b) {
      const auto s = particles::load_record<dim>(records, a);
      const auto t = particles::load_record<dim>(records, b);
      const double reach = Fluid::SchemeType::Kernel::support * (s.h + t.h) / 2;
      if (a != b && norm2(space.nearest(t.r - s.r)) < reach * reach) ++count;
    }
  return count;
}

/// Steps a fluid and counts the evaluations of the rates that missed a pair.
template <class Fluid>
struct Watched {
  Fluid& fluid;
  int missed = 0;
  void stage(double scale, double dt) { fluid.stage(scale, dt); }
  void rates(double keep) {
    fluid.rates(keep);
    if (fluid.survey().pairs != true_pairs(fluid)) ++missed;
  }
  void commit(double scale, double dt) { fluid.commit(scale, dt); }
};

template <int Dim>
using Gas = sph::RiemannSph<kernels::QuinticSpline<Dim>, riemann::Acoustic, eos::IdealGas>;

/// A wall at a constant speed along x.
struct Slide {
  double u;  // [m/s]
  template <int Dim, class T>
  Vec<Dim, T> position(sphmbs::boundary::Mark, Vec<Dim, T> r, double from, double to) const {
    r[0] += static_cast<T>(u * (to - from));
    return r;
  }
  template <int Dim, class T>
  Vec<Dim, T> velocity(sphmbs::boundary::Mark, const Vec<Dim, T>&, double) const {
    Vec<Dim, T> v = Vec<Dim, T>::all(T(0));
    v[0] = static_cast<T>(u);
    return v;
  }
};

/// A wall that swings along x, from rest.
struct Swing {
  double amplitude;  // [m]
  double frequency;  // [rad/s]
  template <int Dim, class T>
  Vec<Dim, T> position(sphmbs::boundary::Mark, Vec<Dim, T> r, double from, double to) const {
    r[0] += static_cast<T>(amplitude * (std::cos(frequency * from) - std::cos(frequency * to)));
    return r;
  }
  template <int Dim, class T>
  Vec<Dim, T> velocity(sphmbs::boundary::Mark, const Vec<Dim, T>&, double t) const {
    Vec<Dim, T> v = Vec<Dim, T>::all(T(0));
    v[0] = static_cast<T>(amplitude * frequency * std::sin(frequency * t));
    return v;
  }
};

/// Evaluations that miss a pair while a wall follows cold gas of a speed.
template <class Integrator, class Motion>
int missed_behind(const Motion& motion, double gas_speed, double p, double dt) {
  const double dx = 0.05;
  const geometry::Domain<2> domain{.box = {{0, 0}, {3, 0.5}}};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(geometry::Box<2>{{1, 0}, {1.5, 0.5}}, domain),
                {.rho = 1, .p = p, .v = {gas_speed, 0}}, {dx});
  cloud.add_virtual(lattice.points(geometry::Box<2>{{0.6, 0}, {0.85, 0.5}}, domain),
                    {.rho = 1, .p = p}, {dx});
  sph::Fluid<Gas<2>, execution::Serial, Motion> fluid({}, domain, std::move(cloud), motion);
  Watched<decltype(fluid)> watched{fluid};
  for (int step = 0; step < 40; ++step) Integrator{}.step(watched, [&] { return dt; });
  return watched.missed;
}

}  // namespace

TEMPLATE_TEST_CASE("a uniform gas that flies through a periodic box stays uniform", "[sph]",
                   time::PredictorCorrector, time::Heun, time::ShuOsher) {
  const double dx = 0.02;
  const geometry::Domain<1> domain{.box = {{0.0}, {1.0}}, .periodic = {true}};
  const geometry::Lattice<1> lattice{.spacing = dx, .origin = {dx / 2}};
  particles::Cloud<1> cloud;
  const double mach = 20;  // a step at cfl 0.4 carries the gas by ten spacings
  cloud.add_gas(lattice.points(domain.box, domain), {.rho = 1, .p = 1 / 1.4, .v = {mach}}, {dx});
  sph::Fluid<Gas<1>, execution::Serial> fluid({}, domain, std::move(cloud));
  Watched<decltype(fluid)> watched{fluid};
  for (int step = 0; step < 20; ++step)
    TestType{}.step(watched, [&] { return sph::step_limit(fluid.survey(), 0.4).dt; });
  CHECK(watched.missed == 0);
  const double* rho = fluid.particles().fields().rho;
  // Positions are rounded at the border, which a lattice's zero rates feel to rounding.
  for (std::size_t i = 0; i < fluid.size(); ++i) CHECK(rho[i] == Approx(1).epsilon(1e-10));
}

TEMPLATE_TEST_CASE("lists miss no pair where a wall catches up with gas", "[sph]",
                   time::PredictorCorrector, time::Heun, time::ShuOsher) {
  CHECK(missed_behind<TestType>(Slide{1}, 0.5, 1e-9, 0.005) == 0);
  CHECK(missed_behind<TestType>(Slide{1.5}, 1.0, 1e-9, 0.005) == 0);
}

TEMPLATE_TEST_CASE("lists miss no pair where a wall starts from rest", "[sph]",
                   time::PredictorCorrector, time::Heun, time::ShuOsher) {
  CHECK(missed_behind<TestType>(Swing{0.1, 3}, 0, 1e-4, 0.01) == 0);
}

TEST_CASE("several periods away is wrapped back within one step", "[sph]") {
  const geometry::Domain<1> domain{.box = {{0.0}, {1.0}}, .periodic = {true}};
  const auto space = domain.periodicity<double>();
  CHECK(space.wrap(Vec<1>{28.55})[0] == Approx(0.55));
  CHECK(space.wrap(Vec<1>{-3.25})[0] == Approx(0.75));
}

TEST_CASE("fields in float do not slow walls down", "[boundary]") {
  // The walls' own rounding, 6e-8 a step at most, over 1000 steps.
  const boundary::Contraction walls{.length = 1, .speed = 0.5};
  Vec<2, float> r{0.5f, 0.5f};
  double t = 0.5;
  for (int step = 0; step < 1000; ++step, t += 1e-7) r = walls.position({1, 0}, r, t, t + 1e-7);
  CHECK(static_cast<double>(r[0]) == Approx(0.5 * walls.length_at(t) / 0.5).epsilon(6e-5));
}

TEST_CASE("driving work balances the energies in viscous gas too", "[sph]") {
  using Viscous = sph::RiemannSph<kernels::QuinticSpline<2>, riemann::Acoustic, eos::IdealGas,
                                  sph::Xsph, boundary::Evolved, sph::Newtonian>;
  const double dx = 0.1;
  const geometry::Box<2> cavity{{-0.5, -0.5}, {0.5, 0.5}};
  const geometry::Domain<2> domain{.box = cavity};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {-0.5 + dx / 2, -0.5 + dx / 2}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(cavity, domain), {.rho = 1.293, .p = 1e4}, {dx});
  cloud.add_virtual(lattice.points(cavity.grown(5 * dx) - cavity, domain, 5 * dx),
                    {.rho = 1.293, .p = 1e4}, {dx});
  sph::Fluid<Viscous, execution::Serial, boundary::Contraction> fluid(
      Viscous{.stress = {.viscosity = 10}}, domain, std::move(cloud), {1, 0.5});
  const auto start = fluid.totals();
  run(fluid, time::PredictorCorrector{}, {.until = 0.1, .cfl = 0.2}, [](auto&, auto&) {});
  const auto end = fluid.totals();
  const double gained =
      end.energy() + end.virtual_internal - start.energy() - start.virtual_internal;
  CHECK(fluid.exchange().driving_work() == Approx(gained).epsilon(1e-6));
}

TEST_CASE("a gas that outgrows its period fails and is not called bad input", "[sph][fault]") {
  const double dx = 0.05;
  const geometry::Domain<2> domain{.box = {{0, 0}, {0.4, 0.4}}, .periodic = {true, false}};
  const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(domain.box, domain), {.rho = 1, .p = 1}, {dx});
  sph::Fluid<Gas<2>, execution::Serial> fluid({}, domain, std::move(cloud));
  CHECK_THROWS_AS(run(fluid, time::PredictorCorrector{}, {.until = 5}, [](auto&, auto&) {}),
                  NumericalFailure);
}

TEST_CASE("a cloud whose fields differ in length, or without mass, is refused", "[sph]") {
  const double dx = 0.05;
  const geometry::Domain<2> domain{.box = {{0, 0}, {0.4, 0.4}}};
  const geometry::Lattice<2> lattice{.spacing = dx};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(domain.box, domain), {.rho = 1, .p = 1}, {dx});
  auto longer = cloud;
  longer.r.resize(cloud.size() + 100);
  CHECK_THROWS_AS((sph::Fluid<Gas<2>>({}, domain, longer)), InvalidInput);
  cloud.m[3] = 0;
  CHECK_THROWS_AS((sph::Fluid<Gas<2>>({}, domain, cloud)), InvalidInput);
}
