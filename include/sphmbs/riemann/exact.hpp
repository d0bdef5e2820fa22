// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include <sphmbs/riemann/hllc.hpp>

namespace sphmbs::riemann {

/// Exact solution for ideal and stiffened gases (Toro 2009, Riemann Solvers and Numerical Methods
/// for Fluid Dynamics, ch. 4). Where both waves are rarefactions, or leave vacuum between them, it
/// has a closed form; where one is a shock, the pressure follows from Newton's iteration, begun
/// with `Hllc`, whose error is below 1e-12 of P* = p* + p_inf in double and 1e-6 in float. In
/// vacuum P* is 0 and u* the mean of both escape speeds. A pack iterates until its last lane is
/// done. p* of a stiffened gas carries the rounding of P*: some 50 Pa for water in float.
struct Exact {
  /// p* and u* of the exact solution, by Newton's method.
  template <class Eos, class N>
  SPHMBS_INLINE Star<N> star(const Eos& eos, const State<N>& left, const State<N>& right) const {
    static_assert(GammaLaw<Eos>,
                  "riemann::Exact needs an equation of state with a member gamma, the heat "
                  "capacity ratio");
    using T = Scalar<N>;
    const double gamma = eos.gamma;
    const N stiffness = detail::stiffness(left, right, gamma);
    const N Pl = math::max(left.p + stiffness, N(0));
    const N Pr = math::max(right.p + stiffness, N(0));
    const auto left_is_low = Pl < Pr;
    const Gas<N> gas{N(static_cast<T>((gamma + 1) / 2)), N(static_cast<T>((gamma - 1) / 2)),
                     N(static_cast<T>((gamma - 1) / (2 * gamma)))};
    const Side<N> low{math::select(left_is_low, left.rho, right.rho),
                      math::select(left_is_low, Pl, Pr),
                      math::select(left_is_low, left.c, right.c)};
    const Side<N> high{math::select(left_is_low, right.rho, left.rho),
                       math::select(left_is_low, Pr, Pl),
                       math::select(left_is_low, right.c, left.c)};
    const N closing = left.u - right.u;

    // (P* / P_low)^z of two rarefactions; above 1, the low side is a shock.
    const N tiny(static_cast<T>(detail::tiny));
    const N steepness = math::pow(low.P / math::max(high.P, tiny), gas.z);
    const N y = math::max(low.c + high.c + gas.down * closing, N(0)) /
                math::max(low.c + high.c * steepness, tiny);
    const auto shock = y > N(1);
    N u_low = low.c / gas.down * (y - N(1));
    N u_high = high.c / gas.down * (y * steepness - N(1));
    N P = low.P;
    if (math::any(y < N(1)))
      P = low.P * math::pow(math::min(y, N(1)), N(static_cast<T>(2 * gamma / (gamma - 1))));
    if (math::any(shock)) {
      const N start = Hllc{}.star(eos, left, right).p + stiffness;
      const N above = math::max(start, math::max(low.P, N(T(1e-6)) * high.P));
      newton(gas, low, high, closing, shock, math::select(shock, above, P), P, u_low, u_high);
    }
    const N drift = math::select(left_is_low, u_high - u_low, u_low - u_high);
    return {.p = P - stiffness, .u = N(T(0.5)) * (left.u + right.u + drift)};
  }

  /// Does nothing: no parameter can be out of range.
  void check() const {}

 private:
  template <class N>
  struct Gas {
    N up;    // (gamma + 1) / 2
    N down;  // (gamma - 1) / 2
    N z;     // (gamma - 1) / (2 gamma)
  };
  template <class N>
  struct Side {
    N rho;  // [kg/m^3]
    N P;    // p, or p + p_inf [Pa]
    N c;    // [m/s]
  };
  template <class N>
  struct Wave {
    N u;      // velocity change from the side to the contact [m/s]
    N slope;  // its derivative by P [m/(s Pa)]
  };

  template <class N>
  static SPHMBS_INLINE Wave<N> shock_wave(const Gas<N>& gas, const Side<N>& side, N P) {
    const N flux2 = gas.up * P + gas.down * side.P;
    const N root = N(1) / math::sqrt(side.rho * flux2);
    const N rise = P - side.P;
    return {rise * root, root * (N(1) - N(Scalar<N>(0.5)) * gas.up * rise / flux2)};
  }

  // In the lanes of `where`: the pressure, and the velocity changes of both waves there.
  template <class N, class M>
  static SPHMBS_INLINE void newton(const Gas<N>& gas, const Side<N>& low, const Side<N>& high,
                                   N closing, M where, N start, N& P, N& u_low, N& u_high) {
    using T = Scalar<N>;
    // The relative error after a step is of the size of the step's square.
    constexpr T tolerance = std::is_same_v<T, float> ? T(5e-4) : T(5e-7);
    P = start;
    for (int i = 0; i < 30; ++i) {
      const Wave<N> a = shock_wave(gas, low, P);
      Wave<N> b = shock_wave(gas, high, P);
      const auto fan = P < high.P;
      if (math::any(fan)) {
        const N w = math::pow(P / high.P, gas.z);
        b.u = math::select(fan, high.c / gas.down * (w - N(1)), b.u);
        b.slope = math::select(fan, w * high.P / (P * high.rho * high.c), b.slope);
      }
      const N wanted = P + (closing - a.u - b.u) / (a.slope + b.slope);
      // The curve is concave: a step down may pass the root and leave the positive pressures.
      const N next = math::max(wanted, math::max(low.P, N(T(0.01)) * P));
      const N step = math::select(where, next - P, N(0));
      u_low = math::select(where, a.u + a.slope * step, u_low);
      u_high = math::select(where, b.u + b.slope * step, u_high);
      P += step;
      if (!math::any(math::abs(step) > N(tolerance) * P)) break;
    }
  }
};

static_assert(RiemannSolver<Exact>);

}  // namespace sphmbs::riemann
