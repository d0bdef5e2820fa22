// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/particles/record.hpp>
#include <sphmbs/particles/slopes.hpp>
#include <sphmbs/sph/scheme.hpp>

namespace sphmbs::sph {

/// Where one particle of a pair at least is virtual.
template <int Dim, class T, class N>
SPHMBS_INLINE auto meets_wall(const particles::Record<Dim, T>& a,
                              const particles::Record<Dim, N>& b) {
  return N(a.shell) + b.shell > N(Scalar<N>(0.5));
}

/// What is found between the particles a and b of a pair.
template <int Dim, class N>
struct Between {
  riemann::Star<N> star;                    ///< velocity along the line from a to b, and pressure
  N u_a;                                    ///< velocity of a along that line, eq. (17) [m/s]
  N rho_a;                                  ///< densities that weigh the face between them [kg/m^3]
  N rho_b;                                  ///< of b
  N fell = N(0);                            ///< 1 where a reconstruction was refused
  Vec<Dim, N> relative;                     ///< v_b - v_a, b's as a sees it [m/s]
  Vec<Dim, N> dv = Vec<Dim, N>::all(N(0));  ///< v_a - v_b for the viscous stress [m/s]
  Vec<Dim, N> rubbing = Vec<Dim, N>::all(N(0));  ///< velocity by which that stress heats a [m/s]
  N dT = N(0);                                   ///< T_a - T_b for the conduction of heat [K]
  // Where gas slips only the part of the drag along the normal acts.
  N slips = N(0);                               ///< share by which it slips, 0 or 1
  Vec<Dim, N> normal = Vec<Dim, N>::all(N(0));  ///< of the wall
};

/// The two sides of a pair's Riemann problem and its solution: as the particles are, reconstructed
/// between gas and gas, by the wall model between gas and wall.
template <class Scheme, class T>
struct PairSides {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  using Wall = typename Scheme::Wall;      ///< wall model of the scheme

  const Scheme& scheme;                         ///< with the numbers of its policies
  const particles::Record<dim, T>& a;           ///< the particle whose sums these are
  const particles::Vicinity<dim, T>& around_a;  ///< slopes or surface at the particle

  /// For the neighbour b, or a pack of them, which lies d away from a.
  /// @param inverse_r  1/|d| [1/m]
  template <class N>
  SPHMBS_INLINE Between<dim, N> operator()(const particles::Record<dim, N>& b,
                                           const particles::Vicinity<dim, N>& around_b,
                                           const Vec<dim, N>& d, N inverse_r) const {
    // Eq. (17): velocities along the line from a to b.
    riemann::State<N> left{N(a.rho), dot(a.v, d) * inverse_r, N(a.p), N(a.c)};
    riemann::State<N> right{b.rho, dot(b.v, d) * inverse_r, b.p, b.c};
    Between<dim, N> found{
        .star = {}, .u_a = left.u, .rho_a = left.rho, .rho_b = right.rho, .relative = b.v - a.v};
    if constexpr (Scheme::Stress::acts) {
      found.dv = a.v - b.v;
      found.rubbing = N(T(0.5)) * found.dv;
      found.dT = N(scheme.eos.temperature(a.rho, a.p)) - scheme.eos.temperature(b.rho, b.p);
    }
    if constexpr (!Wall::evolves && !Wall::surfaces) {
      const riemann::State<N> stored = left;
      const N half = N(T(0.5));
      left = chosen(N(a.shell) * (N(T(1)) - b.shell) > half, scheme.wall.facing(right, stored),
                    stored);
      right = chosen(b.shell * N(T(1) - a.shell) > half, scheme.wall.facing(stored, right), right);
      if constexpr (Scheme::Stress::acts) {
        // Such walls take no heat: friction heats the gas alone.
        const auto wall = meets_wall(a, b);
        found.dT = math::select(wall, N(T(0)), found.dT);
        found.rubbing = chosen(wall, found.dv, found.rubbing);
      }
    }
    if constexpr (Scheme::Reconstruction::slopes)
      found.fell = reconstruct(b, around_b, d, inverse_r, left, right);
    found.star = scheme.riemann.star(scheme.eos, left, right);  // eqs. (16), (19)
    if constexpr (Wall::surfaces) {
      if (math::any(meets_wall(a, b))) meet_wall(b, around_b, d, inverse_r, found);
    }
    return found;
  }

 private:
  template <class Condition, class N>
  static SPHMBS_INLINE riemann::State<N> chosen(Condition yes, const riemann::State<N>& x,
                                                const riemann::State<N>& y) {
    return {math::select(yes, x.rho, y.rho), math::select(yes, x.u, y.u),
            math::select(yes, x.p, y.p), math::select(yes, x.c, y.c)};
  }
  template <class Condition, class N>
  static SPHMBS_INLINE Vec<dim, N> chosen(Condition yes, const Vec<dim, N>& x,
                                          const Vec<dim, N>& y) {
    Vec<dim, N> z;
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) z[k] = math::select(yes, x[k], y[k]);
    return z;
  }

  /// Carries both states to the middle of the pair; returns 1 where they would not be admissible.
  template <class N>
  SPHMBS_INLINE N reconstruct(const particles::Record<dim, N>& b,
                              const particles::Vicinity<dim, N>& around_b, const Vec<dim, N>& d,
                              N inverse_r, riemann::State<N>& left,
                              riemann::State<N>& right) const {
    const auto& method = scheme.reconstruction;
    const auto& sa = around_a.slopes;
    const auto& sb = around_b.slopes;
    N ua = N(T(0));
    N ub = N(T(0));
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) {
      ua += d[k] * dot(sa.v[k], d);
      ub += d[k] * dot(sb.v[k], d);
    }
    const N drho = right.rho - left.rho;
    const N du = right.u - left.u;
    const N dp = right.p - left.p;
    riemann::State<N> l{left.rho + method.step(N(dot(sa.rho, d)), drho),
                        left.u + method.step(ua * inverse_r, du),
                        left.p + method.step(N(dot(sa.p, d)), dp), N(T(0))};
    riemann::State<N> r{right.rho - method.step(N(dot(sb.rho, d)), drho),
                        right.u - method.step(ub * inverse_r, du),
                        right.p - method.step(N(dot(sb.p, d)), dp), N(T(0))};
    l.c = scheme.eos.sound_speed(l.rho, l.p);
    r.c = scheme.eos.sound_speed(r.rho, r.p);
    // A sound speed that is no number compares false. Across more than a shock's jump of density
    // two gases meet, of which the lighter one has no use for a slope between them.
    const N most = N(T(10));
    const auto good = (l.rho > N(T(0))) & (r.rho > N(T(0))) & (l.c > N(T(0))) & (r.c > N(T(0))) &
                      (left.rho < most * right.rho) & (right.rho < most * left.rho);
    if constexpr (Wall::evolves) {
      left = chosen(good, l, left);
      right = chosen(good, r, right);
      return math::select(good, N(T(0)), N(T(1)));
    } else {
      const auto gas = N(a.shell) + b.shell < N(T(0.5));
      left = chosen(good & gas, l, left);
      right = chosen(good & gas, r, right);
      return math::select(good, N(T(0)), math::select(gas, N(T(1)), N(T(0))));
    }
  }

  /// Replaces what was found where gas meets a virtual particle with what the wall model says.
  template <class N>
  SPHMBS_INLINE void meet_wall(const particles::Record<dim, N>& b,
                               const particles::Vicinity<dim, N>& around_b, const Vec<dim, N>& d,
                               N inverse_r, Between<dim, N>& found) const {
    const N half = N(T(0.5));
    const N back = N(T(-1));
    if (a.shell > T(0.5))
      touch(b.shell < half,
            {b, around_b.slopes, a.v.template to<N>(), back * d, back * around_a.surface.normal,
             N(around_a.surface.depth)},
            back, d, inverse_r, found);
    else
      touch(b.shell > half,
            {wide<N>(a), wide<N>(around_a.slopes), b.v, d, back * around_b.surface.normal,
             around_b.surface.depth},
            N(T(1)), d, inverse_r, found);
  }

  /// @param where  one of a and b is gas and the other one virtual
  /// @param side   1 if a is the gas, -1 if b is
  template <class Condition, class N>
  SPHMBS_INLINE void touch(Condition where, const boundary::Meeting<dim, N>& meeting, N side,
                           const Vec<dim, N>& d, N inverse_r, Between<dim, N>& found) const {
    const boundary::Contact<dim, N> contact = scheme.wall.contact(meeting);
    found.star.p = math::select(where, contact.p, found.star.p);
    found.star.u = math::select(where, dot(contact.v, d) * inverse_r, found.star.u);
    // Linear through the middle: the far end is as far off again.
    Vec<dim, N> twice = N(T(2)) * side * (meeting.gas.v - contact.v);
    found.relative = chosen(where, N(T(-1)) * twice, found.relative);
    if constexpr (Scheme::Stress::acts) {
      Vec<dim, N> rubbing = found.dv;  // all friction heats the gas
      const N lets = N(static_cast<T>(scheme.wall.isothermal ? 2 : 0));
      found.dT = math::select(where, lets * contact.phi * found.dT, found.dT);
      // Gas that slips shears nothing at the wall.
      if constexpr (Wall::slips) {
        twice = dot(twice, meeting.normal) * meeting.normal;
        rubbing = dot(rubbing, meeting.normal) * meeting.normal;
        found.slips = math::select(where, N(T(1)), N(T(0)));
        found.normal = meeting.normal;
      }
      found.dv = chosen(where, twice, found.dv);
      found.rubbing = chosen(where, rubbing, found.rubbing);
    }
  }

  template <class N>
  static SPHMBS_INLINE particles::Record<dim, N> wide(const particles::Record<dim, T>& s) {
    return {s.r.template to<N>(),
            s.v.template to<N>(),
            N(s.rho),
            N(s.p),
            N(s.c),
            N(s.h),
            N(s.m),
            N(s.shell),
            {}};
  }
  template <class N>
  static SPHMBS_INLINE particles::Slopes<dim, N> wide(const particles::Slopes<dim, T>& s) {
    particles::Slopes<dim, N> w{s.rho.template to<N>(), s.p.template to<N>(), {}};
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) w.v[k] = s.v[k].template to<N>();
    return w;
  }
};

}  // namespace sphmbs::sph
