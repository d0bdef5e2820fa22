// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/neighbours/neighbour_search.hpp>
#include <sphmbs/sph/pair_term.hpp>

namespace sphmbs::sph {

/// Rates of change of one particle from all its neighbours, eqs. (14) and (20)-(23). Gathers:
/// particle a is written by nobody else, so there are no races and no atomics, and the order of
/// summation is that of the list.
/// @tparam lanes  neighbours taken at once
template <class Scheme, class T, int lanes>
struct EvaluateRates {
  static constexpr int dim = Scheme::dim;

  Scheme scheme;
  geometry::Periodicity<dim, T> space;
  neighbours::NeighbourView neighbours;
  const T* records;
  const std::uint8_t* set;
  particles::RatesView<dim, T> rates;
  T keep;    // weight of the rates that are there already [-]
  T border;  // how far particles see across periodic borders [m]

  SPHMBS_INLINE void operator()(std::size_t i) const {
    const auto a = particles::load_record<dim>(records, i);
    const PairSums<dim, T> sum = space.near_border(a.r, border)
                                     ? gather(i, PairTerm<Scheme, T, true>{scheme, space, a})
                                     : gather(i, PairTerm<Scheme, T, false>{scheme, space, a});
    const bool moves = set[i] == particles::gas;
    const bool evolves = moves || Scheme::Wall::evolves;
    const T rho = evolves ? T(2) * sum.rho : T(0);
    write(rates.rho, i, rho, keep);
    write(rates.e, i, evolves ? sum.e : T(0), keep);
    write(rates.h, i, -a.h / (T(dim) * a.rho) * rho, keep);  // eq. (23)
    const T smoothing = static_cast<T>(2 * scheme.xsph.zeta);
    for (int k = 0; k < dim; ++k) {
      if (moves) {
        write(rates.v[k], i, sum.v[k] + static_cast<T>(scheme.acceleration[k]), keep);
        write(rates.r[k], i, a.v[k] + smoothing * sum.r[k], keep);  // eq. (14)
      } else {
        rates.v[k][i] = sum.v[k];
        rates.r[k][i] = k == 0 ? sum.power : T(0);
      }
    }
    rates.pairs[i] = static_cast<std::uint16_t>(sum.pairs < T(65535) ? sum.pairs : T(65535));
  }

 private:
  static SPHMBS_INLINE void write(T* field, std::size_t i, T value, T weight) {
    field[i] = weight != T(0) ? weight * field[i] + value : value;
  }

  template <class Term>
  SPHMBS_INLINE PairSums<dim, T> gather(std::size_t i, const Term& term) const {
    PairSums<dim, Number<T, lanes>> sum;
    const std::uint32_t* b = neighbours.list + neighbours.first[i];
    const std::uint32_t* const end = neighbours.list + neighbours.first[i + 1];
    for (; end - b >= lanes; b += lanes) term(particles::load_records<dim, lanes>(records, b), sum);
    T idle = 0;
    if (b != end) {
      // The last pack is filled up with the particle itself, which adds nothing but one to the
      // count.
      std::uint32_t rest[lanes];
#pragma GCC unroll 16
      for (int l = 0; l < lanes; ++l) rest[l] = l < end - b ? b[l] : static_cast<std::uint32_t>(i);
      idle = static_cast<T>(lanes - (end - b));
      term(particles::load_records<dim, lanes>(records, rest), sum);
    }
    PairSums<dim, T> total{.rho = lane_sum(sum.rho), .e = lane_sum(sum.e)};
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) {
      total.v[k] = lane_sum(sum.v[k]);
      total.r[k] = lane_sum(sum.r[k]);
    }
    total.power = lane_sum(sum.power);
    total.pairs = lane_sum(sum.pairs) - idle;
    return total;
  }
};

}  // namespace sphmbs::sph
