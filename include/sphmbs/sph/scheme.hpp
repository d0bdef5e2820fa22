// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/boundary/evolved.hpp>
#include <sphmbs/eos/equation_of_state.hpp>
#include <sphmbs/kernels/kernel.hpp>
#include <sphmbs/riemann/riemann_solver.hpp>
#include <sphmbs/sph/stress.hpp>
#include <sphmbs/sph/xsph.hpp>

/// The gas's equations.
namespace sphmbs::sph {

/// The choices that make a gas, put together at compile time. An aggregate:
/// `Gas{.eos = {.gamma = 1.4}, .acceleration = {3, 0}}`.
template <kernels::Kernel KernelType, riemann::RiemannSolver Riemann, eos::EquationOfState Eos,
          MotionSmoothing Smoothing = Xsph, boundary::WallModel WallType = boundary::Evolved,
          StressModel Stress = Inviscid>
struct RiemannSph {
  static constexpr int dim = KernelType::dim;
  using Kernel = KernelType;
  using Wall = WallType;

  Eos eos{};
  Vec<dim> acceleration{};  // body force per mass, g [m/s^2]
  Riemann riemann{};
  Smoothing xsph{};
  Wall wall{};
  Stress stress{};

  /// @throws InvalidInput where a policy's parameter is out of range.
  void check() const {
    eos.check();
    for (int k = 0; k < dim; ++k)
      expects(std::isfinite(acceleration[k]), "acceleration", acceleration[k], "finite [m/s^2]");
    xsph.check();
    stress.check();
  }
};

}  // namespace sphmbs::sph
