// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/core/vec.hpp>

namespace sphmbs::particles {

/// State of the gas at a point.
template <int Dim>
struct State {
  double rho;       ///< density [kg/m^3]
  double p;         ///< pressure [Pa]
  Vec<Dim> v = {};  ///< velocity [m/s]

  /// @throws InvalidInput for a density or pressure that is not positive and finite.
  void check() const {
    expects(std::isfinite(rho) && rho > 0, "density", rho, "positive [kg/m^3]");
    expects(std::isfinite(p) && p > 0, "pressure", p, "positive [Pa]");
  }
};

/// Size of the particles of a lattice.
struct Resolution {
  double spacing;                 ///< [m]
  double smoothing_ratio = 1.25;  ///< initial smoothing length / spacing, as in the paper [-]

  /// @throws InvalidInput for a spacing that is not positive and finite, or a ratio beyond 0.8
  /// to 4.
  void check() const {
    expects(std::isfinite(spacing) && spacing > 0, "spacing", spacing, "positive [m]");
    expects(smoothing_ratio >= 0.8 && smoothing_ratio <= 4, "smoothing length / spacing",
            smoothing_ratio, "between 0.8 and 4");
  }
};

}  // namespace sphmbs::particles
