// SPDX-License-Identifier: MIT
// Neighbour lists of particles that are nearly in the order of the cells, as in a run: sorting,
// counting and listing. --benchmark_filter=-large leaves out the largest clouds.
#include <sphmbs/neighbours/cell_list.hpp>

#include "support/candidates.hpp"
#include "support/gas_box.hpp"
#include "support/registry.hpp"

using namespace sphmbs;

namespace {

template <int dim, class Policy>
void rebuild(benchmark::State& state, std::size_t about) {
  const auto box = bench::GasBox<dim>::of_about(about);
  const bench::Gas<dim> gas;
  const auto cloud = box.cloud();
  particles::Particles<dim, double, Policy> particles(
      cloud, [&](double rho, double p) { return gas.eos.internal_energy(rho, p); });
  const double support = bench::Gas<dim>::Kernel::support;
  const double h = cloud.h[0];
  const neighbours::Reach reach{.support = support, .skin = 0.04 * support * h, .h_max = h};
  const auto domain = box.domain();
  neighbours::CellList<dim, double, Policy> lists;
  lists.rebuild(particles, domain, reach);
  for (auto _ : state) lists.rebuild(particles, domain, reach);

  const double n = static_cast<double>(particles.size());
  std::uint64_t pairs = 0;
  Policy::download(&pairs, lists.view().first + particles.size(), sizeof pairs);
  const double listed = static_cast<double>(pairs);
  const double candidates = bench::candidates(particles, domain, reach);
  state.counters["pairs/s"] = bench::per_second(listed);
  state.counters["candidates/s"] = bench::per_second(candidates);
  state.counters["particles/s"] = bench::per_second(n);
  state.counters["pairs/particle"] = listed / n;
  state.counters["candidates/pair"] = candidates / listed;
  state.counters["bytes/particle"] = static_cast<double>(lists.bytes()) / n;
}

[[maybe_unused]] const bool registered = [] {
  bench::for_dimensions([](auto dimensions) {
    bench::for_policies([&]<class Policy>(Policy, const std::string& policy, int threads) {
      for (const std::size_t about : {10'000u, 100'000u, 1'000'000u}) {
        const std::string size = about < 1'000'000 ? std::to_string(about) : "large";
        bench::add("neighbours/" + bench::name_of(dimensions) + "/" + policy + "/" + size, threads,
                   [about](benchmark::State& state) {
                     rebuild<decltype(dimensions)::value, Policy>(state, about);
                   });
      }
    });
  });
  return true;
}();

}  // namespace
