// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/sph/pair_sides.hpp>
#include <sphmbs/sph/separation.hpp>

namespace sphmbs::sph {

/// Sums over the neighbours of a particle, in number type N.
template <int Dim, class N>
struct PairSums {
  N rho = N(0);                                ///< half of eq. (20)
  N e = N(0);                                  ///< eq. (22) and heat
  Vec<Dim, N> v = Vec<Dim, N>::all(N(0));      ///< eq. (21) and viscous stress
  Vec<Dim, N> r = Vec<Dim, N>::all(N(0));      ///< the sum of eq. (14), without its sign
  Vec<Dim, N> crowd = Vec<Dim, N>::all(N(0));  ///< -sum of V_b grad W [1/m]
  N spread = N(0);                             ///< mean square of relative velocities [m^2/s^2]
  // By m_a, on a virtual particle: the power of other virtual particles; with surfaces what the
  // gas gets from a less than the work of its force.
  N power = N(0);    ///< [W/kg]
  N pairs = N(0);    ///< neighbours inside the support
  N density = N(0);  ///< sum of m_b W [kg/m^3]
  N falls = N(0);    ///< pairs whose reconstruction was refused
};

/// The paper's page: what a neighbour b adds to the rates of particle a, eqs. (14) and (20)-(22).
/// The only place where gas meets gas.
/// @tparam wraps  whether the neighbour may be a periodic image
template <class Scheme, class T, bool wraps>
struct PairTerm {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  using Kernel = typename Scheme::Kernel;  ///< smoothing function of the scheme
  using Wall = typename Scheme::Wall;      ///< wall model of the scheme

  const Scheme& scheme;  ///< with the numbers of its policies
  /// Periodic axes, across which the nearest image counts.
  const geometry::Periodicity<dim, T>& space;
  const particles::Record<dim, T>& a;           ///< the particle whose sums these are
  const particles::Vicinity<dim, T>& around_a;  ///< slopes or surface at the particle

  /// Adds the neighbour b, or a pack of them, to the sums.
  template <class N>
  SPHMBS_INLINE void operator()(const particles::Record<dim, N>& b,
                                const particles::Vicinity<dim, N>& around_b,
                                PairSums<dim, N>& sum) const {
    const Vec<dim, N> d = separation<wraps>(space, a, b);
    const N h = N(T(0.5)) * (N(a.h) + b.h);  // eq. (24)
    // Two particles at one point have no line between them: a floor keeps them finite and apart.
    const N r = math::sqrt(math::max(norm2(d), N(T(1e-12)) * h * h));
    const N reciprocal = N(T(1)) / (r * h);
    const N inverse_r = h * reciprocal;
    const N inverse_h = r * reciprocal;
    const N R = r * inverse_h;

    const PairSides<Scheme, T> sides{scheme, a, around_a};
    const Between<dim, N> between = sides(b, around_b, d, inverse_r);

    const N scale = N(static_cast<T>(Kernel::normalisation)) * math::power<dim>(inverse_h) * b.m;
    const N mdW = scale * inverse_h * Kernel::slope(R);  // m_b / h dW/dR, not positive
    const N du = between.star.u - between.u_a;
    // A virtual particle without a state has a volume, whatever the gas's density.
    N area = scheme.form.area(between.rho_a, between.rho_b);
    N dilation = scheme.form.dilation(between.rho_a, between.rho_b);
    if constexpr (!Wall::evolves) {
      const auto wall = meets_wall(a, b);
      area = math::select(wall, VolumeForm{}.area(between.rho_a, between.rho_b), area);
      dilation = math::select(wall, VolumeForm{}.dilation(between.rho_a, between.rho_b), dilation);
    }
    const N face = mdW * area;
    const N push = face * (between.star.p - N(static_cast<T>(scheme.background)));
    const N load = N(T(1)) - N(a.shell) * b.shell;  // pairs of virtual particles carry no load
    sum.rho += mdW * du * dilation;
    sum.e += face * between.star.p * du;
    sum.v += (push * inverse_r * load) * d;
    if constexpr (Wall::surfaces)
      sum.power += push * (N(a.shell) - b.shell * N(a.shell)) * du;
    else if constexpr (Wall::evolves)
      sum.power += push * (N(T(1)) - load) * between.u_a;
    [[maybe_unused]] const N mW = scale * Kernel::shape(R);  // m_b W
    if constexpr (Scheme::Smoothing::acts) {
      sum.r += (mW / (N(a.rho) + b.rho)) * between.relative;
      if constexpr (Scheme::Smoothing::shifts) {
        const N volume = N(T(1)) / b.rho;
        sum.crowd += (mdW * volume * inverse_r) * d;
        sum.spread += mW * volume * norm2(between.relative);
      }
    }
    if constexpr (Scheme::Density::relaxes) {
      // m_a W: lighter particles beside heavier ones are not drawn to their density.
      N weight = mW * (N(a.m) / b.m);
      if constexpr (!Wall::evolves)
        weight =
            math::select(b.shell > N(T(0.5)), weight * (N(a.rho) * b.m) / (b.rho * N(a.m)), weight);
      // The particle itself, which fills up packs, is no neighbour.
      sum.density += math::select(R > N(T(1e-5)), weight, N(T(0)));
    }
    if constexpr (Scheme::Stress::acts) {
      const N share = (N(T(0)) - mdW) * inverse_r / (N(a.rho) * b.rho);
      Vec<dim, N> drag = scheme.stress.drag(share, inverse_r * d, between.dv);
      if constexpr (Wall::slips)
        drag -= between.slips * (drag - dot(drag, between.normal) * between.normal);
      const N heat = scheme.stress.conduction(share, between.dT);
      sum.v -= load * drag;
      if constexpr (Wall::surfaces)
        sum.power -= N(a.shell) * load * heat;
      else if constexpr (Wall::evolves)
        sum.power -= (N(T(1)) - load) * dot(drag, a.v);
      sum.e += dot(drag, between.rubbing) - heat;
    }
    const N inside = math::select(R < N(static_cast<T>(Kernel::support)), N(T(1)), N(T(0)));
    sum.pairs += inside;
    sum.falls += inside * between.fell;
  }
};

}  // namespace sphmbs::sph
