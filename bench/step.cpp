// SPDX-License-Identifier: MIT
// Whole steps of a run, neighbour lists included. The number of steps is fixed, so that each result
// covers several lives of the lists.
#include <sphmbs/sph/fluid.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "support/gas_box.hpp"
#include "support/registry.hpp"

using namespace sphmbs;

namespace {

template <int dim, class Policy>
void step(benchmark::State& state, std::size_t about) {
  const auto box = bench::GasBox<dim>::of_about(about);
  sph::Fluid<bench::Gas<dim>, Policy> fluid({}, box.domain(), box.cloud());
  const auto advance = [&] {
    time::PredictorCorrector{}.step(fluid,
                                    [&] { return sph::step_limit(fluid.survey(), 0.25).dt; });
  };
  // The first steps choose the skin of the lists.
  for (int i = 0; i < 2; ++i) advance();
  const sph::Statistics before = fluid.statistics();
  for (auto _ : state) advance();

  const sph::Statistics& after = fluid.statistics();
  const double steps = static_cast<double>(after.steps - before.steps);
  const double n = static_cast<double>(fluid.size());
  state.counters["pairs/s"] = bench::per_second(
      static_cast<double>(after.pair_interactions - before.pair_interactions) / steps);
  state.counters["particles/s"] = bench::per_second(n);
  state.counters["bytes/particle"] = static_cast<double>(fluid.bytes()) / n;
  state.counters["steps/rebuild"] =
      steps / std::max(1.0, static_cast<double>(after.rebuilds - before.rebuilds));
  for (std::size_t phase = 0; phase < sph::phase_names.size(); ++phase)
    state.counters["ms/step " + std::string(sph::phase_names[phase])] =
        1e3 * (after.seconds[phase] - before.seconds[phase]) / steps;
}

[[maybe_unused]] const bool registered = [] {
  bench::for_dimensions([](auto dimensions) {
    bench::for_policies_and_threads(
        [&]<class Policy>(Policy, const std::string& policy, int threads) {
          for (const std::size_t about : {10'000u, 100'000u})
            bench::add(
                "step/" + bench::name_of(dimensions) + "/" + policy + "/" + std::to_string(about),
                threads,
                [about](benchmark::State& state) {
                  step<decltype(dimensions)::value, Policy>(state, about);
                })
                ->Iterations(12);
        });
  });
  return true;
}();

}  // namespace
