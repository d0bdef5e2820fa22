// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/particles.hpp>

/// Who sees whom.
namespace sphmbs::neighbours {

/// Lists of neighbours that loop bodies see: those of particle a are list[first[a]] ...
/// list[last[a] - 1], without a itself.
struct NeighbourView {
  const std::uint64_t* first;  ///< where the list of each particle begins
  const std::uint64_t* last;   ///< one past its end
  const std::uint32_t* list;   ///< neighbours of all particles
};

/// How far particles see: a pair is listed while its distance is below
/// support (h_a + h_b) / 2 + skin, eq. (24).
struct Reach {
  double support;  ///< of the kernel, in smoothing lengths [-]
  double skin;     ///< margin that lets particles move before the lists must be made anew [m]
  double h_max;    ///< largest smoothing length [m]

  /// Distance within which the lists are complete for all particles [m].
  double largest() const { return support * h_max + skin; }
};

/// What a search offers: `rebuild` may put the particles into another order, and then lists all
/// pairs within reach, nearest images along periodic axes included.
template <class S, int Dim, class T, class Policy>
concept NeighbourSearch = requires(S search, particles::Particles<Dim, T, Policy>& particles,
                                   const geometry::Domain<Dim>& domain, const Reach& reach) {
  search.rebuild(particles, domain, reach);
  { search.view() } -> std::same_as<NeighbourView>;
  { search.bytes() } -> std::same_as<std::size_t>;
};

/// Nearest images are unique while a period is at least two supports long; the skin does not count,
/// since it only lists pairs early.
/// @throws InvalidInput where a periodic axis is shorter.
template <int Dim>
void check_reach(const geometry::Domain<Dim>& domain, const Reach& reach) {
  const double shortest = 2 * reach.support * reach.h_max;
  for (int k = 0; k < Dim; ++k)
    expects(!domain.periodic[static_cast<std::size_t>(k)] || domain.box.length(k) >= shortest,
            "periodic length", domain.box.length(k),
            "at least two support radii, " + std::to_string(shortest) +
                " m: lower the spacing or lengthen the domain");
}

}  // namespace sphmbs::neighbours
