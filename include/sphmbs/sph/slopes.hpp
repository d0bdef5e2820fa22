// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/fields.hpp>
#include <sphmbs/sph/gather.hpp>
#include <sphmbs/sph/scheme.hpp>
#include <sphmbs/sph/separation.hpp>

namespace sphmbs::sph {

/// Fields that have slopes: density, pressure, components of velocity.
template <int Dim>
inline constexpr int sloping_fields = 2 + Dim;

/// Sums over neighbours for the slopes of a particle: F = -(dW/dr) / r weighs.
template <int Dim, class N>
struct SlopeSums {
  Vec<Dim, N> moment[Dim];                 ///< sum V_b F d d^T [-]
  Vec<Dim, N> slope[sloping_fields<Dim>];  ///< sum V_b F d (f_b - f_a)
  N low[sloping_fields<Dim>];              ///< smallest f_b - f_a
  N high[sloping_fields<Dim>];             ///< largest f_b - f_a
  N reach2 = N(0);                         ///< squared distance of the farthest neighbour [m^2]

  SPHMBS_INLINE SlopeSums() {
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) moment[k] = Vec<Dim, N>::all(N(0));
#pragma GCC unroll 5
    for (int f = 0; f < sloping_fields<Dim>; ++f) {
      slope[f] = Vec<Dim, N>::all(N(0));
      low[f] = high[f] = N(0);
    }
  }
};

/// What a neighbour adds to these sums. Virtual particles count where they carry a state.
template <class Scheme, class T, bool wraps>
struct SlopeTerm {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  using Kernel = typename Scheme::Kernel;  ///< smoothing function of the scheme

  /// Periodic axes, across which the nearest image counts.
  const geometry::Periodicity<dim, T>& space;
  const particles::Record<dim, T>& a;  ///< the particle whose sums these are

  /// Adds the neighbour b, or a pack of them, to the sums.
  template <class N>
  SPHMBS_INLINE void operator()(const particles::Record<dim, N>& b,
                                const particles::Vicinity<dim, N>&, SlopeSums<dim, N>& sum) const {
    const Vec<dim, N> d = separation<wraps>(space, a, b);
    const N h = N(T(0.5)) * (N(a.h) + b.h);
    const N r2 = norm2(d);
    const N r = math::sqrt(math::max(r2, N(T(1e-12)) * h * h));
    const N reciprocal = N(T(1)) / (r * h * b.rho);
    const N inverse_h = r * b.rho * reciprocal;
    const N R = r * inverse_h;
    N weight = N(static_cast<T>(-Kernel::normalisation)) * math::power<dim>(inverse_h) *
               Kernel::slope(R) * b.m * reciprocal;
    if constexpr (!Scheme::Wall::evolves) weight = weight * (N(T(1)) - b.shell);
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) sum.moment[k] += (weight * d[k]) * d;
    N jump[sloping_fields<dim>];
    jump[0] = b.rho - N(a.rho);
    jump[1] = b.p - N(a.p);
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) jump[2 + k] = b.v[k] - N(a.v[k]);
#pragma GCC unroll 5
    for (int f = 0; f < sloping_fields<dim>; ++f) sum.slope[f] += (weight * jump[f]) * d;
    if constexpr (Scheme::Reconstruction::limits_particles) {
      const auto inside = weight > N(T(0));
      sum.reach2 = math::max(sum.reach2, math::select(inside, r2, N(T(0))));
#pragma GCC unroll 5
      for (int f = 0; f < sloping_fields<dim>; ++f) {
        const N seen = math::select(inside, jump[f], N(T(0)));
        sum.low[f] = math::min(sum.low[f], seen);
        sum.high[f] = math::max(sum.high[f], seen);
      }
    }
  }
};

/// Slopes of one gas particle, exact for linear fields on any arrangement: the sums are divided by
/// the matrix that they have for unit slopes (renormalisation). Where neighbours are so few or lie
/// so that this matrix is nearly singular, slopes are zero. Virtual particles without a state have
/// none.
template <class Scheme, class T, int lanes>
struct EvaluateSlopes {
  static constexpr int dim = Scheme::dim;             ///< dimension of space
  static constexpr int fields = sloping_fields<dim>;  ///< number of fields that have slopes

  geometry::Periodicity<dim, T> space;  ///< periodic axes, across which the nearest image counts
  Gathered<T> from;                     ///< neighbours, and what is known of them
  const std::uint8_t* set;              ///< sets of all particles
  T* vicinities;  ///< of all particles, see `particles::Vicinity`; null where the scheme needs none
  T border;       ///< how far particles see across periodic borders [m]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    if (!Scheme::Wall::evolves && particles::is_virtual(set[i])) return;
    const auto a = particles::load_record<dim>(from.records, i);
    const SlopeSums<dim, T> sum =
        space.near_border(a.r, border) ? sums<true>(i, a) : sums<false>(i, a);
    Vec<dim, T> inverse[dim];
    const bool regular = invert(sum.moment, inverse);
    Vec<dim, T> slope[fields];
#pragma GCC unroll 5
    for (int f = 0; f < fields; ++f) {
#pragma GCC unroll 3
      for (int k = 0; k < dim; ++k) slope[f][k] = regular ? dot(inverse[k], sum.slope[f]) : T(0);
      if constexpr (Scheme::Reconstruction::limits_particles) {
        const T most = T(0.5) * math::sqrt(norm2(slope[f]) * sum.reach2);
        const T room = math::min(sum.high[f], -sum.low[f]);
        if (most > room) slope[f] = (room / most) * slope[f];
      }
    }
    particles::Slopes<dim, T> found{slope[0], slope[1], {}};
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) found.v[k] = slope[2 + k];
    particles::store_slopes<dim, T>(vicinities, i, found);
  }

 private:
  template <bool wraps>
  SPHMBS_INLINE SlopeSums<dim, T> sums(std::size_t i, const particles::Record<dim, T>& a) const {
    SlopeSums<dim, Number<T, lanes>> sum;
    gather<dim, lanes, false>(from, i, SlopeTerm<Scheme, T, wraps>{space, a}, sum);
    SlopeSums<dim, T> total;
    total.reach2 = lane_max(sum.reach2);
#pragma GCC unroll 5
    for (int f = 0; f < fields; ++f) {
      total.low[f] = -lane_max(-sum.low[f]);
      total.high[f] = lane_max(sum.high[f]);
    }
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k) {
#pragma GCC unroll 3
      for (int j = 0; j < dim; ++j) total.moment[k][j] = lane_sum(sum.moment[k][j]);
#pragma GCC unroll 5
      for (int f = 0; f < fields; ++f) total.slope[f][k] = lane_sum(sum.slope[f][k]);
    }
    return total;
  }

  /// False where a determinant is below a hundredth of that of a full neighbourhood of equal trace.
  static SPHMBS_INLINE bool invert(const Vec<dim, T> (&m)[dim], Vec<dim, T> (&inverse)[dim]) {
    T trace = m[0][0];
    for (int k = 1; k < dim; ++k) trace += m[k][k];
    const T full = math::power<dim>(trace / T(dim));
    if constexpr (dim == 1) {
      inverse[0][0] = T(1) / m[0][0];
      return trace > T(0);
    } else if constexpr (dim == 2) {
      const T det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
      inverse[0][0] = m[1][1] / det;
      inverse[1][1] = m[0][0] / det;
      inverse[0][1] = inverse[1][0] = -m[0][1] / det;
      return det > T(0.01) * full;
    } else {
      const auto minor = [&](int i, int j) SPHMBS_INLINE_LAMBDA {
        const int k = (i + 1) % 3, l = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
        return m[k][p] * m[l][q] - m[k][q] * m[l][p];
      };
      const T det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k) {
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) inverse[k][j] = minor(j, k) / det;
      }
      return det > T(0.01) * full;
    }
  }
};

}  // namespace sphmbs::sph
