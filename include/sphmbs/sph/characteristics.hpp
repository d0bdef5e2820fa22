// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/opening.hpp>
#include <sphmbs/sph/gather.hpp>
#include <sphmbs/sph/scheme.hpp>
#include <sphmbs/sph/separation.hpp>

namespace sphmbs::sph {

/// Sums around an opening's particle over gas and others of the opening, by kernel weights.
template <int Dim, class N>
struct AroundOpening {
  // Over what is in front of it, by the distance across the face too.
  N weight = N(0);     ///< sum of the weights
  N p = N(0);          ///< pressure [Pa]
  N u = N(0);          ///< velocity into the gas [m/s]
  N impedance = N(0);  ///< rho c [kg/(m^2 s)]
  N c = N(0);          ///< sound speed [m/s]
  N distance = N(0);   ///< across the face [m]
  // Over all.
  N number = N(0);                         ///< sum of the weights
  Vec<Dim, N> v = Vec<Dim, N>::all(N(0));  ///< velocity [m/s]
};

/// What a neighbour adds to the sums around a particle of an opening.
template <class Scheme, class T, bool wraps>
struct OpeningTerm {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  using Kernel = typename Scheme::Kernel;  ///< smoothing function of the scheme
  /// Periodic axes, across which the nearest image counts.
  const geometry::Periodicity<dim, T>& space;
  const particles::Record<dim, T>& a;             ///< the particle whose sums these are
  const particles::OpeningView<dim, T>& opening;  ///< that the particle belongs to

  /// Adds the neighbour b, or a pack of them, to the sums.
  template <class N>
  SPHMBS_INLINE void operator()(const particles::Record<dim, N>& b,
                                const particles::Vicinity<dim, N>&,
                                AroundOpening<dim, N>& sum) const {
    const Vec<dim, N> d = separation<wraps>(space, a, b);
    const N R = math::sqrt(norm2(d)) / (N(T(0.5)) * (N(a.h) + b.h));
    // The particle itself, which fills up packs, is no neighbour.
    const N shape = math::select(R > N(T(1e-5)), Kernel::shape(R), N(T(0)));
    const N front = opening.along(d);
    const N weight = shape * math::max(front, N(T(0)));
    sum.weight += weight;
    sum.p += weight * b.p;
    sum.u += weight * opening.along(b.v);
    sum.impedance += weight * b.rho * b.c;
    sum.c += weight * b.c;
    sum.distance += weight * front;
    sum.number += shape;
    sum.v += shape * b.v;
  }
};

/// Rates of change of a particle of an opening. Of the two waves across the face, w = p - Z u runs
/// out of the gas (u into the gas, Z = rho c) and comes to be that of what is in front of the
/// particle, l away, in the time l/c; q = p + Z u runs into the gas and stays what it was: that of
/// the far gas where gas comes in, where it goes out that with which it left. So sound and whatever
/// the flow carries leave, and the far gas alone sends waves in; these draw the pressure to that of
/// the far gas at the rate c/(2 distance). Entropy and the velocity along the face stay. What turns
/// round and comes in again becomes the far gas, in the time l/c. Where the flow is faster than
/// sound all comes from upstream. After Thompson (1987) and Poinsot & Lele (1992).
///
/// The particle moves with the mean velocity around it: particles of different origin have
/// different velocities at one pressure, and would run into each other.
template <class Scheme, class T, int lanes>
struct EvaluateOpening {
  static constexpr int dim = Scheme::dim;  ///< dimension of space

  /// Of the gas.
  decltype(Scheme::eos) eos;
  geometry::Periodicity<dim, T> space;  ///< periodic axes, across which the nearest image counts
  Gathered<T> from;                     ///< neighbours, and what is known of them
  const particles::OpeningView<dim, T>* openings;  ///< all of them, by number
  const std::uint8_t* set;                         ///< sets of all particles
  particles::RatesView<dim, T> rates;              ///< of all particles
  T keep;    ///< weight of the rates that are there already [-]
  T border;  ///< how far particles see across periodic borders [m]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    if (!particles::is_opening(set[i])) return;
    const particles::OpeningView<dim, T>& o = openings[particles::opening_of(set[i])];
    const auto a = particles::load_record<dim>(from.records, i);
    const AroundOpening<dim, T> sum =
        space.near_border(a.r, border) ? around<true>(i, a, o) : around<false>(i, a, o);
    const T own_u = o.along(a.v);
    T p_rate = T(0), u_rate = T(0), rho_rate = T(0), e_rate = T(0);
    Vec<dim, T> v_rate = Vec<dim, T>::all(T(0));
    if (sum.weight > T(0)) {
      const T share = T(1) / sum.weight;
      const T p = share * sum.p, u = share * sum.u, Z = share * sum.impedance, c = share * sum.c;
      const T soon = c / math::max(share * sum.distance, T(0.5) * a.h);  // 1 / delay [1/s]
      const bool comes = own_u > T(0);
      const T far_u = o.along(o.v);
      T leaving = soon * ((p - Z * u) - (a.p - Z * own_u));
      T coming = c / o.distance * (o.p - a.p);
      if (comes) coming += soon * ((o.p + Z * far_u) - (a.p + Z * own_u));
      if (own_u > c) leaving = soon * ((o.p - Z * far_u) - (a.p - Z * own_u));
      if (own_u < -c) coming = soon * ((p + Z * u) - (a.p + Z * own_u));
      p_rate = T(0.5) * (leaving + coming);
      u_rate = (coming - leaving) / (T(2) * Z);
      if (comes) {
        const T rho = o.density(a.p);
        rho_rate = soon * (rho - a.rho);
        e_rate =
            soon * static_cast<T>(eos.internal_energy(rho, a.p) - eos.internal_energy(a.rho, a.p));
        v_rate = soon * (o.v - a.v);
      }
    }
    v_rate[o.axis] = o.side * u_rate;
    const T compression = p_rate / (a.c * a.c);  // along an isentrope
    rates.write(rates.rho, i, compression + rho_rate, keep);
    rates.write(rates.e, i, a.p / (a.rho * a.rho) * compression + e_rate, keep);
    rates.write(rates.h, i, -a.h / (T(dim) * a.rho) * (compression + rho_rate), keep);
    const T self = Scheme::Kernel::shape(T(0));
    const Vec<dim, T> way = T(1) / (self + sum.number) * (self * a.v + sum.v);
    for (int k = 0; k < dim; ++k) {
      rates.write(rates.r[k], i, way[k], keep);
      rates.write(rates.v[k], i, v_rate[k], keep);
    }
  }

 private:
  template <bool wraps>
  SPHMBS_INLINE AroundOpening<dim, T> around(std::size_t i, const particles::Record<dim, T>& a,
                                             const particles::OpeningView<dim, T>& o) const {
    AroundOpening<dim, Number<T, lanes>> sum;
    gather<dim, lanes, false>(from, i, OpeningTerm<Scheme, T, wraps>{space, a, o}, sum);
    AroundOpening<dim, T> total{lane_sum(sum.weight),    lane_sum(sum.p), lane_sum(sum.u),
                                lane_sum(sum.impedance), lane_sum(sum.c), lane_sum(sum.distance),
                                lane_sum(sum.number)};
    for (int k = 0; k < dim; ++k) total.v[k] = lane_sum(sum.v[k]);
    return total;
  }
};

}  // namespace sphmbs::sph
