// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/record.hpp>
#include <sphmbs/sph/scheme.hpp>

namespace sphmbs::sph {

/// Sums over the neighbours of a particle, in number type N.
template <int Dim, class N>
struct PairSums {
  N rho = N(0);                            // half of eq. (20)
  N e = N(0);                              // eq. (22) and heat
  Vec<Dim, N> v = Vec<Dim, N>::all(N(0));  // eq. (21) and viscous stress
  Vec<Dim, N> r = Vec<Dim, N>::all(N(0));  // the sum of eq. (14), without its sign
  N power = N(0);                          // of virtual particles on virtual particle a, by m_a
  N pairs = N(0);                          // neighbours inside the support
};

/// The paper's page: what a neighbour b adds to the rates of particle a, eqs. (14) and (20)-(22).
/// The only place where gas meets gas.
/// @tparam wraps  whether the neighbour may be a periodic image
template <class Scheme, class T, bool wraps>
struct PairTerm {
  static constexpr int dim = Scheme::dim;
  using Kernel = typename Scheme::Kernel;

  const Scheme& scheme;
  const geometry::Periodicity<dim, T>& space;
  const particles::Record<dim, T>& a;

  template <class N>
  SPHMBS_INLINE void operator()(const particles::Record<dim, N>& b, PairSums<dim, N>& sum) const {
    Vec<dim, N> d = b.r - a.r;
    if constexpr (wraps) d = space.nearest(d);
    const N h = N(T(0.5)) * (N(a.h) + b.h);  // eq. (24)
    // Two particles at one point have no line between them: a floor keeps them finite and apart.
    const N r = math::sqrt(math::max(norm2(d), N(T(1e-12)) * h * h));
    const N reciprocal = N(T(1)) / (r * h);
    const N inverse_r = h * reciprocal;
    const N inverse_h = r * reciprocal;
    const N R = r * inverse_h;

    // Eq. (17): velocities along the line from a to b.
    riemann::State<N> left{N(a.rho), dot(a.v, d) * inverse_r, N(a.p), N(a.c)};
    riemann::State<N> right{b.rho, dot(b.v, d) * inverse_r, b.p, b.c};
    if constexpr (!Scheme::Wall::evolves) {
      const riemann::State<N> stored = left;
      left = replaced(N(a.shell) * (N(T(1)) - b.shell), stored, scheme.wall.facing(right, stored));
      right = replaced(b.shell * N(T(1) - a.shell), right, scheme.wall.facing(stored, right));
    }
    const riemann::Star<N> star = scheme.riemann.star(left, right);  // eqs. (16), (19)

    const N scale = N(static_cast<T>(Kernel::normalisation)) * math::power<dim>(inverse_h) * b.m;
    const N mdW = scale * inverse_h * Kernel::slope(R);  // m_b / h dW/dR, not positive
    const N du = star.u - left.u;
    const N push =
        mdW * star.p * (N(T(1)) / (left.rho * left.rho) + N(T(1)) / (right.rho * right.rho));
    const N load = N(T(1)) - N(a.shell) * b.shell;  // pairs of virtual particles carry no load
    sum.rho += mdW * du;
    sum.e += push * du;
    sum.v += (push * inverse_r * load) * d;
    sum.power += push * (N(T(1)) - load) * left.u;
    if constexpr (decltype(scheme.xsph)::acts)
      sum.r += (scale * Kernel::shape(R) / (N(a.rho) + b.rho)) * (b.v - a.v);
    if constexpr (decltype(scheme.stress)::acts) {
      const auto transport = scheme.stress.pair(
          scheme.eos, a, b, PairGeometry<dim, N>{inverse_r * d, (N(T(0)) - mdW) * inverse_r / b.m});
      sum.v += load * transport.v;
      sum.power += (N(T(1)) - load) * dot(transport.v, a.v);
      sum.e += transport.e;
    }
    sum.pairs += math::select(R < N(static_cast<T>(Kernel::support)), N(T(1)), N(T(0)));
  }

 private:
  template <class N>
  static SPHMBS_INLINE riemann::State<N> replaced(N where, const riemann::State<N>& stored,
                                                  const riemann::State<N>& facing) {
    const auto yes = where > N(T(0.5));
    return {math::select(yes, facing.rho, stored.rho), math::select(yes, facing.u, stored.u),
            math::select(yes, facing.p, stored.p), math::select(yes, facing.c, stored.c)};
  }
};

}  // namespace sphmbs::sph
