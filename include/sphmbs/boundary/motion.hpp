// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include <sphmbs/core/vec.hpp>

namespace sphmbs::boundary {

/// Which virtual particle moves.
struct Mark {
  int set;           ///< number of its set
  std::uint32_t id;  ///< place in the initial cloud
};

/// Prescribed motion of virtual particles. `position` carries a particle from time t0 to t1 and
/// `velocity` is the rate of a point of its solid. Times are double in any fields [s]. A motion
/// that stretches or turns solids also has `stretch(mark, t0, t1)`, the ratio of lengths [-], and
/// `turned(mark, n, t0, t1)` for directions; one that follows from forces has
/// `rides(mark)`, true for the particles that do.
template <class M, class V = Vec<2, double>>
concept Motion = std::is_trivially_copyable_v<M> &&
    requires(const M motion, Mark mark, V r, double t) {
  { motion.position(mark, r, t, t) } -> std::same_as<V>;
  { motion.velocity(mark, r, t) } -> std::same_as<V>;
};

/// All virtual particles stay where they are.
struct Fixed {
  /// Place at time t1 of what is at r [m] at time t0 [s].
  template <int Dim, class T>
  SPHMBS_INLINE Vec<Dim, T> position(Mark, const Vec<Dim, T>& r, double, double) const {
    return r;
  }
  /// Velocity at place r [m] and time t [s], in [m/s].
  template <int Dim, class T>
  SPHMBS_INLINE Vec<Dim, T> velocity(Mark, const Vec<Dim, T>&, double) const {
    return Vec<Dim, T>::all(T(0));
  }
};

/// Uniform contraction towards the origin at a constant speed of the walls: r = l(t) / l(0) r(0),
/// l(t) = length - 2 speed t, for every set. The sealed cavity of sect. 5.2.
struct Contraction {
  double length;  ///< between two opposite walls at time 0 [m]
  double speed;   ///< of each wall, inwards [m/s]

  /// Place at time t1 of what is at r [m] at time t0 [s].
  template <int Dim, class T>
  SPHMBS_INLINE Vec<Dim, T> position(Mark, const Vec<Dim, T>& r, double t0, double t1) const {
    return static_cast<T>(length_at(t1) / length_at(t0)) * r;
  }
  /// Velocity at place r [m] and time t [s], in [m/s].
  template <int Dim, class T>
  SPHMBS_INLINE Vec<Dim, T> velocity(Mark, const Vec<Dim, T>& r, double t) const {
    return static_cast<T>(-2 * speed / length_at(t)) * r;
  }

  /// Ratio of lengths of the solid, time t1 to time t0 [-].
  SPHMBS_INLINE double stretch(Mark, double t0, double t1) const {
    return length_at(t1) / length_at(t0);
  }

  /// l(t) [m].
  SPHMBS_INLINE double length_at(double t) const { return length - 2 * speed * t; }
};

static_assert(Motion<Fixed> && Motion<Contraction>);

/// Ratio of lengths of a particle's solid between two times; 1 where the motion does not say [-].
template <class M>
SPHMBS_INLINE double stretch([[maybe_unused]] const M& motion, [[maybe_unused]] Mark mark,
                             [[maybe_unused]] double t0, [[maybe_unused]] double t1) {
  if constexpr (requires { motion.stretch(mark, t0, t1); })
    return motion.stretch(mark, t0, t1);
  else
    return 1;
}

/// Whether a particle's way follows from the forces on it: what a motion with `rides(mark)` says.
template <class M>
SPHMBS_INLINE bool rides([[maybe_unused]] const M& motion, [[maybe_unused]] Mark mark) {
  if constexpr (requires { motion.rides(mark); })
    return motion.rides(mark);
  else
    return false;
}

/// A direction of a particle's solid, carried from one time to another.
template <class M, int Dim, class T>
SPHMBS_INLINE Vec<Dim, T> turned([[maybe_unused]] const M& motion, [[maybe_unused]] Mark mark,
                                 const Vec<Dim, T>& n, [[maybe_unused]] double t0,
                                 [[maybe_unused]] double t1) {
  if constexpr (requires { motion.turned(mark, n, t0, t1); })
    return motion.turned(mark, n, t0, t1);
  else
    return n;
}

}  // namespace sphmbs::boundary
