// SPDX-License-Identifier: MIT
// The Riemann solvers, a problem or a pack of problems at a time.
#include <array>
#include <string>

#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/riemann/exact.hpp>
#include <sphmbs/riemann/hllc.hpp>
#include <sphmbs/riemann/limited_acoustic.hpp>

#include "support/columns.hpp"
#include "support/registry.hpp"

using namespace sphmbs;

namespace {

template <class Solver, class T, int lanes>
void solve(benchmark::State& state) {
  using N = Number<T, lanes>;
  const eos::IdealGas gas;
  const auto rho = bench::column<T>(0.5, 2.0);
  const auto u = bench::column<T>(-100, 100);
  const auto p = bench::column<T>(5e4, 2e5);
  auto c = rho;
  for (std::size_t i = 0; i < bench::column_size; ++i) c[i] = gas.sound_speed(rho[i], p[i]);
  std::array<T, bench::column_size> p_star;
  std::array<T, bench::column_size> u_star;
  const N rho_left(T(1.2));
  const N p_left(T(1e5));
  const riemann::State<N> left{rho_left, N(T(10)), p_left, gas.sound_speed(rho_left, p_left)};
  const Solver solver;
  for (auto _ : state) {
    for (std::size_t i = 0; i < bench::column_size; i += lanes) {
      const riemann::State<N> right{bench::load<N>(&rho[i]), bench::load<N>(&u[i]),
                                    bench::load<N>(&p[i]), bench::load<N>(&c[i])};
      const riemann::Star<N> star = solver.star(gas, left, right);
      bench::store(&p_star[i], star.p);
      bench::store(&u_star[i], star.u);
    }
    benchmark::DoNotOptimize(p_star.data());
    benchmark::DoNotOptimize(u_star.data());
    benchmark::ClobberMemory();
  }
  state.counters["solves/s"] = bench::per_second(bench::column_size);
}

template <class Solver, class T, int lanes>
void add(const std::string& name) {
  bench::add("riemann/" + name + "/lanes:" + std::to_string(lanes), 1, solve<Solver, T, lanes>)
      ->Unit(benchmark::kMicrosecond);
}

template <class Solver>
void add_all(const std::string& name) {
  add<Solver, double, 1>(name + "/double");
  add<Solver, double, native_lanes<double>>(name + "/double");
  add<Solver, float, 1>(name + "/float");
  add<Solver, float, native_lanes<float>>(name + "/float");
}

[[maybe_unused]] const bool registered = [] {
  add_all<riemann::Acoustic>("acoustic");
  add_all<riemann::LimitedAcoustic>("limited_acoustic");
  add_all<riemann::Hllc>("hllc");
  add_all<riemann::Exact>("exact");
  return true;
}();

}  // namespace
