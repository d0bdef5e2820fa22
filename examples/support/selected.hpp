// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <sphmbs/reconstruction/limiters.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/riemann/exact.hpp>
#include <sphmbs/riemann/hllc.hpp>
#include <sphmbs/riemann/limited_acoustic.hpp>

namespace sphmbs::examples {

/// Where a name stands in a list.
inline int place_of(const std::string& name, const std::vector<std::string>& names) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// A Riemann solver chosen when the program starts, so that one program has them all.
struct SelectedRiemann {
  int which = 0;

  static std::vector<std::string> names() { return {"acoustic", "limited", "hllc", "exact"}; }
  static SelectedRiemann of(const std::string& name) { return {place_of(name, names())}; }

  template <class Eos, class N>
  SPHMBS_INLINE riemann::Star<N> star(const Eos& eos, const riemann::State<N>& left,
                                      const riemann::State<N>& right) const {
    switch (which) {
      case 0:
        return riemann::Acoustic{}.star(eos, left, right);
      case 1:
        return riemann::LimitedAcoustic{}.star(eos, left, right);
      case 2:
        return riemann::Hllc{}.star(eos, left, right);
      default:
        return riemann::Exact{}.star(eos, left, right);
    }
  }
  void check() const {}
};

/// A limiter chosen when the program starts.
struct SelectedLimiter {
  static constexpr bool limits_particles = false;
  int which = 0;

  static std::vector<std::string> names() { return {"van_leer", "minmod", "none"}; }
  static SelectedLimiter of(const std::string& name) { return {place_of(name, names())}; }

  template <class N>
  SPHMBS_INLINE N difference(N projected, N jump) const {
    switch (which) {
      case 0:
        return reconstruction::VanLeer{}.difference(projected, jump);
      case 1:
        return reconstruction::Minmod{}.difference(projected, jump);
      default:
        return reconstruction::Unlimited{}.difference(projected, jump);
    }
  }
};

}  // namespace sphmbs::examples
