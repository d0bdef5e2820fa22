// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/sph/rates.hpp>
#include <sphmbs/sph/stages.hpp>

namespace sphmbs::sph {

/// Moves the records of particles that ride on bodies to where their motion has them by now.
template <class Scheme, class T, class Motion>
struct FollowMotion {
  static constexpr int dim = Scheme::dim;
  Advance<Scheme, T, Motion> advance;
  geometry::Periodicity<dim, double> space;
  T* records;
  T* vicinities;

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

  static SPHMBS_INLINE bool rides(const Advance<Scheme, T, Motion>& advance, std::size_t i) {
    return particles::is_virtual(advance.fields.set[i]) &&
           boundary::rides(advance.motion, advance.mark(i));
  }
};

/// Rates, and so forces, of particles that ride on bodies alone.
template <class Scheme, class T, class Motion, class Evaluate>
struct EvaluateRiding {
  Advance<Scheme, T, Motion> advance;
  Evaluate evaluate;

  SPHMBS_INLINE void operator()(std::size_t i) const {
    if (FollowMotion<Scheme, T, Motion>::rides(advance, i)) evaluate(i);
  }
};

}  // namespace sphmbs::sph
