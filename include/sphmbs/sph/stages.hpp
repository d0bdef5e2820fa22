// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include <sphmbs/boundary/motion.hpp>
#include <sphmbs/core/atomic.hpp>
#include <sphmbs/execution/field.hpp>
#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/record.hpp>
#include <sphmbs/particles/slopes.hpp>
#include <sphmbs/sph/scheme.hpp>

namespace sphmbs::sph {

/// State of a particle: what eqs. (27)-(29) step.
template <int Dim, class T>
struct Stepped {
  Vec<Dim> r;     ///< in full
  Vec<Dim, T> v;  ///< [m/s]
  T rho;          ///< [kg/m^3]
  T e;            ///< [J/kg]
  T h;            ///< [m]
};

/// y + scale k for gas; particles of openings alone move, see EvaluateOpening; for virtual
/// particles the prescribed motion to time + dt. Those that know their surface have its velocity;
/// those that carry no state keep their mass, so that their volume follows the solid's.
template <class Scheme, class T, class Motion>
struct Advance {
  static constexpr int Dim = Scheme::dim;  ///< dimension of space
  particles::FieldsView<Dim, T> fields;    ///< of all particles
  particles::RatesView<Dim, T> rates;      ///< of all particles
  Motion motion;                           ///< of the virtual particles
  T scale;                                 ///< [s]
  double time;                             ///< of the state y [s]
  double dt;                               ///< [s]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE Stepped<Dim, T> operator()(std::size_t i) const {
    Stepped<Dim, T> y{fields.place(i), fields.velocity(i), fields.rho[i], fields.e[i], fields.h[i]};
    const bool moves = !particles::is_virtual(fields.set[i]);
    if (scale != T(0)) {
      y.rho += scale * rates.rho[i];
      y.e += scale * rates.e[i];
      y.h += scale * rates.h[i];
      if (moves) {
        for (int k = 0; k < Dim; ++k) {
          y.r[k] += static_cast<double>(scale) * static_cast<double>(rates.r[k][i]);
          y.v[k] += scale * rates.v[k][i];
        }
      }
    }
    if (!moves) {
      y.r = motion.position(mark(i), y.r, time, time + dt);
      Vec<Dim, T> seen = y.r.template to<T>();  // the point whose velocity gas meets
      if constexpr (Scheme::Wall::surfaces) {
        const particles::Surface<Dim, T> s = surface(i);
        seen += s.depth * s.normal;
      }
      y.v = motion.velocity(mark(i), seen, time + dt);
      if constexpr (!Scheme::Wall::evolves) {
        y.h *= stretch(i);
        y.rho = y.rho / math::power<Dim>(stretch(i));
      }
    }
    return y;
  }

  /// The surface in front of a virtual particle at time + dt; surfaces are known.
  SPHMBS_INLINE particles::Surface<Dim, T> surface(std::size_t i) const {
    return {boundary::turned(motion, mark(i), fields.normal_at(i), time, time + dt),
            stretch(i) * fields.depth[i]};
  }

  /// By which the motion knows particle i.
  SPHMBS_INLINE boundary::Mark mark(std::size_t i) const { return {fields.set[i], fields.id[i]}; }

  /// Ratio of lengths of the solid that a virtual particle belongs to, time + dt to time.
  SPHMBS_INLINE T stretch(std::size_t i) const {
    return static_cast<T>(boundary::stretch(motion, mark(i), time, time + dt));
  }
};

/// What stands for no particle.
inline constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// What one update may do to a particle; an update that does more is not made.
struct Admission {
  double least = 0.02;  ///< share of density and of smoothing length that it leaves [-]
  double fastest = std::numeric_limits<double>::infinity();  ///< speed of gas [m/s]
};

/// Whether a number is neither infinite nor NaN.
template <class U>
SPHMBS_INLINE bool is_finite(U x) {
  return math::abs(x) <= std::numeric_limits<U>::max();
}

/// Whether a state with sound speed c is finite and physical: density, smoothing length and squared
/// sound speed are positive. Written so that a NaN, which compares false, is caught.
template <int Dim, class T>
SPHMBS_INLINE bool is_sound(const Stepped<Dim, T>& y, T c) {
  bool good =
      y.rho > T(0) && y.h > T(0) && c > T(0) && is_finite(c) && is_finite(y.rho) && is_finite(y.h);
  for (int k = 0; k < Dim; ++k) good = good && is_finite(y.r[k]) && is_finite(y.v[k]);
  return good;
}

/// Writes the records of a stage (predicted state, pressure and sound speed) and notes the lowest
/// id among particles whose state is not finite or not physical. Checked here, before such a state
/// spreads to the neighbours.
template <class Scheme, class T, class Motion>
struct WriteRecords {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  Advance<Scheme, T, Motion> advance;      ///< leads to the state of the stage
  Scheme scheme;                           ///< with the numbers of its policies
  /// Periodic axes, across which the nearest image counts.
  geometry::Periodicity<dim, double> space;
  T* records;     ///< of all particles, see `particles::Record`
  T* vicinities;  ///< of all particles, see `particles::Vicinity`; null where the scheme needs none
  std::uint32_t* culprit;  ///< lowest id of a particle whose state is none

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const Stepped<dim, T> y = advance(i);
    const T p = scheme.eos.pressure(y.rho, y.e);
    const T c = scheme.eos.sound_speed(y.rho, p);
    particles::Record<dim, T> record{
        .r = {},
        .v = y.v,
        .rho = y.rho,
        .p = p,
        .c = c,
        .h = y.h,
        .m = advance.fields.m[i],
        .shell = particles::is_virtual(advance.fields.set[i]) ? T(1) : T(0),
        .rest = {}};
    particles::set_place(record, space.wrap(y.r));
    particles::store_record<dim, T>(records, i, record);
    if constexpr (Scheme::Wall::surfaces)
      if (particles::is_virtual(advance.fields.set[i]))
        particles::store_surface<dim, T>(vicinities, i, advance.surface(i));
    if (!is_sound(y, c)) atomic::lower(culprit, advance.fields.id[i]);
  }
};

/// Looks at y + scale k before it replaces y, and notes the lowest id among particles that it would
/// make not physical or take too far.
template <class Scheme, class T, class Motion>
struct JudgeUpdate {
  Advance<Scheme, T, Motion> advance;  ///< leads to the new state
  Scheme scheme;                       ///< with the numbers of its policies
  T least;                 ///< share of density and of smoothing length that must be left [-]
  double fastest_squared;  ///< of the speed of gas [m^2/s^2]
  std::uint32_t* culprit;  ///< lowest id of a particle that may not do its update

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const auto& fields = advance.fields;
    const auto y = advance(i);
    const T c = scheme.eos.sound_speed(y.rho, scheme.eos.pressure(y.rho, y.e));
    const bool good =
        is_sound(y, c) && y.rho >= least * fields.rho[i] && y.h >= least * fields.h[i] &&
        (particles::is_virtual(fields.set[i]) || speed_squared(y.v) <= fastest_squared);
    if (!good) atomic::lower(culprit, fields.id[i]);
  }

 private:
  static SPHMBS_INLINE double speed_squared(const Vec<Scheme::dim, T>& v) {
    return norm2(v.template to<double>());
  }
};

/// Notes the lowest id among particles that others see with a number that is not finite.
template <int Dim, class T>
struct SickRecord {
  const T* records;         ///< of all particles, see `particles::Record`
  const std::uint32_t* id;  ///< of all particles
  std::uint32_t* culprit;   ///< lowest id of a particle with such a number

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const particles::Record<Dim, T> s = particles::load_record<Dim>(records, i);
    bool good =
        is_finite(s.rho) && is_finite(s.p) && is_finite(s.c) && is_finite(s.h) && is_finite(s.m);
    for (int k = 0; k < Dim; ++k) good = good && is_finite(s.r[k]) && is_finite(s.v[k]);
    if (!good) atomic::lower(culprit, id[i]);
  }
};

/// Lets `body` loop over n particles, with the memory for its culprit.
/// @return the culprit's id, or nobody
template <execution::ExecutionPolicy Policy, class Body>
std::uint32_t culprit_of(const Body& body, execution::Field<std::uint32_t, Policy>& culprit,
                         std::size_t n) {
  culprit.upload(std::array{nobody});
  Policy::for_each(n, body);
  return culprit.download()[0];
}

/// Writes y(t + dt) over y(t), the surfaces of virtual particles included, and wraps positions into
/// the periodic box.
template <class Scheme, class T, class Motion>
struct CommitStep {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  Advance<Scheme, T, Motion> advance;      ///< leads to the state of the stage
  /// Periodic axes, across which the nearest image counts.
  geometry::Periodicity<dim, double> space;

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const auto& fields = advance.fields;
    const Stepped<dim, T> y = advance(i);
    fields.set_place(i, space.wrap(y.r));
    fields.set_velocity(i, y.v);
    fields.rho[i] = y.rho;
    fields.e[i] = y.e;
    fields.h[i] = y.h;
    if (fields.depth == nullptr || !particles::is_virtual(fields.set[i])) return;
    const particles::Surface<dim, T> s = advance.surface(i);
    particles::FieldsView<dim, T>::put(fields.normal, i, s.normal);
    fields.depth[i] = s.depth;
    if (fields.patch != nullptr) fields.patch[i] *= advance.stretch(i);
  }
};

/// The longest of some ways [m].
struct Surplus {
  double length = 0;  ///< [m]
  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Surplus& o) { length = math::max(length, o.length); }
};

/// How far a virtual particle's prescribed way from time to time + dt departs from the way at the
/// velocity that gas meets at its beginning, the growth of its support included.
template <class Scheme, class T, class Motion>
struct MotionSurplus {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  Advance<Scheme, T, Motion> advance;      ///< leads to the state of the stage
  /// Periodic axes, across which the nearest image counts.
  geometry::Periodicity<dim, double> space;

  /// For particle i: the body of a loop.
  SPHMBS_INLINE Surplus operator()(std::size_t i) const {
    const auto& fields = advance.fields;
    if (!particles::is_virtual(fields.set[i])) return {};
    const Vec<dim> r = fields.place(i);
    const double dt = advance.dt;
    const boundary::Mark mark = advance.mark(i);
    const Vec<dim> end = advance.motion.position(mark, r, advance.time, advance.time + dt);
    Vec<dim, T> seen = r.template to<T>();
    if constexpr (Scheme::Wall::surfaces) seen += fields.depth[i] * fields.normal_at(i);
    const Vec<dim, T> v = advance.motion.velocity(mark, seen, advance.time);
    const double growth = static_cast<double>(advance.stretch(i)) - 1;
    const Vec<dim> way = space.nearest(space.wrap(end) - r);
    return {math::sqrt(norm2(way - dt * v.template to<double>())) +
            Scheme::Kernel::support * static_cast<double>(fields.h[i]) * math::max(growth, 0.0)};
  }
};

/// How much further two virtual particles may close in in the time of an `advance` than their
/// velocities at its beginning say [m].
template <execution::ExecutionPolicy Policy, class Scheme, class T, class Motion>
double motion_surplus(const Advance<Scheme, T, Motion>& advance,
                      const geometry::Periodicity<Scheme::dim, double>& space, std::size_t n) {
  if constexpr (std::is_same_v<Motion, boundary::Fixed>)
    return 0;
  else
    return 2 *
           execution::reduce<Policy>(n, Surplus{}, MotionSurplus<Scheme, T, Motion>{advance, space})
               .length;
}

}  // namespace sphmbs::sph
