// SPDX-License-Identifier: MIT
// One evaluation of the rates of change: the pair loop and the survey that follows it.
#include <sphmbs/boundary/mirrored.hpp>
#include <sphmbs/riemann/exact.hpp>
#include <sphmbs/riemann/limited_acoustic.hpp>
#include <sphmbs/sph/fluid.hpp>
#include <sphmbs/sph/presets.hpp>

#include "support/gas_box.hpp"
#include "support/registry.hpp"

using namespace sphmbs;

namespace {

template <class Gas, class T, class Policy>
void evaluate(benchmark::State& state, const Gas& gas, std::size_t about) {
  const auto box = bench::GasBox<Gas::dim>::of_about(about);
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, box.domain(), box.cloud());
  fluid.stage(0, 0);
  fluid.rates(0);
  const auto seconds_before = fluid.statistics().seconds;
  for (auto _ : state) fluid.rates(0);

  const double n = static_cast<double>(fluid.size());
  const double pairs = static_cast<double>(fluid.survey().pairs);
  double in_loop = 0;
  for (const sph::Phase phase : {sph::Phase::slopes, sph::Phase::rates}) {
    const auto at = static_cast<std::size_t>(phase);
    in_loop += fluid.statistics().seconds[at] - seconds_before[at];
  }
  state.counters["pairs/s"] = bench::per_second(pairs);
  state.counters["pairs/s in the loop"] = pairs * static_cast<double>(state.iterations()) / in_loop;
  state.counters["particles/s"] = bench::per_second(n);
  state.counters["pairs/particle"] = pairs / n;
}

template <class Gas>
void add(const std::string& equations, const Gas& gas) {
  const auto add_type = [&]<class T>(T, const std::string& type) {
    bench::for_policies([&]<class Policy>(Policy, const std::string& policy, int threads) {
      for (const std::size_t about : {10'000u, 100'000u})
        bench::add("rates/" + std::to_string(Gas::dim) + "D/" + equations + "/" + type + "/" +
                       policy + "/" + std::to_string(about),
                   threads, [gas, about](benchmark::State& state) {
                     evaluate<Gas, T, Policy>(state, gas, about);
                   });
    });
  };
  add_type(double{}, "double");
  add_type(float{}, "float");
}

/// What a scheme costs in plane gas.
template <class Gas>
void add_scheme(const std::string& name) {
  bench::for_policies([&]<class Policy>(Policy, const std::string& policy, int threads) {
    bench::add("choice/" + name + "/" + policy, threads, [](benchmark::State& state) {
      evaluate<Gas, double, Policy>(state, Gas{}, 100'000);
    });
  });
}

/// What a choice costs against the paper's scheme.
template <class Riemann, class... Policies>
void add_choice(const std::string& name) {
  add_scheme<sph::RiemannSph<kernels::QuinticSpline<2>, Riemann, eos::IdealGas, Policies...>>(name);
}

void add_choices() {
  using namespace reconstruction;
  using riemann::Acoustic;
  add_scheme<sph::PaperScheme<2>>("paper");
  add_choice<riemann::LimitedAcoustic>("limited_acoustic");
  add_choice<riemann::Hllc>("hllc");
  add_choice<riemann::Exact>("exact");
  add_choice<Acoustic, Muscl<VanLeer>>("van_leer");
  add_choice<Acoustic, Muscl<Minmod>>("minmod");
  add_choice<Acoustic, Muscl<BarthJespersen>>("barth_jespersen");
  add_choice<Acoustic, sph::VolumeForm>("volume_form");
  add_choice<Acoustic, sph::Relaxed>("relaxed");
  add_choice<Acoustic, sph::NoXsph>("no_xsph");
  add_choice<Acoustic, sph::Shifting>("shifting");
  add_choice<Acoustic, boundary::Mirrored>("mirrored");
  add_choice<Acoustic, boundary::FreeSlip>("free_slip");
  add_scheme<sph::SmoothScheme<2>>("smooth");
  add_scheme<sph::ShockScheme<2>>("shock");
}

[[maybe_unused]] const bool registered = [] {
  bench::for_dimensions([]<int dim>(bench::Int<dim>) {
    const sph::Newtonian air{.viscosity = 1.8e-5, .conductivity = 0.026};
    add("xsph/inviscid", bench::Gas<dim>{});
    add("no_xsph/inviscid", bench::Gas<dim, sph::NoXsph>{});
    add("xsph/newtonian", bench::Gas<dim, sph::Xsph, sph::Newtonian>{.stress = air});
    add("no_xsph/newtonian", bench::Gas<dim, sph::NoXsph, sph::Newtonian>{.stress = air});
  });
  add_choices();
  return true;
}();

}  // namespace
