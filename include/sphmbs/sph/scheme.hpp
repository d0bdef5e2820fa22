// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

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

struct IsSmoothing {
  template <class P>
  static constexpr bool value = MotionSmoothing<P>;
};
struct IsWall {
  template <class P>
  static constexpr bool value = boundary::WallModel<P>;
};
struct IsStress {
  template <class P>
  static constexpr bool value = StressModel<P>;
};
struct IsReconstruction {
  template <class P>
  static constexpr bool value = reconstruction::Reconstruction<P>;
};
struct IsDensity {
  template <class P>
  static constexpr bool value = DensityModel<P>;
};
struct IsForm {
  template <class P>
  static constexpr bool value = FluxForm<P>;
};

template <class P>
inline constexpr int places = MotionSmoothing<P> + boundary::WallModel<P> + StressModel<P> +
                              reconstruction::Reconstruction<P> + DensityModel<P> + FluxForm<P>;

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
  static constexpr int dim = KernelType::dim;
  using Kernel = KernelType;
  using Riemann = RiemannType;
  using Smoothing = Choice<detail::IsSmoothing, Xsph, Policies...>;
  using Wall = Choice<detail::IsWall, boundary::Evolved, Policies...>;
  using Stress = Choice<detail::IsStress, Inviscid, Policies...>;
  using Reconstruction = Choice<detail::IsReconstruction, reconstruction::Constant, Policies...>;
  using Density = Choice<detail::IsDensity, Integrated, Policies...>;
  using Form = Choice<detail::IsForm, MassForm, Policies...>;

  /// Whether pairs see slopes of the gas and surfaces of solids.
  static constexpr bool vicinity = Reconstruction::slopes || Wall::surfaces;

  Eos eos{};
  Vec<dim> acceleration{};  // body force per mass, g [m/s^2]
  /// A pressure that everything is at: forces are those of p - background, so that its share in the
  /// noise of disordered particles vanishes. Momentum is conserved as before, and instead of the
  /// energy its sum with background times volume (exactly so with VolumeForm and Integrated). The
  /// force on a body lacks background times its area vector, which is zero for closed bodies [Pa].
  double background = 0;
  Riemann riemann{};
  Smoothing smoothing{};
  Wall wall{};
  Stress stress{};
  Reconstruction reconstruction{};
  Density density{};
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
