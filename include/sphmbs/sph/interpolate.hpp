// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/kernels/kernel.hpp>
#include <sphmbs/particles/record.hpp>

namespace sphmbs::sph {

/// The gas at a point, eq. (8) with particles of gas and openings only and divided by the sum of
/// their weights, so that a uniform field is met next to walls too. NaN throughout where no gas
/// particle is seen.
template <int Dim>
struct Sample {
  Vec<Dim> v;  ///< velocity [m/s]
  double rho;  ///< density [kg/m^3]
  double p;    ///< pressure [Pa]
  int seen;    ///< gas particles whose support covers the point
};

/// Sums over particles at a point, by kernel weights.
template <int Dim>
struct WeightedSum {
  double weight = 0;  ///< sum of the weights [-]
  Vec<Dim> v = {};    ///< [m/s]
  double rho = 0;     ///< [kg/m^3]
  double p = 0;       ///< [Pa]
  int seen = 0;       ///< particles

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const WeightedSum& o) {
    weight += o.weight;
    v += o.v;
    rho += o.rho;
    p += o.p;
    seen += o.seen;
  }

  /// Divided by the sum of the weights.
  Sample<Dim> sample() const {
    const double scale = weight > 0 ? 1 / weight : std::numeric_limits<double>::quiet_NaN();
    return {.v = scale * v, .rho = scale * rho, .p = scale * p, .seen = seen};
  }
};

/// What a particle's record contributes at point x.
template <kernels::Kernel Kernel, class T>
struct WeighAtPoint {
  static constexpr int dim = Kernel::dim;  ///< dimension of space
  const T* records;                        ///< of all particles, see `particles::Record`
  geometry::Periodicity<dim, T> space;     ///< periodic axes, across which the nearest image counts
  Vec<dim, T> x;                           ///< the point [m]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE WeightedSum<dim> operator()(std::size_t i) const {
    const auto s = particles::load_record<dim>(records, i);
    const Vec<dim> d = space.nearest(x - s.r).template to<double>();
    const double h = static_cast<double>(s.h);
    const double r2 = norm2(d);
    WeightedSum<dim> sum;
    if (s.shell != T(0) || !(r2 < Kernel::support * Kernel::support * h * h)) return sum;
    sum.weight = static_cast<double>(s.m) / static_cast<double>(s.rho) *
                 kernels::value<Kernel>(math::sqrt(r2), 1 / h);
    sum.v = sum.weight * s.v.template to<double>();
    sum.rho = sum.weight * static_cast<double>(s.rho);
    sum.p = sum.weight * static_cast<double>(s.p);
    sum.seen = 1;
    return sum;
  }
};

}  // namespace sphmbs::sph
