// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <sphmbs/core/math.hpp>
#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/particles/cloud.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/sph/scheme.hpp>

namespace bench {

/// The paper's gas.
template <int Dim, class Smoothing = sphmbs::sph::Xsph, class Stress = sphmbs::sph::Inviscid>
using Gas =
    sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<Dim>, sphmbs::riemann::Acoustic,
                            sphmbs::eos::IdealGas, Smoothing, sphmbs::boundary::Evolved, Stress>;

/// A box of air, periodic along all axes and a metre wide, with Taylor and Green's vortices of Mach
/// number 0.1 in it. The particles stray from a lattice by up to a fifth of the spacing, as they do
/// soon after the beginning of a run.
template <int Dim>
struct GasBox {
  int per_side;  // particles along each axis

  /// The box with about that many particles.
  static GasBox of_about(std::size_t particles) {
    return {static_cast<int>(std::lround(std::pow(static_cast<double>(particles), 1.0 / Dim)))};
  }

  double spacing() const { return 1.0 / per_side; }

  sphmbs::geometry::Domain<Dim> domain() const {
    sphmbs::geometry::Domain<Dim> box{{sphmbs::Vec<Dim>::all(0.0), sphmbs::Vec<Dim>::all(1.0)}, {}};
    box.periodic.fill(true);
    return box;
  }

  sphmbs::particles::Cloud<Dim> cloud() const {
    constexpr double speed = 34;  // [m/s]
    std::mt19937_64 engine(1);
    const auto stray = [&] {
      return 0.2 * spacing() * (2 * static_cast<double>(engine() >> 11) * 0x1p-53 - 1);
    };
    std::vector<sphmbs::Vec<Dim>> points;
    const int layers = Dim > 2 ? per_side : 1;
    for (int i = 0; i < per_side; ++i)
      for (int j = 0; j < per_side; ++j)
        for (int k = 0; k < layers; ++k) {
          const int cell[3] = {i, j, k};
          sphmbs::Vec<Dim> x;
          for (int axis = 0; axis < Dim; ++axis) x[axis] = (cell[axis] + 0.5) * spacing() + stray();
          points.push_back(x);
        }
    sphmbs::particles::Cloud<Dim> cloud;
    cloud.add_gas(points, {.rho = 1.2, .p = 1e5}, {.spacing = spacing()});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const sphmbs::Vec<Dim> phase = 2 * sphmbs::math::pi * points[i];
      double amplitude = speed;
      if constexpr (Dim > 2) amplitude *= std::cos(phase[2]);
      cloud.v[i][0] = amplitude * std::sin(phase[0]) * std::cos(phase[1]);
      cloud.v[i][1] = -amplitude * std::cos(phase[0]) * std::sin(phase[1]);
    }
    return cloud;
  }
};

}  // namespace bench
