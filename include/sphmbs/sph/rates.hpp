// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/particles/fields.hpp>
#include <sphmbs/sph/gather.hpp>
#include <sphmbs/sph/pair_term.hpp>

namespace sphmbs::sph {

/// Rates of change of one particle from all its neighbours, eqs. (14) and (20)-(23). Gathers:
/// particle a is written by nobody else, so there are no races and no atomics, and the order of
/// summation is that of the list.
/// @tparam lanes  neighbours taken at once
template <class Scheme, class T, int lanes>
struct EvaluateRates {
  static constexpr int dim = Scheme::dim;  ///< dimension of space

  Scheme scheme;                        ///< with the numbers of its policies
  geometry::Periodicity<dim, T> space;  ///< periodic axes, across which the nearest image counts
  Gathered<T> from;                     ///< neighbours, and what is known of them
  const std::uint8_t* set;              ///< sets of all particles
  particles::RatesView<dim, T> rates;   ///< of all particles
  T keep;                               ///< weight of the rates that are there already [-]
  T border;                             ///< how far particles see across periodic borders [m]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const auto a = particles::load_record<dim>(from.records, i);
    const PairSums<dim, T> sum =
        space.near_border(a.r, border) ? sums<true>(i, a) : sums<false>(i, a);
    rates.pairs[i] = count(sum.pairs);
    rates.falls[i] = count(sum.falls);
    if (particles::is_opening(set[i])) {
      // It sees gas alone; its own rates are those of its opening.
      for (int k = 0; k < dim; ++k) rates.push[k][i] = sum.v[k];
      rates.heating[i] = sum.e;
      return;
    }
    const bool moves = set[i] == particles::gas;
    const bool evolves = moves || Scheme::Wall::evolves;
    const T rho = evolves ? T(2) * sum.rho + (moves ? relaxation(a, sum) : T(0)) : T(0);
    rates.write(rates.rho, i, rho, keep);
    rates.write(rates.e, i, evolves ? sum.e : T(0), keep);
    rates.write(rates.h, i, -a.h / (T(dim) * a.rho) * rho, keep);  // eq. (23)
    const Vec<dim, T> drift = moves ? velocity(a, sum) : Vec<dim, T>::all(T(0));
    for (int k = 0; k < dim; ++k) {
      if (moves) {
        rates.write(rates.v[k], i, sum.v[k] + static_cast<T>(scheme.acceleration[k]), keep);
        rates.write(rates.r[k], i, drift[k], keep);
      } else {
        rates.v[k][i] = sum.v[k];
        rates.r[k][i] = k == 0 ? sum.power : T(0);
      }
    }
  }

 private:
  SPHMBS_INLINE T relaxation([[maybe_unused]] const particles::Record<dim, T>& a,
                             [[maybe_unused]] const PairSums<dim, T>& sum) const {
    if constexpr (Scheme::Density::relaxes) {
      using Kernel = typename Scheme::Kernel;
      const T inverse_h = T(1) / a.h;
      const T own = a.m * static_cast<T>(Kernel::normalisation) * math::power<dim>(inverse_h) *
                    Kernel::shape(T(0));
      return static_cast<T>(scheme.density.rate) * a.c * inverse_h * (own + sum.density - a.rho);
    } else {
      return T(0);
    }
  }

  static SPHMBS_INLINE std::uint16_t count(T x) {
    return static_cast<std::uint16_t>(x < T(65535) ? x : T(65535));
  }

  /// Velocity at which the particle's position moves.
  SPHMBS_INLINE Vec<dim, T> velocity(const particles::Record<dim, T>& a,
                                     const PairSums<dim, T>& sum) const {
    Vec<dim, T> v = a.v + static_cast<T>(2 * scheme.smoothing.zeta) * sum.r;  // eq. (14)
    if constexpr (Scheme::Smoothing::shifts) {
      const Vec<dim, T> shift = (static_cast<T>(scheme.smoothing.strength) * a.c * a.h) * sum.crowd;
      const T most2 = static_cast<T>(scheme.smoothing.limit * scheme.smoothing.limit) * sum.spread;
      const T size2 = norm2(shift);
      v += (size2 > most2 ? math::sqrt(most2 / size2) : T(1)) * shift;
    }
    return v;
  }

  template <bool wraps>
  SPHMBS_INLINE PairSums<dim, T> sums(std::size_t i, const particles::Record<dim, T>& a) const {
    particles::Vicinity<dim, T> around{};
    if constexpr (Scheme::vicinity) around = particles::load_vicinity<dim>(from.vicinities, i);
    PairSums<dim, Number<T, lanes>> sum;
    const T idle = gather<dim, lanes, Scheme::vicinity>(
        from, i, PairTerm<Scheme, T, wraps>{scheme, space, a, around}, sum);
    PairSums<dim, T> total{.rho = lane_sum(sum.rho), .e = lane_sum(sum.e)};
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) {
      total.v[k] = lane_sum(sum.v[k]);
      total.r[k] = lane_sum(sum.r[k]);
      total.crowd[k] = lane_sum(sum.crowd[k]);
    }
    total.spread = lane_sum(sum.spread);
    total.power = lane_sum(sum.power);
    // The particle itself adds nothing but one to the count.
    total.pairs = lane_sum(sum.pairs) - idle;
    total.density = lane_sum(sum.density);
    total.falls = lane_sum(sum.falls);
    return total;
  }
};

}  // namespace sphmbs::sph
