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

template <class Kernel, Part part, int lanes>
void evaluate(benchmark::State& state) {
  using N = Number<double, lanes>;
  const auto r = bench::column<double>(0, 1.1 * Kernel::support);
  std::array<double, bench::column_size> result;
  for (auto _ : state) {
    for (std::size_t i = 0; i < bench::column_size; i += lanes) {
      const N distance = bench::load<N>(&r[i]);
      if constexpr (part == Part::value)
        bench::store(&result[i], kernels::value<Kernel>(distance, N(1.25)));
      else
        bench::store(&result[i], kernels::derivative<Kernel>(distance, N(1.25)));
    }
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
  state.counters["evaluations/s"] = bench::per_second(bench::column_size);
}

template <class Kernel, int lanes>
void add_width(const std::string& name) {
  const std::string width = "/lanes:" + std::to_string(lanes);
  bench::add(name + "/value" + width, 1, evaluate<Kernel, Part::value, lanes>)
      ->Unit(benchmark::kMicrosecond);
  bench::add(name + "/derivative" + width, 1, evaluate<Kernel, Part::derivative, lanes>)
      ->Unit(benchmark::kMicrosecond);
}

template <class Kernel>
void add_kernel(const std::string& name) {
  add_width<Kernel, 1>(name);
  add_width<Kernel, native_lanes<double>>(name);
}

[[maybe_unused]] const bool registered = [] {
  bench::for_dimensions([]<int dim>(bench::Int<dim> dimensions) {
    const std::string prefix = "kernels/" + bench::name_of(dimensions);
    add_kernel<kernels::QuinticSpline<dim>>(prefix + "/quintic_spline");
    add_kernel<kernels::CubicSpline<dim>>(prefix + "/cubic_spline");
    add_kernel<kernels::WendlandC2<dim>>(prefix + "/wendland_c2");
    add_kernel<kernels::WendlandC4<dim>>(prefix + "/wendland_c4");
    add_kernel<kernels::WendlandC6<dim>>(prefix + "/wendland_c6");
  });
  return true;
}();

}  // namespace
