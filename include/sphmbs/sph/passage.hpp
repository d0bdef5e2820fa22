// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/opening.hpp>

namespace sphmbs::sph {

/// What has passed the face of an opening one way since the beginning.
template <int Dim>
struct Passed {
  std::uint64_t particles = 0;
  double mass = 0;         // [kg]
  double volume = 0;       // sum m / rho [m^3]
  Vec<Dim> momentum = {};  // [kg m/s]
  double energy = 0;       // kinetic and internal [J]

  SPHMBS_INLINE void combine(const Passed& o) {
    particles += o.particles;
    mass += o.mass;
    volume += o.volume;
    momentum += o.momentum;
    energy += o.energy;
  }
};

/// Into the gas and out of it.
template <int Dim>
struct Traffic {
  Passed<Dim> in;
  Passed<Dim> out;

  /// What came in less what went out; `particles` counts both.
  Passed<Dim> net() const {
    return {in.particles + out.particles, in.mass - out.mass, in.volume - out.volume,
            in.momentum - out.momentum, in.energy - out.energy};
  }

  SPHMBS_INLINE void combine(const Traffic& o) {
    in.combine(o.in);
    out.combine(o.out);
  }
};

namespace detail {

/// What becomes of a particle at an opening.
enum class Fate : std::uint8_t { stays, enters, leaves, is_followed, vanishes };

template <int Dim, class T>
struct OpeningsView {
  const particles::OpeningView<Dim, T>* opening;
  int count;
};

template <int Dim, class T>
struct GasState {
  T rho;
  T e;
  Vec<Dim, T> v;
};

/// The far gas with the wave that runs out of the gas (see EvaluateOpening) as a particle has it:
/// what comes next to that particle.
template <int Dim, class T, class Eos>
SPHMBS_INLINE GasState<Dim, T> next_to(const Eos& eos, const particles::FieldsView<Dim, T>& fields,
                                       const particles::OpeningView<Dim, T>& o, std::size_t i) {
  const T p = static_cast<T>(eos.pressure(fields.rho[i], fields.e[i]));
  const T Z = fields.rho[i] * static_cast<T>(eos.sound_speed(fields.rho[i], p));
  const T leaving = p - Z * o.along(fields.velocity(i));
  const T coming = o.p + Z * o.along(o.v);
  const T c = static_cast<T>(eos.sound_speed(o.rho, o.p));
  // Along an isentrope, of which this form keeps the slope and never turns negative.
  const T denser = (T(0.5) * (leaving + coming) - o.p) / (o.rho * c * c);
  GasState<Dim, T> state{denser > T(0) ? o.rho * (T(1) + denser) : o.rho / (T(1) - denser), T(0),
                         o.v};
  state.e = o.e + o.p / o.rho * (T(1) - o.rho / state.rho);
  state.v[o.axis] = o.side * (coming - leaving) / (T(2) * Z);
  return state;
}

template <int Dim, class T>
SPHMBS_INLINE void set_state(const particles::FieldsView<Dim, T>& fields, std::size_t i,
                             const GasState<Dim, T>& state) {
  fields.rho[i] = state.rho;
  fields.e[i] = state.e;
  fields.set_velocity(i, state.v);
}

/// Lets particles pass: an opening's that are beyond its face become gas, gas that is in a zone
/// becomes the opening's, and what is beyond the far end will vanish. Those at the far end that
/// have moved a spacing away from it are followed by others. Particles that flow out of a zone
/// sideways come back at its other side.
template <int Dim, class T, class Eos>
struct Pass {
  Eos eos;
  particles::FieldsView<Dim, T> fields;
  OpeningsView<Dim, T> openings;
  Fate* fate;
  std::uint32_t* copies;   // none, itself, or itself and one that follows
  std::uint32_t* follows;  // 1 where one follows

  SPHMBS_INLINE void operator()(std::size_t i) const {
    const std::uint8_t set = fields.set[i];
    fate[i] = particles::is_virtual(set) ? Fate::stays
              : set == particles::gas    ? of_gas(i)
                                         : in_zone(i, particles::opening_of(set));
    copies[i] = fate[i] == Fate::vanishes ? 0 : fate[i] == Fate::is_followed ? 2 : 1;
    follows[i] = fate[i] == Fate::is_followed ? 1 : 0;
  }

 private:
  SPHMBS_INLINE Fate of_gas(std::size_t i) const {
    const Vec<Dim, T> r = fields.position(i);
    for (int k = 0; k < openings.count; ++k) {
      const auto& o = openings.opening[k];
      const T inside = o.inside(r);
      bool faces = inside < T(0) && inside >= -o.length();
      for (int axis = 0; axis < Dim; ++axis) faces = faces && o.beside(r, axis) == T(0);
      if (!faces) continue;
      fields.set[i] = particles::opening_set(k, false);
      return Fate::leaves;
    }
    return Fate::stays;
  }

  SPHMBS_INLINE Fate in_zone(std::size_t i, int k) const {
    const auto& o = openings.opening[k];
    Vec<Dim, T> r = fields.position(i);
    const T inside = o.inside(r);
    if (inside >= T(0)) return Fate::enters;
    if (inside < -o.length()) return Fate::vanishes;
    for (int axis = 0; axis < Dim; ++axis) {
      const T beside = o.beside(r, axis);
      if (beside == T(0)) continue;
      r[axis] += (beside < T(0) ? T(1) : T(-1)) * (o.upper[axis] - o.lower[axis]);
      fields.set_position(i, r);
      set_state(fields, i, next_to(eos, fields, o, i));
    }
    const bool was_last = particles::is_last(fields.set[i]);
    const T spacing = o.spacing * o.rho / next_to(eos, fields, o, i).rho;
    const bool last = inside < spacing - o.length();
    fields.set[i] = particles::opening_set(k, last);
    return was_last && !last ? Fate::is_followed : Fate::stays;
  }
};

/// What passes one opening. Those that enter have its set until they are copied.
template <int Dim, class T>
struct CountPassage {
  particles::FieldsView<Dim, T> fields;
  const Fate* fate;
  int opening;

  SPHMBS_INLINE Traffic<Dim> operator()(std::size_t i) const {
    Traffic<Dim> t;
    const bool enters = fate[i] == Fate::enters;
    if (!enters && fate[i] != Fate::leaves) return t;
    if (particles::opening_of(fields.set[i]) != opening) return t;
    const double m = static_cast<double>(fields.m[i]);
    const Vec<Dim> v = fields.velocity(i).template to<double>();
    (enters ? t.in : t.out) = Passed<Dim>{1, m, m / static_cast<double>(fields.rho[i]), m * v,
                                          m * (0.5 * norm2(v) + static_cast<double>(fields.e[i]))};
    return t;
  }
};

/// The order in which particles are copied.
struct Copy {
  const std::uint32_t* copies;
  const std::uint32_t* first;
  std::uint32_t* order;

  SPHMBS_INLINE void operator()(std::size_t i) const {
    for (std::uint32_t k = 0; k < copies[i]; ++k)
      order[first[i] + k] = static_cast<std::uint32_t>(i);
  }
};

/// Makes gas of the particles that entered, and of second copies those that follow.
template <int Dim, class T, class Eos>
struct Follow {
  Eos eos;
  particles::FieldsView<Dim, T> fields;  // of the copies
  OpeningsView<Dim, T> openings;
  const std::uint32_t* order;
  const Fate* fate;
  const std::uint32_t* rank;  // of the particle that is followed among all that are
  const std::uint32_t* first;
  std::uint32_t next_id;

  SPHMBS_INLINE void operator()(std::size_t j) const {
    const std::uint32_t i = order[j];
    if (fate[i] == Fate::enters) fields.set[j] = particles::gas;
    if (fate[i] != Fate::is_followed || j == first[i]) return;
    const int k = particles::opening_of(fields.set[j]);
    const auto& o = openings.opening[k];
    const GasState<Dim, T> state = next_to(eos, fields, o, j);
    Vec<Dim, T> r = fields.position(j);
    r[o.axis] -= o.side * o.spacing * o.rho / state.rho;
    fields.set_position(j, r);
    set_state(fields, j, state);
    fields.set[j] = particles::opening_set(k, true);
    fields.id[j] = next_id + rank[i];
  }
};

}  // namespace detail
}  // namespace sphmbs::sph
