// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/state.hpp"

namespace test {

/// The best that there is for shocks. Volumes must weigh the faces and the density must relax, or
/// the jump conditions are missed at any resolution.
template <int Dim, class Riemann = sphmbs::riemann::Hllc,
          class Limiter = sphmbs::reconstruction::VanLeer, class Smoothing = sphmbs::sph::NoXsph>
using ShockGas =
    sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<Dim>, Riemann, sphmbs::eos::IdealGas,
                            sphmbs::reconstruction::Muscl<Limiter>, sphmbs::sph::VolumeForm,
                            sphmbs::sph::Relaxed, Smoothing>;

/// Particles of gas at the end of a run, ordered along x.
struct Station {
  double x;    // [m]
  double rho;  // [kg/m^3]
  double u;    // [m/s]
  double p;    // [Pa]
  double m;    // [kg/m^2]
  double h;    // [m]
  double volume() const { return m / rho; }
};

/// Gas on a line: stretches of uniform gas, between walls or free ends.
class Tube {
 public:
  explicit Tube(double gamma = 1.4) : gamma_(gamma) {}

  /// Adds uniform gas from a to b, `count` particles, and five virtual ones beyond each end asked
  /// for.
  Tube& fill(const sphmbs::riemann::Primitive& state, double a, double b, long count,
             bool wall_before = false, bool wall_behind = false) {
    const double dx = (b - a) / static_cast<double>(count);
    std::vector<sphmbs::Vec<1>> gas, wall;
    for (long i = wall_before ? -5 : 0; i < count + (wall_behind ? 5 : 0); ++i) {
      const sphmbs::Vec<1> x{a + (static_cast<double>(i) + 0.5) * dx};
      (i >= 0 && i < count ? gas : wall).push_back(x);
    }
    const sphmbs::particles::State<1> s{.rho = state.rho, .p = state.p, .v = {state.u}};
    cloud_.add_gas(gas, s, {dx});
    if (!wall.empty()) cloud_.add_virtual(wall, s, {dx});
    return *this;
  }

  /// The gas after a time.
  template <class Gas>
  std::vector<Station> after(double time, double cfl = 0.3) const {
    const sphmbs::geometry::Domain<1> domain{{{-100.0}, {100.0}}, {}};
    sphmbs::sph::Fluid<Gas, sphmbs::execution::Serial> fluid(Gas{.eos = {.gamma = gamma_}}, domain,
                                                             cloud_);
    sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = time, .cfl = cfl},
                sphmbs::no_report);
    const auto end = state_of(fluid);
    std::vector<Station> found;
    for (std::size_t i = 0; i < end.size(); ++i)
      if (cloud_.set[i] == sphmbs::particles::gas)
        found.push_back({end.r[i][0], end.rho[i], end.v[i][0], (gamma_ - 1) * end.rho[i] * end.e[i],
                         end.m[i], end.h[i]});
    std::sort(found.begin(), found.end(),
              [](const Station& a, const Station& b) { return a.x < b.x; });
    return found;
  }

 private:
  double gamma_;
  sphmbs::particles::Cloud<1> cloud_;
};

/// sum V |f - exact(x)| / sum V over the gas between a and b.
template <class Field, class Exact>
double mean_error(const std::vector<Station>& gas, double a, double b, Field&& field,
                  Exact&& exact) {
  double sum = 0;
  double volume = 0;
  for (const Station& s : gas) {
    if (s.x < a || s.x > b) continue;
    sum += s.volume() * std::abs(field(s) - exact(s.x));
    volume += s.volume();
  }
  return sum / volume;
}

/// Whether every number is finite and every density and pressure positive.
inline bool sound(const std::vector<Station>& gas) {
  return std::all_of(gas.begin(), gas.end(), [](const Station& s) {
    return std::isfinite(s.x) && std::isfinite(s.u) && std::isfinite(s.rho) && std::isfinite(s.p) &&
           s.rho > 0 && s.p > 0;
  });
}

}  // namespace test
