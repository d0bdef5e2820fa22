// SPDX-License-Identifier: MIT
// Sod's shock tube in SHOCK_TUBE_DIM = 1, 2 or 3 dimensions, against the exact solution: left
// (rho, u, p) = (1, 0, 1), right (0.125, 0, 0.1), gamma 1.4, compared at t = 0.2.
#include <sphmbs/sphmbs.hpp>

#include "reference/shock_tube_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_parameters.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"
#include "support/selected.hpp"

using namespace sphmbs;
using examples::SelectedLimiter;
using examples::SelectedRiemann;
constexpr int dim = SHOCK_TUBE_DIM;
const std::string case_name = dim == 1 ? "shock_tube" : "shock_tube_" + std::to_string(dim) + "d";

template <class... Policies>
using Scheme =
    sph::RiemannSph<kernels::QuinticSpline<dim>, SelectedRiemann, eos::IdealGas, Policies...>;
using Best = Scheme<reconstruction::Muscl<SelectedLimiter>, sph::VolumeForm, sph::Relaxed,
                    sph::NoXsph, boundary::FreeSlip>;

/// What its user chooses.
struct Choices {
  examples::TubeStates states{};
  std::string scheme = "paper";
  std::string riemann = "auto";
  std::string limiter = "auto";
  bool no_xsph = false;

  void add(examples::Parameters& parameters) {
    const auto or_auto = [](std::vector<std::string> names) {
      names.insert(names.begin(), "auto");
      return names;
    };
    parameters.add_choice("scheme.riemann", riemann, or_auto(SelectedRiemann::names()),
                          "Riemann solver; auto: acoustic in the paper's scheme, hllc in the best",
                          "--riemann");
    parameters.add_choice("scheme.limiter", limiter, or_auto(SelectedLimiter::names()),
                          "limiter of the slopes of --scheme best; auto: van_leer", "--limiter");
    parameters.add_flag("scheme.no_xsph", no_xsph,
                        "move particles with their own velocities, as --scheme best does",
                        "--no-xsph");
    const auto add = [&](const std::string& key, double& value, const char* unit,
                         const char* meaning) {
      parameters.add_number(key, value, {.above = 0.0}, unit, meaning);
    };
    add("left.density", states.left.rho, "kg/m^3", "of the gas left of 0.5 m at the start");
    add("left.pressure", states.left.p, "Pa", "of the gas left of 0.5 m at the start");
    add("right.density", states.right.rho, "kg/m^3", "of the gas right of 0.5 m at the start");
    add("right.pressure", states.right.p, "Pa", "of the gas right of 0.5 m at the start");
    examples::add_gamma(parameters, states.gamma);
  }
};

template <class Gas, class T, class Policy>
void shock_tube(const examples::Settings& settings, const Choices& choices, Policy policy) {
  const double dx = settings.spacing;
  const double denser = choices.states.right.rho / choices.states.left.rho;
  examples::require_all({{dx <= 0.025, "--spacing", dx, "at most 0.025 m, a fortieth of the tube"},
                         {denser >= 1e-3 && denser <= 10, "right.density", choices.states.right.rho,
                          "a thousandth to ten times that of the left, " +
                              examples::format_exact(choices.states.left.rho) + " kg/m^3"}});
  examples::require_memory(std::pow(24, dim - 1) / dx, dx);

  // Particles of (nearly) equal mass on both sides, so that the right ones are wider apart; the
  // tube is as wide as its periodic sides ask for, and ends in fixed walls of virtual particles.
  const examples::SodTube<dim> tube(dx, choices.states);
  particles::Cloud<dim> cloud;
  tube.fill(cloud);

  const bool best = Gas::Reconstruction::slopes;
  const std::string solver = choices.riemann != "auto" ? choices.riemann
                             : best                    ? "hllc"
                                                       : "acoustic";
  Gas gas{.eos = {.gamma = choices.states.gamma}, .riemann = SelectedRiemann::of(solver)};
  const std::string limiter = choices.limiter == "auto" ? "van_leer" : choices.limiter;
  if constexpr (best) gas.reconstruction.limiter = SelectedLimiter::of(limiter);
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, tube.domain(), std::move(cloud), {},
                                                    policy);

  examples::Session session(settings, case_name, "Sod's shock tube in " + std::to_string(dim) + "D",
                            fluid);
  session.note("gas", "ideal gas gamma " + examples::format_exact(choices.states.gamma) + "; " +
                          examples::describe<Gas>() + ", Riemann solver " + solver +
                          (best ? ", limiter " + limiter : ""));
  session.record("energy", "J", [&] { return fluid.totals().energy(); });
  session.run(time::PredictorCorrector{}, *settings.samples, *settings.fields);
  examples::compare_with_exact(session, fluid, tube);
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters({.name = case_name,
                                   .title = "Sod's shock tube in " + std::to_string(dim) + "D",
                                   .backends = examples::backends(),
                                   .precisions = examples::precisions(),
                                   .defaults = {.spacing = dim == 1 ? 0.5 / 356 : 0.5 / 128,
                                                .until = 0.2,
                                                .cfl = 0.4,
                                                .fields = 4,
                                                .samples = 20},
                                   .dim = dim});
  Choices choices;
  examples::add_scheme(parameters, choices.scheme);
  choices.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    const bool best = choices.scheme == "best";
    examples::require(best || choices.limiter == "auto", "--limiter", choices.limiter,
                      "left out: the paper's scheme has no slopes to limit");
    examples::require(!best || !choices.no_xsph, "--no-xsph", "with --scheme best",
                      "left out: that scheme has no XSPH");
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      if (choices.no_xsph)
        shock_tube<Scheme<sph::NoXsph>, T>(s, choices, policy);
      else
        examples::with_scheme<Scheme<>, Best>(
            choices.scheme, [&]<class Gas>() { shock_tube<Gas, T>(s, choices, policy); });
    });
  });
}
