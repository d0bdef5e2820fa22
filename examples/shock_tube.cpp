// SPDX-License-Identifier: MIT
// Sod's shock tube in SHOCK_TUBE_DIM = 1, 2 or 3 dimensions, against the exact solution: left
// (rho, u, p) = (1, 0, 1), right (0.125, 0, 0.1), gamma 1.4, compared at t = 0.2.
#include <sphmbs/sphmbs.hpp>

#include "reference/shock_tube_curves.hpp"
#include "support/backends.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"
#include "support/selected.hpp"

using namespace sphmbs;
constexpr int dim = SHOCK_TUBE_DIM;
const std::string case_name = dim == 1 ? "shock_tube" : "shock_tube_" + std::to_string(dim) + "d";

using examples::SelectedLimiter;
using examples::SelectedRiemann;
template <class... Policies>
using Gas =
    sph::RiemannSph<kernels::QuinticSpline<dim>, SelectedRiemann, eos::IdealGas, Policies...>;
using Best = Gas<reconstruction::Muscl<SelectedLimiter>, sph::VolumeForm, sph::Relaxed, sph::NoXsph,
                 boundary::FreeSlip>;

/// What the command line chooses.
struct Choices {
  std::string scheme = "paper";
  std::string riemann = "auto";
  std::string limiter = "van_leer";
  Choices choices;
  examples::add_scheme(command_line, choices.scheme);
  std::vector<std::string> solvers = SelectedRiemann::names();
  solvers.insert(solvers.begin(), "auto");
  command_line.add_choice(
      "--riemann", choices.riemann, solvers,
      "Riemann solver; auto: acoustic for the paper's scheme, hllc for the best");
  command_line.add_choice("--limiter", choices.limiter, SelectedLimiter::names(),
                          "limiter of the slopes of --scheme best");
  command_line.add_flag("--no-xsph", choices.no_xsph,
                        "move particles with their own velocities, as --scheme best does");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&](const auto& s, auto policy) {
      if (choices.scheme == "best")
        shock_tube<Best>(s, choices, policy);
      else if (choices.no_xsph)
        shock_tube<Gas<sph::NoXsph>>(s, choices, policy);
      else
        shock_tube<Gas<>>(s, choices, policy);
    });
  });
}
