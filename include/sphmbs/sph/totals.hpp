// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/math.hpp>
#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/particles/particles.hpp>

namespace sphmbs::sph {

/// Sums over all particles; planar gas per metre of depth.
template <int Dim>
struct Totals {
  double mass = 0;              ///< of the gas [kg]
  double volume = 0;            ///< of the gas, sum m / rho [m^3]
  Vec<Dim> momentum = {};       ///< of the gas [kg m/s]
  double kinetic = 0;           ///< energy of the gas [J]
  double internal = 0;          ///< energy of the gas [J]
  double virtual_internal = 0;  ///< energy of the virtual particles [J]
  std::uint64_t particles = 0;  ///< of gas

  /// Kinetic and internal energy of the gas [J].
  double energy() const { return kinetic + internal; }

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Totals& o) {
    mass += o.mass;
    volume += o.volume;
    momentum += o.momentum;
    kinetic += o.kinetic;
    internal += o.internal;
    virtual_internal += o.virtual_internal;
    particles += o.particles;
  }
};

/// What a particle adds to the totals.
template <int Dim, class T>
struct TotalsOfParticle {
  particles::FieldsView<Dim, T> fields;  ///< of all particles

  /// For particle i: the body of a loop.
  SPHMBS_INLINE Totals<Dim> operator()(std::size_t i) const {
    const double m = static_cast<double>(fields.m[i]);
    const double e = static_cast<double>(fields.e[i]);
    if (particles::is_opening(fields.set[i])) return {};
    if (particles::is_virtual(fields.set[i])) return {.virtual_internal = m * e};
    const Vec<Dim> v = fields.velocity(i).template to<double>();
    return {.mass = m,
            .volume = m / static_cast<double>(fields.rho[i]),
            .momentum = m * v,
            .kinetic = 0.5 * m * norm2(v),
            .internal = m * e,
            .particles = 1};
  }
};

/// The largest smoothing length, and the particle that has it.
struct Largest {
  double h = 0;          ///< [m]
  std::uint32_t id = 0;  ///< of the particle
  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Largest& o) {
    const bool larger = o.h > h;
    h = larger ? o.h : h;
    id = larger ? o.id : id;
  }
};

/// Smoothing length of a particle, for the largest.
template <class T>
struct SmoothingLength {
  const T* h;               ///< smoothing lengths [m]
  const std::uint32_t* id;  ///< ids of all particles
  /// For particle i: the body of a loop.
  SPHMBS_INLINE Largest operator()(std::size_t i) const {
    return {static_cast<double>(h[i]), id[i]};
  }
};

/// The particle with the largest smoothing length.
template <class Policy, int Dim, class T>
Largest widest_particle(particles::Particles<Dim, T, Policy>& particles) {
  const auto fields = particles.fields();
  return execution::reduce<Policy>(particles.size(), Largest{},
                                   SmoothingLength<T>{fields.h, fields.id});
}

/// Force of the gas on one set of virtual particles: m times the acceleration that eq. (21) gives
/// them from gas neighbours alone. For planar gas per metre of depth.
template <int Dim>
struct Force {
  Vec<Dim> f = {};  ///< [N]
  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Force& o) { f += o.f; }
};

/// Force of the gas on a particle of a set.
template <int Dim, class T>
struct ForceOnParticle {
  particles::FieldsView<Dim, T> fields;  ///< of all particles
  particles::RatesView<Dim, T> rates;    ///< of all particles
  std::uint8_t set;                      ///< whose particles count

  /// For particle i: the body of a loop.
  SPHMBS_INLINE Force<Dim> operator()(std::size_t i) const {
    Force<Dim> force;
    if (fields.set[i] == set)
      for (int k = 0; k < Dim; ++k)
        force.f[k] = static_cast<double>(fields.m[i]) * static_cast<double>(rates.v[k][i]);
    return force;
  }
};

}  // namespace sphmbs::sph
