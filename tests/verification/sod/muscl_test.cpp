// SPDX-License-Identifier: MIT
// Sod's shock tube with slopes, volumes as weights and a density that relaxes: what these are for.
#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <tuple>

#include <sphmbs/sphmbs.hpp>

#include "reference/shock_tube_curves.hpp"
#include "support/catch.hpp"
#include "support/state.hpp"
#include "support/tube.hpp"

namespace {

using sphmbs::examples::SodTube;
namespace riemann = sphmbs::riemann;
namespace reconstruction = sphmbs::reconstruction;

constexpr double until = 0.2;

const riemann::ExactSolution& exact() {
  static const riemann::ExactSolution solution(SodTube<1>::left, SodTube<1>::right,
                                               SodTube<1>::gamma);
  return solution;
}

double exact_density(double x) { return exact().at((x - SodTube<1>::jump) / until).rho; }

/// Equal masses, `dense` of the particles on the left.
template <class Gas>
double error(int dense) {
  const auto end = test::Tube()
                       .fill(SodTube<1>::left, 0, 0.5, dense, true, false)
                       .fill(SodTube<1>::right, 0.5, 1, std::lround(0.125 * dense), false, true)
                       .template after<Gas>(until);
  REQUIRE(test::sound(end));
  return test::mean_error(
      end, 0, 1, [](const test::Station& s) { return s.rho; }, exact_density);
}

template <class Riemann, class Limiter>
struct Choice {
  using Gas = test::ShockGas<1, Riemann, Limiter>;
  double coarse;  // bounds at 100
  double fine;    // and 400 particles
};

template <class Riemann, class Limiter>
void check(const char* name, Choice<Riemann, Limiter> bound) {
  using Gas = typename Choice<Riemann, Limiter>::Gas;
  const double coarse = error<Gas>(89);
  const double fine = error<Gas>(356);
  std::cout << "Sod 1D, " << name << ": L1(rho) " << coarse << " with 100, " << fine
            << " with 400 particles\n";
  CAPTURE(name);
  CHECK(coarse <= bound.coarse);
  CHECK(fine <= bound.fine);
}

}  // namespace

// The paper's scheme has 2.2e-2 to 4.5e-3 and leaves the gas behind the shock 3 % off at any
// resolution. Measured here: 1.413e-2, 7.50e-3, 3.96e-3, 2.16e-3, order 0.904.
TEST_CASE("Sod's tube with slopes converges at first order", "[sod][muscl]") {
  const int dense[] = {89, 178, 356, 712};
  const double bound[] = {1.5e-2, 8e-3, 4.2e-3, 2.3e-3};
  double found[4];
  for (int level = 0; level < 4; ++level) {
    found[level] = error<test::ShockGas<1>>(dense[level]);
    std::cout << "Sod 1D, Hllc and VanLeer, spacing 0.5/" << dense[level] << ": L1(rho) "
              << found[level];
    if (level > 0) std::cout << ", order " << std::log2(found[level - 1] / found[level]);
    std::cout << '\n';
    CAPTURE(dense[level]);
    CHECK(found[level] <= bound[level]);
  }
  CHECK(found[2] <= 4.5e-3);
  CHECK(std::log2(found[0] / found[3]) / 3 >= 0.9);
}

TEST_CASE("Sod's tube with slopes leaves the exact gas behind the shock", "[sod][muscl]") {
  const auto end = test::Tube()
                       .fill(SodTube<1>::left, 0, 0.5, 712, true, false)
                       .fill(SodTube<1>::right, 0.5, 1, 89, false, true)
                       .after<test::ShockGas<1>>(until);
  double rho = 0, u = 0, p = 0, volume = 0;
  for (const test::Station& s : end) {
    if (s.x < 0.77 || s.x > 0.82) continue;
    rho += s.volume() * s.rho;
    u += s.volume() * s.u;
    p += s.volume() * s.p;
    volume += s.volume();
  }
  REQUIRE(volume > 0);
  const auto want = exact().at((0.795 - SodTube<1>::jump) / until);
  std::cout << "Sod 1D, behind the shock / exact: rho " << rho / volume / want.rho << ", u "
            << u / volume / want.u << ", p " << p / volume / want.p << '\n';
  CHECK(std::abs(rho / volume / want.rho - 1) < 0.005);
  CHECK(std::abs(u / volume / want.u - 1) < 0.005);
  CHECK(std::abs(p / volume / want.p - 1) < 0.005);
}

// Measured values, and 5 % of room.
TEST_CASE("every solver and limiter solves Sod's tube", "[sod][muscl]") {
  using reconstruction::BarthJespersen;
  using reconstruction::Minmod;
  using reconstruction::VanLeer;
  check<riemann::Hllc, VanLeer>("Hllc, VanLeer", {1.49e-2, 4.16e-3});
  check<riemann::Exact, VanLeer>("Exact, VanLeer", {1.49e-2, 4.17e-3});
  check<riemann::Acoustic, VanLeer>("Acoustic, VanLeer", {1.53e-2, 4.35e-3});
  check<riemann::Hllc, Minmod>("Hllc, Minmod", {1.55e-2, 4.51e-3});
  check<riemann::Exact, Minmod>("Exact, Minmod", {1.55e-2, 4.51e-3});
  check<riemann::Acoustic, Minmod>("Acoustic, Minmod", {1.58e-2, 4.68e-3});
  check<riemann::Hllc, BarthJespersen>("Hllc, BarthJespersen", {1.59e-2, 4.64e-3});
  check<riemann::Exact, BarthJespersen>("Exact, BarthJespersen", {1.6e-2, 4.65e-3});
  check<riemann::Acoustic, BarthJespersen>("Acoustic, BarthJespersen", {1.63e-2, 4.76e-3});
}

// Measured with 82944 particles: relative L2(rho) 0.0232, L1(rho) 9.7e-3, in 250 s of one core.
TEST_CASE("Sod's tube in 3D with slopes has the exact profile", "[sod][muscl][long]") {
  const SodTube<3> tube(0.5 / 128);  // 128 x 24 x 24 on the dense side
  sphmbs::particles::Cloud<3> cloud;
  tube.fill(cloud);
  using Gas = test::ShockGas<3>;
  sphmbs::sph::Fluid<Gas, sphmbs::execution::OpenMP> fluid(Gas{.eos = {.gamma = 1.4}},
                                                           tube.domain(), cloud);
  const auto begin = std::chrono::steady_clock::now();
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = until, .cfl = 0.4},
              sphmbs::no_report);
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto end = test::state_of(fluid);
  double square = 0, all = 0, l1 = 0, volume = 0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    if (cloud.set[i] != sphmbs::particles::gas) continue;
    const double V = end.m[i] / end.rho[i];
    const double want = exact_density(end.r[i][0]);
    square += V * (end.rho[i] - want) * (end.rho[i] - want);
    all += V * want * want;
    l1 += V * std::abs(end.rho[i] - want);
    volume += V;
  }
  std::cout << "Sod 3D, " << fluid.gas_count() << " particles, " << took << " s: relative L2(rho) "
            << std::sqrt(square / all) << ", L1(rho) " << l1 / volume << '\n';
  CHECK(fluid.gas_count() > 74000);
  CHECK(std::sqrt(square / all) <= 0.0255);
}
