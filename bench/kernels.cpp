// SPDX-License-Identifier: MIT
// Shape and slope of the smoothing functions, a number or a pack at a time.
#include <array>

#include <sphmbs/kernels/cubic_spline.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/kernels/wendland.hpp>

#include "support/columns.hpp"
#include "support/registry.hpp"

using namespace sphmbs;

namespace {

enum class Part { value, derivative };

template <class Kernel, Part part, class T, int lanes>
void evaluate(benchmark::State& state) {
  using N = Number<T, lanes>;
  const auto r = bench::column<T>(0.0, 1.1 * Kernel::support);
  std::array<T, bench::column_size> result;
  for (auto _ : state) {
    for (std::size_t i = 0; i < bench::column_size; i += lanes) {
      const N distance = bench::load<N>(&r[i]);
      if constexpr (part == Part::value)
        bench::store(&result[i], kernels::value<Kernel>(distance, N(T(1.25))));
      else
        bench::store(&result[i], kernels::derivative<Kernel>(distance, N(T(1.25))));
    }
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
  state.counters["evaluations/s"] = bench::per_second(bench::column_size);
}

template <class Kernel, class T>
void add_widths(const std::string& name) {
  constexpr int wide = native_lanes<T>;
  const std::string type = sizeof(T) == 8 ? "/double" : "/float";
  const auto add = [&](const std::string& part, int lanes, auto run) {
    bench::add(name + part + type + "/lanes:" + std::to_string(lanes), 1, run)
        ->Unit(benchmark::kMicrosecond);
  };
  add("/value", 1, evaluate<Kernel, Part::value, T, 1>);
  add("/value", wide, evaluate<Kernel, Part::value, T, wide>);
  add("/derivative", 1, evaluate<Kernel, Part::derivative, T, 1>);
  add("/derivative", wide, evaluate<Kernel, Part::derivative, T, wide>);
}

template <class Kernel>
void add_types(const std::string& name) {
  add_widths<Kernel, double>(name);
  add_widths<Kernel, float>(name);
}

[[maybe_unused]] const bool registered = [] {
  bench::for_dimensions([]<int dim>(bench::Int<dim> dimensions) {
    const std::string prefix = "kernels/" + bench::name_of(dimensions);
    add_types<kernels::QuinticSpline<dim>>(prefix + "/quintic_spline");
    add_types<kernels::CubicSpline<dim>>(prefix + "/cubic_spline");
    add_types<kernels::WendlandC2<dim>>(prefix + "/wendland_c2");
    add_types<kernels::WendlandC4<dim>>(prefix + "/wendland_c4");
    add_types<kernels::WendlandC6<dim>>(prefix + "/wendland_c6");
  });
  return true;
}();

}  // namespace
