// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/atomic.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/execution/scan.hpp>
#include <sphmbs/neighbours/cell_grid.hpp>
#include <sphmbs/neighbours/cell_neighbours.hpp>
#include <sphmbs/neighbours/find_neighbours.hpp>
#include <sphmbs/neighbours/shielding.hpp>

namespace sphmbs::neighbours {

namespace detail {

template <int Dim, class T>
struct CountCells {
  particles::FieldsView<Dim, T> fields;
  CellGrid<Dim, T> grid;
  std::uint32_t* count;
  SPHMBS_INLINE void operator()(std::size_t i) const {
    atomic::fetch_add(count + grid.cell(fields.position(i)), 1);
  }
};

template <int Dim, class T>
struct PlaceInCells {
  particles::FieldsView<Dim, T> fields;
  CellGrid<Dim, T> grid;
  const std::uint32_t* first;
  std::uint32_t* placed;
  std::uint32_t* order;
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const std::uint32_t c = grid.cell(fields.position(i));
    order[first[c] + atomic::fetch_add(placed + c, 1)] = static_cast<std::uint32_t>(i);
  }
};

/// The longest list, and whose it is: the lowest id of several.
struct Crowd {
  std::uint32_t count = 0;
  std::uint32_t id = 0;
  SPHMBS_INLINE void combine(const Crowd& o) {
    const bool more = o.count > count || (o.count == count && o.id < id);
    count = more ? o.count : count;
    id = more ? o.id : id;
  }
};

struct CrowdAround {
  const std::uint32_t* count;
  const std::uint32_t* id;
  SPHMBS_INLINE Crowd operator()(std::size_t i) const { return {count[i], id[i]}; }
};

struct Zero {
  std::uint32_t* count;
  SPHMBS_INLINE void operator()(std::size_t i) const { count[i] = 0; }
};

/// Ends lists where openings' particles meet others than gas: these see gas alone, and virtual
/// particles do not see them. In an opening's list its own particles come behind the gas, up to
/// `whole`.
struct CutAtOpenings {
  const std::uint8_t* set;
  const std::uint64_t* first;
  std::uint32_t* list;
  std::uint64_t* last;
  std::uint64_t* whole;
  SPHMBS_INLINE void operator()(std::size_t a) const {
    whole[a] = last[a];
    if (set[a] == particles::gas) return;
    if (particles::is_virtual(set[a])) {
      last[a] =
          gather(first[a], last[a], [&](std::uint8_t s) { return !particles::is_opening(s); });
      return;
    }
    const std::uint64_t end = last[a];
    last[a] = gather(first[a], end, [](std::uint8_t s) { return s == particles::gas; });
    whole[a] = gather(last[a], end, [&](std::uint8_t s) { return s == set[a]; });
  }

 private:
  // Puts those that `stay` says first; returns where they end.
  template <class Stay>
  SPHMBS_INLINE std::uint64_t gather(std::uint64_t begin, std::uint64_t end,
                                     const Stay& stay) const {
    std::uint64_t to = begin;
    for (std::uint64_t k = begin; k < end; ++k) {
      const std::uint32_t b = list[k];
      if (!stay(set[b])) continue;
      list[k] = list[to];
      list[to++] = b;
    }
    return to;
  }
};

struct EndAtNext {
  const std::uint64_t* first;
  std::uint64_t* last;
  SPHMBS_INLINE void operator()(std::size_t a) const { last[a] = first[a + 1]; }
};

/// Sorts the members of a cell by id: the order in which threads placed them is forgotten.
struct SortCell {
  const std::uint32_t* first;
  const std::uint32_t* id;
  std::uint32_t* order;
  SPHMBS_INLINE void operator()(std::size_t c) const {
    for (std::uint32_t i = first[c] + 1; i < first[c + 1]; ++i) {
      const std::uint32_t moved = order[i];
      std::uint32_t j = i;
      for (; j > first[c] && id[order[j - 1]] > id[moved]; --j) order[j] = order[j - 1];
      order[j] = moved;
    }
  }
};

}  // namespace detail

/// Cell-linked domain decomposition (sect. 4.3): particles are kept sorted by cells of half a
/// reach, neighbours are found among the cells around and listed once for all evaluations until
/// particles have moved by more than the skin. Each h may differ; any set of axes may be periodic.
template <int Dim, class T, execution::ExecutionPolicy Policy>
class CellList {
 public:
  /// Sorts the particles and lists the neighbours of each, in the order of the cells. The result
  /// does not depend on the number of threads.
  /// @throws InvalidInput if a periodic axis is shorter than two supports; NumericalFailure where
  ///         particles are so crowded that their lists would take all memory.
  void rebuild(particles::Particles<Dim, T, Policy>& particles, const geometry::Domain<Dim>& domain,
               const Reach& reach) {
    check_reach(domain, reach);
    const std::size_t n = particles.size();
    const auto grid = CellGrid<Dim, T>::around(particles, domain, reach);
    execution::Field<std::uint32_t, Policy> order(n);
    sort(particles, grid, order.data());
    particles.permute(order.data());

    first_.resize_discarding(n + 1);
    detail::FindNeighbours<Dim, T, Policy::template lanes<T>> find{
        .fields = particles.fields(),
        .grid = grid,
        .space = domain.template periodicity<T>(),
        .cell_first = cell_first_.data(),
        .half_support = static_cast<T>(reach.support / 2),
        .skin = static_cast<T>(reach.skin),
        .border = static_cast<T>(reach.largest())};
    constexpr int W = Policy::template lanes<T>;
    if constexpr (W > 1)
      Policy::for_each(grid.cells(), detail::CellNeighbours<Dim, T, W, false>{find, order.data(),
                                                                              nullptr, nullptr});
    else
      Policy::for_each(n, detail::CountNeighbours<Dim, T, W>{find, order.data()});
    refuse_crowd(execution::reduce<Policy>(
        n, detail::Crowd{}, detail::CrowdAround{order.data(), particles.fields().id}));
    const std::uint64_t pairs = execution::exclusive_scan<Policy>(n, order.data(), first_.data());
    // A little room to spare, since fresh memory for every new list would cost more than the list.
    if (pairs > list_.size() || 2 * pairs < list_.size())
      list_.resize_discarding(pairs + pairs / 256);
    if constexpr (W > 1)
      Policy::for_each(grid.cells(), detail::CellNeighbours<Dim, T, W, true>{
                                         find, nullptr, first_.data(), list_.data()});
    else
      Policy::for_each(n, detail::ListNeighbours<Dim, T, W>{find, first_.data(), list_.data()});
    const bool sheets = particles.fields().sheet != nullptr;
    if (!sheets && !particles.has_openings()) return;
    last_.resize_discarding(n);
    if (sheets)
      shield(particles, find.space, first_.data(), list_.data(), pairs, last_.data());
    else
      Policy::for_each(n, detail::EndAtNext{first_.data(), last_.data()});
    if (!particles.has_openings()) return;
    whole_.resize_discarding(n);
    Policy::for_each(n, detail::CutAtOpenings{find.fields.set, first_.data(), list_.data(),
                                              last_.data(), whole_.data()});
  }

  /// The lists, for loops.
  NeighbourView view() const {
    const bool cut = last_.size() > 0;
    return {first_.data(), cut ? last_.data() : first_.data() + 1, list_.data()};
  }

  /// The same, and in the lists of openings' particles also others of the same opening, which
  /// `view` leaves out. Only where there are openings.
  NeighbourView whole() const { return {first_.data(), whole_.data(), list_.data()}; }

  /// The lists: sums over neighbours go by their order, which new lists at another time lack.
  template <Archive A>
  void visit_state(A& archive) {
    std::uint64_t entries = first_.size(), pairs = 0;
    archive("entries", entries);
    if (!A::restores && entries > 0)
      Policy::download(&pairs, first_.data() + (entries - 1), sizeof pairs);
    archive("pairs", pairs);
    const auto n = static_cast<std::size_t>(entries), last = n > 0 ? n - 1 : 0;
    archive.field("first", first_, n, n);
    archive.field("list", list_, pairs, pairs + pairs / 256);
    archive.field("last", last_, last, last);
    archive.field("whole", whole_, last, last);
  }

  /// Memory held [bytes].
  std::size_t bytes() const {
    return first_.bytes() + list_.bytes() + cell_first_.bytes() + last_.bytes() + whole_.bytes();
  }

 private:
  // In space at twice the usual smoothing length there are some 3 000.
  static constexpr std::uint32_t most_neighbours = 8192;

  static void refuse_crowd(const detail::Crowd& most) {
    if (most.count <= most_neighbours) return;
    throw NumericalFailure(
        "particle #" + std::to_string(most.id) + " has " + std::to_string(most.count) +
            " neighbours, more than " + std::to_string(most_neighbours) +
            "\n  likely: many particles at one place, or a smoothing length that does not fit the "
            "spacing\n  try: remove particles that were added twice; a smaller smoothing ratio",
        "E311", {most.id});
  }

  void sort(particles::Particles<Dim, T, Policy>& particles, const CellGrid<Dim, T>& grid,
            std::uint32_t* order) {
    const std::size_t n = particles.size();
    const std::size_t cells = grid.cells();
    const auto fields = particles.fields();
    execution::Field<std::uint32_t, Policy> count(cells);
    cell_first_.resize_discarding(cells + 1);
    Policy::for_each(cells, detail::Zero{count.data()});
    Policy::for_each(n, detail::CountCells<Dim, T>{fields, grid, count.data()});
    execution::exclusive_scan<Policy>(cells, count.data(), cell_first_.data());
    Policy::for_each(cells, detail::Zero{count.data()});
    Policy::for_each(
        n, detail::PlaceInCells<Dim, T>{fields, grid, cell_first_.data(), count.data(), order});
    Policy::for_each(cells, detail::SortCell{cell_first_.data(), fields.id, order});
  }

  execution::Field<std::uint32_t, Policy> cell_first_;
  execution::Field<std::uint64_t, Policy> first_;
  execution::Field<std::uint32_t, Policy> list_;
  execution::Field<std::uint64_t, Policy> whole_;
  execution::Field<std::uint64_t, Policy> last_;  // where lists end that do not fill their place
};

}  // namespace sphmbs::neighbours
