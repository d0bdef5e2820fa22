// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/state.hpp"

namespace test {

/// Density of gas that depends on the distance from the origin alone, in shells.
template <int Dim>
class Shells {
 public:
  /// @param width  of a shell [m]
  Shells(const State<Dim>& gas, double width) : width_(width) {
    for (std::size_t i = 0; i < gas.size(); ++i) {
      const auto shell = static_cast<std::size_t>(std::sqrt(norm2(gas.r[i])) / width);
      if (shell >= mass_.size()) {
        mass_.resize(shell + 1);
        volume_.resize(shell + 1);
      }
      mass_[shell] += gas.m[i];
      volume_[shell] += gas.m[i] / gas.rho[i];
    }
  }

  /// Largest mean density of a shell.
  double peak() const {
    double most = 0;
    for (std::size_t i = 0; i < mass_.size(); ++i)
      if (volume_[i] > 0) most = std::max(most, mass_[i] / volume_[i]);
    return most;
  }

  /// The outermost radius at which the density passes a value, coming from outside.
  double outermost(double rho) const {
    double outer = 0, outer_rho = 0;
    bool known = false;
    for (std::size_t i = mass_.size(); i-- > 0;) {
      if (volume_[i] == 0) continue;
      const double here = mass_[i] / volume_[i];
      const double r = (static_cast<double>(i) + 0.5) * width_;
      if (known && here > rho) return r + (here - rho) / (here - outer_rho) * (outer - r);
      outer = r;
      outer_rho = here;
      known = true;
    }
    return 0;
  }

 private:
  double width_;
  std::vector<double> mass_, volume_;
};

/// sum V |rho - exact(r)| / sum V over the particles with r < within.
template <int Dim, class Exact>
double radial_l1(const State<Dim>& gas, double within, Exact&& exact) {
  double sum = 0;
  double volume = 0;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const double r = std::sqrt(norm2(gas.r[i]));
    if (r >= within) continue;
    const double V = gas.m[i] / gas.rho[i];
    sum += V * std::abs(gas.rho[i] - exact(r));
    volume += V;
  }
  return sum / volume;
}

}  // namespace test
