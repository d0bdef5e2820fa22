// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/sph/rates.hpp>
#include <sphmbs/sph/stages.hpp>

namespace sphmbs::sph {

/// Moves the records of particles that ride on bodies to where their motion has them by now.
template <class Scheme, class T, class Motion>
struct FollowMotion {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  Advance<Scheme, T, Motion> advance;      ///< leads to the state of the stage
  /// Periodic axes, across which the nearest image counts.
  geometry::Periodicity<dim, double> space;
  T* records;     ///< of all particles, see `particles::Record`
  T* vicinities;  ///< of all particles, see `particles::Vicinity`; null where the scheme needs none

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    if (!rides(advance, i)) return;
    const Stepped<dim, T> y = advance(i);
    auto record = particles::load_record<dim>(records, i);
    particles::set_place(record, space.wrap(y.r));
    record.v = y.v;
    particles::store_record<dim, T>(records, i, record);
    if constexpr (Scheme::Wall::surfaces)
      particles::store_surface<dim, T>(vicinities, i, advance.surface(i));
  }

  /// Whether particle i rides on a body.
  static SPHMBS_INLINE bool rides(const Advance<Scheme, T, Motion>& advance, std::size_t i) {
    return particles::is_virtual(advance.fields.set[i]) &&
           boundary::rides(advance.motion, advance.mark(i));
  }
};

/// Rates, and so forces, of particles that ride on bodies alone.
template <class Scheme, class T, class Motion, class Evaluate>
struct EvaluateRiding {
  Advance<Scheme, T, Motion> advance;  ///< leads to the state of the stage
  Evaluate evaluate;                   ///< the loop body for all particles

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    if (FollowMotion<Scheme, T, Motion>::rides(advance, i)) evaluate(i);
  }
};

}  // namespace sphmbs::sph
