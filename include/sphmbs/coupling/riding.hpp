// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <sphmbs/boundary/motion.hpp>
#include <sphmbs/core/math.hpp>

namespace sphmbs::coupling {

/// Way of a virtual particle that rides on a body, s seconds from the start of a step:
/// r + v s + a s^2 / 2. What gas meets there has the velocity u + w s, and the surface has the
/// direction of n + m s, of any length, for its normal.
template <int Dim>
struct Course {
  Vec<Dim> r;  ///< place at the start of the step [m]
  Vec<Dim> v;  ///< velocity there [m/s]
  Vec<Dim> a;  ///< acceleration in the step [m/s^2]
  Vec<Dim> u;  ///< velocity that gas meets at the start of the step [m/s]
  Vec<Dim> w;  ///< rate of change of u [m/s^2]
  Vec<Dim> n;  ///< along the normal of the surface; zero where unknown [any unit]
  Vec<Dim> m;  ///< rate of change of n [the same per s]
};

/// Motion of virtual particles that ride on bodies. Sets that ride on none have a motion of their
/// own. Made by WettedSurface::motion(); the courses belong to the surface.
template <int Dim, class Rest = boundary::Fixed>
struct Riding {
  const Course<Dim>* courses = nullptr;  ///< of all riding particles
  const std::int64_t* place = nullptr;   ///< of the first particle of a set among the courses less
                                         ///< its id, or `aground` for sets that ride on nothing
  double start = 0;                      ///< of the courses [s]
  Rest rest = {};                        ///< motion of sets that ride on nothing

  static constexpr std::int64_t aground = INT64_MIN;  ///< place of sets that ride on nothing

  /// Place at time t1 of what is at r [m] at time t0 [s].
  template <class T>
  SPHMBS_INLINE Vec<Dim, T> position(boundary::Mark mark, const Vec<Dim, T>& r, double t0,
                                     double t1) const {
    if (!rides(mark)) return rest.position(mark, r, t0, t1);
    const Course<Dim>& c = course(mark);
    const double s = t1 - start;
    return (c.r + s * (c.v + (0.5 * s) * c.a)).template to<T>();
  }

  /// Velocity that gas meets at time t [s], in [m/s].
  template <class T>
  SPHMBS_INLINE Vec<Dim, T> velocity(boundary::Mark mark, const Vec<Dim, T>& r, double t) const {
    if (!rides(mark)) return rest.velocity(mark, r, t);
    const Course<Dim>& c = course(mark);
    return (c.u + (t - start) * c.w).template to<T>();
  }

  /// Ratio of lengths of the solid, time t1 to time t0: 1 for what rides [-].
  SPHMBS_INLINE double stretch(boundary::Mark mark, double t0, double t1) const {
    return rides(mark) ? 1 : boundary::stretch(rest, mark, t0, t1);
  }

  /// The normal at time t1 of a surface whose normal at time t0 is n.
  template <class T>
  SPHMBS_INLINE Vec<Dim, T> turned(boundary::Mark mark, const Vec<Dim, T>& n, double t0,
                                   double t1) const {
    if (!rides(mark)) return boundary::turned(rest, mark, n, t0, t1);
    const Course<Dim>& c = course(mark);
    const Vec<Dim> now = c.n + (t1 - start) * c.m;
    const double size = math::sqrt(norm2(now));
    return size > 0 ? ((1 / size) * now).template to<T>() : n;
  }

  /// Whether the particle rides on a body.
  SPHMBS_INLINE bool rides(boundary::Mark mark) const { return place[mark.set] != aground; }
  /// Number of a riding particle among the courses.
  SPHMBS_INLINE std::size_t number(boundary::Mark mark) const {
    return static_cast<std::size_t>(place[mark.set] + static_cast<std::int64_t>(mark.id));
  }

 private:
  SPHMBS_INLINE const Course<Dim>& course(boundary::Mark mark) const {
    return courses[number(mark)];
  }
};

static_assert(boundary::Motion<Riding<2>> && boundary::Motion<Riding<3>, Vec<3, double>>);

}  // namespace sphmbs::coupling
