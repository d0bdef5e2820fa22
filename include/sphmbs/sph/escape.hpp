// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/execution/scan.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/particles.hpp>
#include <sphmbs/sph/passage.hpp>

namespace sphmbs::sph {

/// Gas outside the box along axes that are not periodic.
template <int Dim>
struct Outside {
  Passed<Dim> passed;  ///< number, mass, volume, momentum and energy of it
  std::uint32_t id = std::numeric_limits<std::uint32_t>::max();  ///< the lowest
  double lengths = 0;  ///< how far the farthest is, in lengths of the box along that axis [-]
  std::uint32_t farthest = 0;  ///< its id

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Outside& o) {
    passed.combine(o.passed);
    id = o.id < id ? o.id : id;
    const bool farther = o.lengths > lengths || (o.lengths == lengths && o.farthest < farthest);
    farthest = farther ? o.farthest : farthest;
    lengths = farther ? o.lengths : lengths;
  }
};

/// Tells of a particle whether it is gas outside the box.
template <int Dim, class T>
struct LookOutside {
  particles::FieldsView<Dim, T> fields;  ///< of all particles
  Vec<Dim> middle;                       ///< of the box [m]
  Vec<Dim> inverse;                      ///< of its length, 0 along periodic axes [1/m]

  /// Of these particles, by the box and the periodic axes of a domain.
  LookOutside(const particles::FieldsView<Dim, T>& f, const geometry::Domain<Dim>& domain)
      : fields(f) {
    for (int k = 0; k < Dim; ++k) {
      const bool wraps = domain.periodic[static_cast<std::size_t>(k)];
      middle[k] = 0.5 * (domain.box.lower[k] + domain.box.upper[k]);
      inverse[k] = wraps ? 0 : 1 / domain.box.length(k);
    }
  }

  /// How far a particle of gas is outside, in lengths of the box; 0 for all others [-].
  SPHMBS_INLINE double lengths(std::size_t i) const {
    double most = 0;
    if (fields.set[i] != particles::gas) return most;
    for (int k = 0; k < Dim; ++k)
      most = math::max(
          most, math::abs(static_cast<double>(fields.r[k][i]) - middle[k]) * inverse[k] - 0.5);
    return most;
  }

  /// For particle i: the body of a loop.
  SPHMBS_INLINE Outside<Dim> operator()(std::size_t i) const {
    Outside<Dim> found;
    found.lengths = lengths(i);
    found.farthest = fields.id[i];
    if (!(found.lengths > 0)) return found;
    const double m = static_cast<double>(fields.m[i]);
    const Vec<Dim> v = fields.velocity(i).template to<double>();
    found.id = fields.id[i];
    found.passed = {1, m, m / static_cast<double>(fields.rho[i]), m * v,
                    m * (0.5 * norm2(v) + static_cast<double>(fields.e[i]))};
    return found;
  }
};

namespace detail {

template <int Dim, class T>
struct KeepInside {
  LookOutside<Dim, T> look;
  std::uint32_t* copies;
  SPHMBS_INLINE void operator()(std::size_t i) const { copies[i] = look.lengths(i) > 0 ? 0 : 1; }
};

}  // namespace detail

/// Looks for gas outside the box.
template <execution::ExecutionPolicy Policy, int Dim, class T>
Outside<Dim> outside(particles::Particles<Dim, T, Policy>& particles,
                     const geometry::Domain<Dim>& domain) {
  return execution::reduce<Policy>(particles.size(), Outside<Dim>{},
                                   LookOutside<Dim, T>{particles.fields(), domain});
}

/// Removes gas outside the box.
template <execution::ExecutionPolicy Policy, int Dim, class T>
void remove_outside(particles::Particles<Dim, T, Policy>& particles,
                    const geometry::Domain<Dim>& domain) {
  const std::size_t n = particles.size();
  execution::Field<std::uint32_t, Policy> copies(n), first(n + 1);
  Policy::for_each(n, detail::KeepInside<Dim, T>{{particles.fields(), domain}, copies.data()});
  const std::size_t left = execution::exclusive_scan<Policy>(n, copies.data(), first.data());
  execution::Field<std::uint32_t, Policy> order(left);
  Policy::for_each(n, detail::Copy{copies.data(), first.data(), order.data()});
  particles.select(order.data(), left);
}

}  // namespace sphmbs::sph
