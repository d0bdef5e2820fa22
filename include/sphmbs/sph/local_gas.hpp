// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include <sphmbs/core/vec.hpp>
#include <sphmbs/particles/fields.hpp>

namespace sphmbs::sph {

/// The gas at a point: means over gas particles whose support covers it, with the weights m / rho W
/// divided by their sum (Shepard), so that a uniform field is met next to walls too. Virtual
/// particles are no gas; particles of openings are. Behind a wall the gas in front of it counts up
/// to one support radius. All is NaN where no gas is seen.
template <int Dim>
struct LocalGas {
  double rho;  ///< density [kg/m^3]
  double p;    ///< pressure [Pa]
  double e;    ///< specific internal energy [J/kg]
  Vec<Dim> v;  ///< velocity [m/s]
  /// Sum of the weights [-]: about 1 inside gas, a half at a wall, less behind it, 0 without gas.
  double share;
  std::uint32_t seen;  ///< gas particles that contribute
};

/// The gas whose particles are in a box; particles of openings are not in the gas here, so that
/// boxes that fill the domain add up to its totals. Planar gas per metre of depth.
template <int Dim>
struct GasInside {
  std::uint64_t particles = 0;  ///< whose centres are in the box
  double mass = 0;              ///< [kg]
  double volume = 0;            ///< sum m / rho [m^3]
  Vec<Dim> momentum = {};       ///< [kg m/s]
  double kinetic = 0;           ///< energy [J]
  double internal = 0;          ///< energy [J]
  /// Means by volume; NaN where no particle is inside. Its share is not one: it is NaN.
  LocalGas<Dim> mean;
};

namespace detail {

template <int Dim>
struct GasSum {
  double weight = 0;
  double rho = 0;
  double p = 0;
  double e = 0;
  Vec<Dim> v = {};
  std::uint64_t seen = 0;
  double mass = 0;
  Vec<Dim> momentum = {};
  double kinetic = 0;
  double internal = 0;

  SPHMBS_INLINE void combine(const GasSum& o) {
    weight += o.weight;
    rho += o.rho;
    p += o.p;
    e += o.e;
    v += o.v;
    seen += o.seen;
    mass += o.mass;
    momentum += o.momentum;
    kinetic += o.kinetic;
    internal += o.internal;
  }

  LocalGas<Dim> mean() const {
    const double scale = seen > 0 ? 1 / weight : std::numeric_limits<double>::quiet_NaN();
    return {.rho = scale * rho,
            .p = scale * p,
            .e = scale * e,
            .v = scale * v,
            .share = weight,
            .seen = static_cast<std::uint32_t>(seen)};
  }
};

/// A particle's share in the sums.
template <int Dim, class T, class Eos>
struct WeighGas {
  particles::FieldsView<Dim, T> fields;
  Eos eos;

  SPHMBS_INLINE void add(GasSum<Dim>& sum, std::size_t i, double weight) const {
    const double rho = static_cast<double>(fields.rho[i]);
    const double e = static_cast<double>(fields.e[i]);
    sum.weight += weight;
    sum.rho += weight * rho;
    sum.p += weight * eos.pressure(rho, e);
    sum.e += weight * e;
    sum.v += weight * fields.velocity(i).template to<double>();
    ++sum.seen;
  }
  SPHMBS_INLINE double volume(std::size_t i) const {
    return static_cast<double>(fields.m[i]) / static_cast<double>(fields.rho[i]);
  }
};

}  // namespace detail

}  // namespace sphmbs::sph
