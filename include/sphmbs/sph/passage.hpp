// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/core/archive.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/neighbours/neighbour_search.hpp>
#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/opening.hpp>

namespace sphmbs::sph {

/// What has passed the face of an opening one way since the beginning.
template <int Dim>
struct Passed {
  std::uint64_t particles = 0;  ///< how many
  double mass = 0;              ///< [kg]
  double volume = 0;            ///< sum m / rho [m^3]
  Vec<Dim> momentum = {};       ///< [kg m/s]
  double energy = 0;            ///< kinetic and internal [J]

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Passed& o) {
    particles += o.particles;
    mass += o.mass;
    volume += o.volume;
    momentum += o.momentum;
    energy += o.energy;
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("particles", particles);
    archive("mass", mass);
    archive("volume", volume);
    archive("momentum", momentum);
    archive("energy", energy);
  }
};

/// Into the gas and out of it.
template <int Dim>
struct Traffic {
  Passed<Dim> in;   ///< came in
  Passed<Dim> out;  ///< went out

  /// What came in less what went out, without their number.
  Passed<Dim> net() const {
    return {0, in.mass - out.mass, in.volume - out.volume, in.momentum - out.momentum,
            in.energy - out.energy};
  }

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Traffic& o) {
    in.combine(o.in);
    out.combine(o.out);
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("in", in);
    archive("out", out);
  }
};

namespace detail {

/// What becomes of a particle at an opening.
enum class Fate : std::uint8_t { stays, enters, leaves, is_followed, vanishes };

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
  const T here = T(0.5) * (leaving + coming);
  // Faster than sound nothing runs out against the stream, and no wave may leave a vacuum.
  if (o.along(o.v) > o.c || !(here > T(0.01) * o.p)) return {o.rho, o.e, o.v};
  GasState<Dim, T> state{o.density(here), T(0), o.v};
  state.e = static_cast<T>(eos.internal_energy(state.rho, here));
  state.v[o.axis] = o.side * (coming - leaving) / (T(2) * Z);
  return state;
}

/// Lets particles pass: an opening's that are beyond its face become gas, gas that is in a zone
/// becomes the opening's. What is beyond a zone's far end will vanish, and of two particles in a
/// zone that have come too near the later one. A particle of a zone that moves towards the gas and
/// has room behind it is followed. Particles that flow out of a zone sideways come back at its
/// other side as far gas.
template <int Dim, class T, class Eos>
struct Pass {
  Eos eos;
  geometry::Periodicity<Dim, T> space;
  neighbours::NeighbourView lists;
  particles::FieldsView<Dim, T> fields;  // as they were
  const particles::OpeningView<Dim, T>* openings;
  int count;
  Fate* fate;
  std::uint32_t* copies;   // none, itself, or itself and one that follows
  std::uint32_t* follows;  // 1 where one follows

  SPHMBS_INLINE void operator()(std::size_t i) const {
    const std::uint8_t set = fields.set[i];
    fate[i] = particles::is_virtual(set) ? Fate::stays
              : set == particles::gas    ? (zone_of(i) < count ? Fate::leaves : Fate::stays)
                                         : in_zone(i, openings[particles::opening_of(set)]);
    copies[i] = fate[i] == Fate::vanishes ? 0 : fate[i] == Fate::is_followed ? 2 : 1;
    follows[i] = fate[i] == Fate::is_followed ? 1 : 0;
  }

  /// The opening in whose zone a particle is, or `count`.
  SPHMBS_INLINE int zone_of(std::size_t i) const {
    const Vec<Dim, T> r = fields.position(i);
    for (int k = 0; k < count; ++k) {
      const T inside = openings[k].inside(r);
      bool in = inside < T(0) && inside >= -openings[k].length();
      for (int axis = 0; axis < Dim; ++axis) in = in && openings[k].beside(r, axis) == T(0);
      if (in) return k;
    }
    return count;
  }

 private:
  SPHMBS_INLINE Fate in_zone(std::size_t i, const particles::OpeningView<Dim, T>& o) const {
    const Vec<Dim, T> r = fields.position(i);
    for (int axis = 0; axis < Dim; ++axis)
      if (o.beside(r, axis) != T(0)) return Fate::stays;  // and comes back
    const T inside = o.inside(r);
    if (inside >= T(0)) return Fate::enters;
    if (inside < -o.length()) return Fate::vanishes;
    // Compressed along the stream alone: particles of a lattice keep their distance across it.
    const T spacing = o.spacing * o.rho / next_to(eos, fields, o, i).rho;
    bool room = o.along(fields.velocity(i)) > T(0) && inside - spacing >= -o.length();
    for (std::uint64_t k = lists.first[i]; k < lists.last[i]; ++k) {
      const std::size_t j = lists.list[k];
      if (fields.set[j] != fields.set[i]) continue;
      Vec<Dim, T> d = space.nearest(fields.position(j) - r);
      const bool later = fields.id[i] > fields.id[j];
      if (later && norm2(d) < T(0.16) * spacing * spacing) return Fate::vanishes;
      // Two side by side do not both fill the place behind them.
      const bool beside = later && norm2(d) < T(0.49) * spacing * spacing;
      d[o.axis] += o.side * spacing;
      room = room && !beside && norm2(d) >= T(0.49) * spacing * spacing;
    }
    return room ? Fate::is_followed : Fate::stays;
  }
};

/// What passes one opening.
template <int Dim, class T, class Eos>
struct CountPassage {
  Pass<Dim, T, Eos> pass;
  int opening;

  SPHMBS_INLINE Traffic<Dim> operator()(std::size_t i) const {
    Traffic<Dim> t;
    const auto& fields = pass.fields;
    const bool enters =
        pass.fate[i] == Fate::enters && particles::opening_of(fields.set[i]) == opening;
    const bool leaves = pass.fate[i] == Fate::leaves && pass.zone_of(i) == opening;
    if (!enters && !leaves) return t;
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

/// Makes of copies what they are to be: gas of those that entered, an opening's of those that left,
/// and of second copies particles that follow.
template <int Dim, class T, class Eos>
struct Become {
  Pass<Dim, T, Eos> pass;  // with the fields of the copies
  const std::uint32_t* order;
  const std::uint32_t* first;
  const std::uint32_t* rank;  // of the particle that is followed among all that are
  std::uint32_t next_id;

  SPHMBS_INLINE void operator()(std::size_t j) const {
    const std::uint32_t i = order[j];
    const auto& fields = pass.fields;
    if (pass.fate[i] == Fate::enters) fields.set[j] = particles::gas;
    if (pass.fate[i] == Fate::leaves) fields.set[j] = particles::opening_set(pass.zone_of(j));
    if (!particles::is_opening(fields.set[j])) return;
    const auto& o = pass.openings[particles::opening_of(fields.set[j])];
    Vec<Dim> r = fields.place(j);
    const bool follows = pass.fate[i] == Fate::is_followed && j != first[i];
    bool renewed = follows;
    for (int k = 0; k < Dim; ++k) {
      const T beside = o.beside(r.template to<T>(), k);
      renewed = renewed || beside != T(0);
      if (beside != T(0)) r[k] += (beside < T(0) ? T(1) : T(-1)) * (o.upper[k] - o.lower[k]);
    }
    if (!renewed) return;
    const GasState<Dim, T> state = next_to(pass.eos, fields, o, j);
    const T ratio = o.rho / state.rho;  // of volumes
    if (follows) {
      r[o.axis] -= o.side * o.spacing * ratio;
      fields.id[j] = next_id + rank[i];
    }
    fields.set_place(j, r);
    fields.set_velocity(j, state.v);
    fields.rho[j] = state.rho;
    fields.e[j] = state.e;
    fields.m[j] = o.m;
    fields.h[j] = o.h * (T(1) + (ratio - T(1)) / T(Dim));
  }
};

}  // namespace detail
}  // namespace sphmbs::sph
