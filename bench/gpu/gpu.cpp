// SPDX-License-Identifier: MIT
// What the first policy of a build does on its device: ceilings, equality with the host, pair loop,
// neighbour search and whole steps. bench/gpu.sh builds and runs it for every policy at hand.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/execution/compiled.hpp>
#include <sphmbs/sph/fluid.hpp>
#include <sphmbs/sph/presets.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "gpu/ceilings.hpp"
#include "support/gas_box.hpp"

namespace {

using namespace sphmbs;
using Policy = std::tuple_element_t<0, execution::Compiled>;

template <class Gas, class T, class On>
using FluidOn = sph::Fluid<Gas, On, boundary::Fixed, T>;

template <class T>
const char* type_name() {
  return sizeof(T) == 8 ? "double" : "float";
}

template <class Fluid>
void advance(Fluid& fluid) {
  time::PredictorCorrector{}.step(fluid, [&] { return sph::step_limit(fluid.survey(), 0.25).dt; });
}

template <class On, class U>
std::vector<double> on_host(const U* field, std::size_t n) {
  std::vector<U> values(n);
  On::download(values.data(), field, n * sizeof(U));
  return {values.begin(), values.end()};
}

void describe_device() {
  const execution::Device device = Policy::device();
  std::printf("policy %s, %s", std::string(Policy::name).c_str(), device.name.c_str());
  if (device.memory > 0)
    std::printf(", %.1f of %.1f GB free", 1e-9 * static_cast<double>(device.free),
                1e-9 * static_cast<double>(device.memory));
  std::printf("\n");
}

void measure_ceilings(bool quick) {
  const std::size_t numbers = std::size_t{1} << (quick ? 20 : 27);
  const std::size_t bodies = std::size_t{1} << (quick ? 12 : 20);
  std::printf(
      "ceilings: copy %.0f GB/s, double %.2f TFLOP/s, float %.2f TFLOP/s, empty loop %.1f us\n",
      1e-9 * bench::copy_bandwidth<Policy>(numbers),
      1e-12 * bench::operation_rate<Policy, double>(bodies),
      1e-12 * bench::operation_rate<Policy, float>(bodies), 1e6 * bench::launch_time<Policy>());
}

/// Accelerations of this policy and type against one thread of the host in double, as a share of
/// the largest one; and whether twenty steps have the same bits when they are taken again.
template <class Gas, class T>
bool check(const char* scheme, std::size_t about) {
  const auto box = bench::GasBox<Gas::dim>::of_about(about);
  FluidOn<Gas, double, execution::Serial> host({}, box.domain(), box.cloud());
  FluidOn<Gas, T, Policy> device({}, box.domain(), box.cloud());
  host.stage(0, 0);
  host.rates(0);
  device.stage(0, 0);
  device.rates(0);
  const std::size_t n = host.size();
  double apart = 0, size = 0;
  std::vector<std::size_t> place(n);
  const auto id = on_host<Policy>(device.particles().fields().id, n);
  const auto host_id = on_host<execution::Serial>(host.particles().fields().id, n);
  for (std::size_t i = 0; i < n; ++i) place[static_cast<std::size_t>(id[i])] = i;
  for (int k = 0; k < Gas::dim; ++k) {
    const auto here = on_host<Policy>(device.particles().rates().v[k], n);
    const auto there = on_host<execution::Serial>(host.particles().rates().v[k], n);
    for (std::size_t i = 0; i < n; ++i) {
      const double difference =
          std::abs(here[place[static_cast<std::size_t>(host_id[i])]] - there[i]);
      if (!(difference <= apart)) apart = difference;  // NaN too
      size = std::max(size, std::abs(there[i]));
    }
  }
  const auto state = [&] {
    FluidOn<Gas, T, Policy> fluid({}, box.domain(), box.cloud());
    for (int step = 0; step < 20; ++step) advance(fluid);
    std::vector<T> values(n);
    Policy::download(values.data(), fluid.particles().fields().e, n * sizeof(T));
    return values;
  };
  const auto once = state(), again = state();
  const bool same = std::memcmp(once.data(), again.data(), n * sizeof(T)) == 0;
  const bool close = apart <= (sizeof(T) == 8 ? 1e-12 : 1e-4) * size;
  std::printf("%-10s %-6s %dD %-5s %9zu  differs by %.1e of the largest acceleration%s; %s\n",
              std::string(Policy::name).c_str(), type_name<T>(), Gas::dim, scheme, n, apart / size,
              close ? "" : " TOO MUCH", same ? "same bits again" : "OTHER BITS AGAIN");
  return close && same;
}

/// Speed of the pair loop, share of the neighbour search, and speed of whole steps.
template <class Gas, class T>
void time_steps(const char* scheme, std::size_t about, int steps) {
  const auto box = bench::GasBox<Gas::dim>::of_about(about);
  FluidOn<Gas, T, Policy> fluid({}, box.domain(), box.cloud());
  // The first steps choose the skin of the lists.
  for (int k = 0; k < 4; ++k) advance(fluid);
  const sph::Statistics before = fluid.statistics();
  const double seconds = bench::shortest(1, [&] {
    for (int k = 0; k < steps; ++k) advance(fluid);
  });
  const sph::Statistics& after = fluid.statistics();
  const auto spent = [&](sph::Phase phase) {
    const auto k = static_cast<std::size_t>(phase);
    return after.seconds[k] - before.seconds[k];
  };
  const double pairs = static_cast<double>(after.pair_interactions - before.pair_interactions);
  const double loop = spent(sph::Phase::rates) + spent(sph::Phase::slopes);
  const double rebuilds = static_cast<double>(after.rebuilds - before.rebuilds);
  const double n = static_cast<double>(fluid.size());
  std::printf("%-10s %-6s %dD %-5s %9.0f  %6.2f %6.2f %5.0f %5.0f %8.2f %9.3f %6.0f\n",
              std::string(Policy::name).c_str(), type_name<T>(), Gas::dim, scheme, n,
              1e-9 * pairs / loop, 1e-9 * pairs / seconds, 100 * loop / seconds,
              100 * spent(sph::Phase::neighbours) / seconds,
              1e3 * spent(sph::Phase::neighbours) / std::max(1.0, rebuilds), 1e3 * seconds / steps,
              static_cast<double>(fluid.bytes()) / n);
  std::fflush(stdout);
}

template <int dim, class Each>
void for_schemes(Each&& each) {
  each.template operator()<sph::PaperScheme<dim>>("paper");
  each.template operator()<sph::SmoothScheme<dim>>("best");
}

int run(bool quick) {
  describe_device();
  measure_ceilings(quick);
  bool good = true;
  const auto check_all = [&]<class Gas>(const char* scheme) {
    good = check<Gas, double>(scheme, quick ? 2'000 : 100'000) && good;
    good = check<Gas, float>(scheme, quick ? 2'000 : 100'000) && good;
  };
  for_schemes<2>(check_all);
  for_schemes<3>(check_all);

  std::printf("%-36s  %6s %6s %5s %5s %8s %9s %6s\n", "", "loop", "step", "loop", "lists", "lists",
              "step", "memory");
  std::printf("%-10s %-6s %-2s %-5s %9s  %6s %6s %5s %5s %8s %9s %6s\n", "policy", "type", "",
              "scheme", "particles", "Gp/s", "Gp/s", "%", "%", "ms each", "ms", "B/p");
  const std::vector<std::size_t> sizes =
      quick ? std::vector<std::size_t>{4'000}
            : std::vector<std::size_t>{100'000, 1'000'000, 4'000'000};
  const auto time_all = [&]<class Gas>(const char* scheme) {
    for (const std::size_t about : sizes) {
      time_steps<Gas, double>(scheme, about, quick ? 4 : 20);
      time_steps<Gas, float>(scheme, about, quick ? 4 : 20);
    }
  };
  for_schemes<2>(time_all);
  for_schemes<3>(time_all);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 && std::string_view(argv[1]) == "--quick");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
