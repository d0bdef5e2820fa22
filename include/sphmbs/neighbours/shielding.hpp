// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/execution/field.hpp>
#include <sphmbs/execution/scan.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/particles.hpp>

namespace sphmbs::neighbours {

namespace detail {

/// Particles and, of each, the patches in its list.
template <int Dim, class T>
struct ListedSheets {
  particles::FieldsView<Dim, T> fields;
  geometry::Periodicity<Dim, T> space;
  const std::uint64_t* first;
  const std::uint32_t* patches;

  SPHMBS_INLINE Vec<Dim, T> way(std::size_t a, std::size_t b) const {
    return space.nearest(fields.position(b) - fields.position(a));
  }

  /// Whether the sheet's layer s is seen from the place of particle a.
  SPHMBS_INLINE bool in_front(std::size_t s, std::size_t a) const {
    return dot(way(s, a), fields.normal_at(s)) > fields.depth[s];
  }

  /// Whether the straight way from a to b meets the patch s: a disc that covers a square patch, and
  /// a little more, since patches of a curved body stand apart on its outer side.
  SPHMBS_INLINE bool blocks(std::size_t s, std::size_t a, std::size_t b) const {
    const Vec<Dim, T> n = fields.normal_at(s);
    const Vec<Dim, T> from = way(s, a);
    const Vec<Dim, T> d = way(a, b);
    const T start = dot(from, n);
    const T end = start + dot(d, n);
    if (!(start * end < T(0))) return false;
    const Vec<Dim, T> crossing = from + (start / (start - end)) * d;
    const T width = fields.patch[s];
    return Dim == 1 || norm2(crossing) <= T(0.28 * (Dim - 1)) * width * width;
  }

  /// Whether a patch in the list of `owner` lies between a and b.
  SPHMBS_INLINE bool hidden(std::size_t owner, std::size_t a, std::size_t b) const {
    for (std::uint64_t k = first[owner]; k < first[owner + 1]; ++k)
      if (blocks(patches[k], a, b)) return true;
    return false;
  }
};

/// Counts the patches in each particle's list or, where there is room for them, copies them.
struct PickPatches {
  const std::uint8_t* sheet;
  const std::uint64_t* first;
  const std::uint32_t* list;
  std::uint32_t* count;
  const std::uint64_t* room = nullptr;
  std::uint32_t* patches = nullptr;

  SPHMBS_INLINE void operator()(std::size_t a) const {
    std::uint32_t found = 0;
    for (std::uint64_t k = first[a]; k < first[a + 1]; ++k) {
      if (sheet[list[k]] != particles::sheet_patch) continue;
      if (patches != nullptr) patches[room[a] + found] = list[k];
      ++found;
    }
    count[a] = found;
  }
};

/// Judges every entry of a particle's list, the same from both ends of a pair.
template <int Dim, class T>
struct JudgePairs {
  ListedSheets<Dim, T> listed;
  const std::uint64_t* first;
  const std::uint32_t* list;
  std::uint8_t* keep;

  SPHMBS_INLINE void operator()(std::size_t a) const {
    for (std::uint64_t k = first[a]; k < first[a + 1]; ++k) keep[k] = seen(a, list[k]) ? 1 : 0;
  }

 private:
  SPHMBS_INLINE bool seen(std::size_t a, std::size_t b) const {
    const auto& fields = listed.fields;
    const bool gas_a = !particles::is_virtual(fields.set[a]);
    const bool gas_b = !particles::is_virtual(fields.set[b]);
    if (gas_a && fields.sheet[b] != particles::no_sheet) return sees_layer(a, b);
    if (gas_b && fields.sheet[a] != particles::no_sheet) return sees_layer(b, a);
    if (!gas_a && !gas_b && fields.set[a] != fields.set[b])
      return fields.sheet[a] == particles::no_sheet && fields.sheet[b] == particles::no_sheet;
    if (!gas_a || !gas_b) return true;
    // From the particle that was first, so that rounding decides alike for both.
    const bool in_order = fields.id[a] < fields.id[b];
    return in_order ? !parted(a, b) : !parted(b, a);
  }

  /// Whether a patch lies between the two.
  SPHMBS_INLINE bool parted(std::size_t a, std::size_t b) const {
    return listed.hidden(a, a, b) || listed.hidden(b, a, b);
  }

  // Layers behind a sheet take the place of the gas that it hides: past its rim, gas is seen.
  SPHMBS_INLINE bool sees_layer(std::size_t gas, std::size_t layer) const {
    return listed.in_front(layer, gas) &&
           (!(listed.fields.depth[layer] > T(0)) || parted(gas, layer));
  }
};

/// Closes the gaps in a particle's list.
struct ClosePairs {
  const std::uint64_t* first;
  const std::uint8_t* keep;
  std::uint32_t* list;
  std::uint64_t* last;

  SPHMBS_INLINE void operator()(std::size_t a) const {
    std::uint64_t end = first[a];
    for (std::uint64_t k = first[a]; k < first[a + 1]; ++k)
      if (keep[k] != 0) list[end++] = list[k];
    last[a] = end;
  }
};

}  // namespace detail

/// Takes out of the lists who does not see whom past a thin body: gas on its one side and gas or
/// layers of the other. Judges lists that were just made: n + 1 entries of `first`, `pairs` of
/// `list`; writes where each list ends now.
template <execution::ExecutionPolicy Policy, int Dim, class T>
void shield(particles::Particles<Dim, T, Policy>& particles,
            const geometry::Periodicity<Dim, T>& space, const std::uint64_t* first,
            std::uint32_t* list, std::uint64_t pairs, std::uint64_t* last) {
  const std::size_t n = particles.size();
  const auto fields = particles.fields();
  execution::Field<std::uint32_t, Policy> count(n);
  execution::Field<std::uint64_t, Policy> room(n + 1);
  detail::PickPatches pick{fields.sheet, first, list, count.data()};
  Policy::for_each(n, pick);
  execution::Field<std::uint32_t, Policy> patches(
      execution::exclusive_scan<Policy>(n, count.data(), room.data()));
  pick.room = room.data();
  pick.patches = patches.data();
  Policy::for_each(n, pick);
  const detail::ListedSheets<Dim, T> listed{fields, space, room.data(), patches.data()};
  execution::Field<std::uint8_t, Policy> keep(pairs);
  Policy::for_each(n, detail::JudgePairs<Dim, T>{listed, first, list, keep.data()});
  Policy::for_each(n, detail::ClosePairs{first, keep.data(), list, last});
}

}  // namespace sphmbs::neighbours
