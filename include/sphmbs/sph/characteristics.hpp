// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/opening.hpp>
#include <sphmbs/sph/gather.hpp>
#include <sphmbs/sph/scheme.hpp>

namespace sphmbs::sph {

/// Sums over what is in front of an opening's particle, gas and others of the opening, by kernel
/// weights.
template <int Dim, class N>
struct InFront {
  N weight = N(0);
  N p = N(0);
  N u = N(0);          // velocity into the gas [m/s]
  N impedance = N(0);  // rho c [kg/(m^2 s)]
  N c = N(0);
  N distance = N(0);  // from the particle, across the face [m]
};

template <class Scheme, class T, bool wraps>
struct FrontTerm {
  static constexpr int dim = Scheme::dim;
  using Kernel = typename Scheme::Kernel;
  const geometry::Periodicity<dim, T>& space;
  const particles::Record<dim, T>& a;
  const particles::OpeningView<dim, T>& opening;

  template <class N>
  SPHMBS_INLINE void operator()(const particles::Record<dim, N>& b,
                                const particles::Vicinity<dim, N>&, InFront<dim, N>& sum) const {
    Vec<dim, N> d = b.r - a.r;
    if constexpr (wraps) d = space.nearest(d);
    const N R = math::sqrt(norm2(d)) / (N(T(0.5)) * (N(a.h) + b.h));
    const N front = opening.along(d);
    const auto counts = (front > N(T(0))) & (b.shell < N(T(0.5)));
    const N weight = math::select(counts, Kernel::shape(R) * front, N(T(0)));
    sum.weight += weight;
    sum.p += weight * b.p;
    sum.u += weight * opening.along(b.v);
    sum.impedance += weight * b.rho * b.c;
    sum.c += weight * b.c;
    sum.distance += weight * front;
  }
};

/// Rates of change of a particle of an opening. Of the two waves
/// across the face, p - Z u runs out of the gas (u into the gas, Z = rho c) and comes to be that of
/// the gas nearby, later by the time sound takes from there; p + Z u runs into the gas and stays
/// what it was: that of the far gas where gas comes in, where it goes out that with which it left.
/// So sound and whatever the flow carries leave, and the far gas alone sends waves in; these draw
/// the pressure to that of the far gas within the time that sound takes to come from there. Entropy
/// and the velocity along the face stay. Where the flow is faster than sound all comes from
/// upstream. After Thompson (1987) and Poinsot & Lele (1992).
template <class Scheme, class T, int lanes>
struct EvaluateOpening {
  static constexpr int dim = Scheme::dim;

  geometry::Periodicity<dim, T> space;
  Gathered<T> from;
  const particles::OpeningView<dim, T>* openings;
  const std::uint8_t* set;
  particles::RatesView<dim, T> rates;
  T keep;    // weight of the rates that are there already [-]
  T border;  // how far particles see across periodic borders [m]

  SPHMBS_INLINE void operator()(std::size_t i) const {
    if (!particles::is_opening(set[i])) return;
    const particles::OpeningView<dim, T>& opening = openings[particles::opening_of(set[i])];
    const auto a = particles::load_record<dim>(from.records, i);
    const InFront<dim, T> front =
        space.near_border(a.r, border) ? mean<true>(i, a, opening) : mean<false>(i, a, opening);
    const T own_u = opening.along(a.v);
    T p_rate = T(0), u_rate = T(0);
    if (front.weight > T(0)) {
      const T share = T(1) / front.weight;
      const T p = share * front.p, u = share * front.u, Z = share * front.impedance,
              c = share * front.c;
      const T delay = math::max(share * front.distance, T(0.5) * a.h) / c;
      T leaving = ((p - Z * u) - (a.p - Z * own_u)) / delay;
      T coming = c / opening.distance * (opening.p - a.p);
      if (u > c) leaving = T(0);
      if (u < -c) coming = ((p + Z * u) - (a.p + Z * own_u)) / delay;
      p_rate = T(0.5) * (leaving + coming);
      u_rate = (coming - leaving) / (T(2) * Z);
    }
    const T rho_rate = p_rate / (a.c * a.c);
    write(rates.rho, i, rho_rate);
    write(rates.e, i, a.p / (a.rho * a.rho) * rho_rate);
    write(rates.h, i, T(0));
    for (int k = 0; k < dim; ++k) {
      write(rates.r[k], i, a.v[k]);
      write(rates.v[k], i, k == opening.axis ? opening.side * u_rate : T(0));
    }
  }

 private:
  SPHMBS_INLINE void write(T* field, std::size_t i, T value) const {
    field[i] = keep != T(0) ? keep * field[i] + value : value;
  }

  template <bool wraps>
  SPHMBS_INLINE InFront<dim, T> mean(std::size_t i, const particles::Record<dim, T>& a,
                                     const particles::OpeningView<dim, T>& opening) const {
    InFront<dim, Number<T, lanes>> sum;
    gather<dim, lanes, false>(from, i, FrontTerm<Scheme, T, wraps>{space, a, opening}, sum);
    return {lane_sum(sum.weight),    lane_sum(sum.p), lane_sum(sum.u),
            lane_sum(sum.impedance), lane_sum(sum.c), lane_sum(sum.distance)};
  }
};

}  // namespace sphmbs::sph
