// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/neighbours/neighbour_search.hpp>
#include <sphmbs/particles/record.hpp>
#include <sphmbs/particles/slopes.hpp>

namespace sphmbs::sph {

/// What a gathering loop reads.
template <class T>
struct Gathered {
  neighbours::NeighbourView neighbours;  ///< their lists
  const T* records;                      ///< of all particles, see `particles::Record`
  const T* vicinities;                   ///< null where the scheme needs none
};

/// Calls term(record, vicinity, sum) for all neighbours of particle i, `lanes` at once, in the
/// order of the list. Returns how many times the particle itself was taken to fill up the last
/// pack.
/// @tparam vicinity  whether slopes and surfaces are loaded
template <int dim, int lanes, bool vicinity, class T, class Term, class Sum>
SPHMBS_INLINE T gather(const Gathered<T>& from, std::size_t i, const Term& term, Sum& sum) {
  using N = Number<T, lanes>;
  const auto add = [&](const std::uint32_t* index) SPHMBS_INLINE_LAMBDA {
    const auto record = particles::load_records<dim, lanes>(from.records, index);
    if constexpr (vicinity)
      term(record, particles::load_vicinities<dim, lanes>(from.vicinities, index), sum);
    else
      term(record, particles::Vicinity<dim, N>{}, sum);
  };
  const std::uint32_t* b = from.neighbours.list + from.neighbours.first[i];
  const std::uint32_t* const end = from.neighbours.list + from.neighbours.last[i];
  for (; end - b >= lanes; b += lanes) add(b);
  if (b == end) return T(0);
  std::uint32_t rest[lanes];
#pragma GCC unroll 16
  for (int l = 0; l < lanes; ++l) rest[l] = l < end - b ? b[l] : static_cast<std::uint32_t>(i);
  add(rest);
  return static_cast<T>(lanes - (end - b));
}

}  // namespace sphmbs::sph
