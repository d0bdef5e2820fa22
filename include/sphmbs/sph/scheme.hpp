// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <sphmbs/boundary/evolved.hpp>
#include <sphmbs/eos/equation_of_state.hpp>
#include <sphmbs/kernels/kernel.hpp>
#include <sphmbs/reconstruction/constant.hpp>
#include <sphmbs/riemann/riemann_solver.hpp>
#include <sphmbs/sph/choice.hpp>
#include <sphmbs/sph/density_model.hpp>
#include <sphmbs/sph/flux_form.hpp>
#include <sphmbs/sph/motion_smoothing.hpp>
#include <sphmbs/sph/stress.hpp>

/// The gas's equations.
namespace sphmbs::sph {

namespace detail {

enum class Place { smoothing, wall, stress, reconstruction, density, form };

/// Whether a policy fits each of them.
template <class P>
inline constexpr std::array fits{MotionSmoothing<P>, boundary::WallModel<P>,
                                 StressModel<P>,     reconstruction::Reconstruction<P>,
                                 DensityModel<P>,    FluxForm<P>};

template <Place place>
struct Fits {
  template <class P>
  static constexpr bool value = fits<P>[static_cast<std::size_t>(place)];
};

template <class P>
inline constexpr auto places = std::count(fits<P>.begin(), fits<P>.end(), true);

}  // namespace detail

/// The choices that make a gas, put together at compile time. An aggregate:
/// `Gas{.eos = {.gamma = 1.4}, .acceleration = {3, 0}}`.
/// @tparam Policies  in any order what differs from the paper: a motion smoothing, a wall model, a
///                   stress model, a reconstruction, a density model, a flux form
template <kernels::Kernel KernelType, riemann::RiemannSolver RiemannType, eos::EquationOfState Eos,
          class... Policies>
struct RiemannSph {
  static_assert(((detail::places<Policies> == 1) && ...),
                "every policy after the equation of state must be a motion smoothing, a wall "
                "model, a stress model, a reconstruction, a density model or a flux form");
  static constexpr int dim = KernelType::dim;  ///< dimension of space
  using Kernel = KernelType;                   ///< smoothing function
  using Riemann = RiemannType;                 ///< Riemann solver
  /// How particles move, see `MotionSmoothing`.
  using Smoothing = Choice<detail::Fits<detail::Place::smoothing>, Xsph, Policies...>;
  /// What gas meets at walls, see `boundary::WallModel`.
  using Wall = Choice<detail::Fits<detail::Place::wall>, boundary::Evolved, Policies...>;
  /// Viscosity and conduction, see `StressModel`.
  using Stress = Choice<detail::Fits<detail::Place::stress>, Inviscid, Policies...>;
  /// Between particles, see `reconstruction::Reconstruction`.
  using Reconstruction =
      Choice<detail::Fits<detail::Place::reconstruction>, reconstruction::Constant, Policies...>;
  /// Where the density comes from, see `DensityModel`.
  using Density = Choice<detail::Fits<detail::Place::density>, Integrated, Policies...>;
  /// Weights of pairs, see `FluxForm`.
  using Form = Choice<detail::Fits<detail::Place::form>, MassForm, Policies...>;

  /// Whether pairs see slopes of the gas and surfaces of solids.
  static constexpr bool vicinity = Reconstruction::slopes || Wall::surfaces;

  /// Equation of state with its numbers.
  Eos eos{};
  Vec<dim> acceleration{};  ///< body force per mass, g [m/s^2]
  /// A pressure that everything is at: forces are those of p - background, so that its share in the
  /// noise of disordered particles vanishes. Momentum is conserved as before, and instead of the
  /// energy its sum with background times volume (exactly so with VolumeForm and Integrated). The
  /// force on a body lacks background times its area vector, which is zero for closed bodies [Pa].
  double background = 0;
  /// Riemann solver with its numbers.
  Riemann riemann{};
  /// With its numbers.
  Smoothing smoothing{};
  /// With its numbers.
  Wall wall{};
  /// With its numbers.
  Stress stress{};
  /// With its numbers.
  Reconstruction reconstruction{};
  /// With its numbers.
  Density density{};
  /// With its numbers.
  Form form{};

  /// @throws InvalidInput where a policy's parameter is out of range.
  void check() const {
    eos.check();
    for (int k = 0; k < dim; ++k)
      expects(std::isfinite(acceleration[k]), "acceleration", acceleration[k], "finite [m/s^2]");
    expects(std::isfinite(background), "background", background, "finite [Pa]");
    riemann.check();
    smoothing.check();
    wall.check();
    stress.check();
    density.check();
  }
};

}  // namespace sphmbs::sph
