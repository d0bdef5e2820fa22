// SPDX-License-Identifier: MIT
// The acoustic Riemann solver, a problem or a pack of problems at a time.
#include <array>

#include <sphmbs/riemann/acoustic.hpp>

#include "support/columns.hpp"
#include "support/registry.hpp"

using namespace sphmbs;

namespace {

template <class T, int lanes>
void solve(benchmark::State& state) {
  using N = Number<T, lanes>;
  const auto rho = bench::column<T>(0.5, 2.0);
  const auto u = bench::column<T>(-100, 100);
  const auto p = bench::column<T>(5e4, 2e5);
  const auto c = bench::column<T>(200, 600);
  std::array<T, bench::column_size> p_star;
  std::array<T, bench::column_size> u_star;
  const riemann::State<N> left{N(T(1.2)), N(T(10)), N(T(1e5)), N(T(340))};
  const riemann::Acoustic solver;
  for (auto _ : state) {
    for (std::size_t i = 0; i < bench::column_size; i += lanes) {
      const riemann::State<N> right{bench::load<N>(&rho[i]), bench::load<N>(&u[i]),
                                    bench::load<N>(&p[i]), bench::load<N>(&c[i])};
      const riemann::Star<N> star = solver.star(left, right);
      bench::store(&p_star[i], star.p);
      bench::store(&u_star[i], star.u);
    }
    benchmark::DoNotOptimize(p_star.data());
    benchmark::DoNotOptimize(u_star.data());
    benchmark::ClobberMemory();
  }
  state.counters["solves/s"] = bench::per_second(bench::column_size);
}

template <class T, int lanes>
void add(const std::string& type) {
  bench::add("riemann/acoustic/" + type + "/lanes:" + std::to_string(lanes), 1, solve<T, lanes>)
      ->Unit(benchmark::kMicrosecond);
}

[[maybe_unused]] const bool registered = [] {
  add<double, 1>("double");
  add<double, native_lanes<double>>("double");
  add<float, 1>("float");
  add<float, native_lanes<float>>("float");
  return true;
}();

}  // namespace
