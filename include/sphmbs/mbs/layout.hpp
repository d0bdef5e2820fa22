// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include <sphmbs/mbs/slots.hpp>
#include <sphmbs/mbs/sparse_pattern.hpp>

namespace sphmbs::mbs {

/// Topology of the assembled equations: which unknown of [q, lambda] belongs to what, where each
/// component computes its contribution, and which contributions add up to which number.
struct Layout {
  int coordinates = 0;          ///< how many
  int conditions = 0;           ///< how many
  std::vector<Role> roles;      ///< of each unknown
  std::vector<Slot> slots;      ///< of all components, type by type, in the order of the adds
  Index index;                  ///< coordinates of all slots, one list after the other
  std::size_t vector_size = 0;  ///< numbers in the residuals of all components
  std::size_t matrix_size = 0;  ///< numbers in their matrix blocks
  std::vector<std::size_t> vector_begin;    ///< where the sources of each unknown's residual begin
  std::vector<std::size_t> vector_sources;  ///< numbers of residuals that it gathers
  SparsePattern pattern;                    ///< what each matrix entry gathers
  SparseMatrix zeros;                       ///< the matrix, with all entries zero
  std::vector<double> mass;                 ///< of M in each matrix entry

  /// Coordinates and multipliers.
  int unknowns() const { return coordinates + conditions; }
  /// The list of a component's coordinates.
  const int* own(const Slot& slot) const { return index.data() + slot.index; }
};

namespace detail {

template <class Structure>
void lay_out_slots(const Structure& structure, Layout& layout) {
  structure.for_each_type([&]<class T>(const auto& components) {
    for (const auto& component : components) {
      Slot slot = slot_of<T>(component);
      slot.first_condition = layout.conditions;
      slot.index = layout.index.size();
      slot.vector = layout.vector_size;
      slot.matrix = layout.matrix_size;
      const Index& own = component.index();
      layout.index.insert(layout.index.end(), own.begin(), own.end());
      layout.conditions += slot.m;
      layout.vector_size += static_cast<std::size_t>(slot.n + slot.m);
      layout.matrix_size = slot.matrix_end();
      layout.slots.push_back(slot);
    }
  });
}

inline void lay_out_vector(Layout& layout) {
  std::vector<std::vector<std::size_t>> sources(static_cast<std::size_t>(layout.unknowns()));
  for (const Slot& slot : layout.slots) {
    std::size_t source = slot.vector;
    for (int k = 0; k < slot.n; ++k)
      sources[static_cast<std::size_t>(layout.own(slot)[k])].push_back(source++);
    const int condition = layout.coordinates + slot.first_condition;
    for (int k = 0; k < slot.m; ++k)
      sources[static_cast<std::size_t>(condition + k)].push_back(source++);
  }
  layout.vector_begin.assign(1, 0);
  for (const auto& list : sources) {
    layout.vector_sources.insert(layout.vector_sources.end(), list.begin(), list.end());
    layout.vector_begin.push_back(layout.vector_sources.size());
  }
}

inline void add_blocks(const Layout& layout, const Slot& slot, SparsePattern& pattern) {
  const int* own = layout.own(slot);
  const int condition = layout.coordinates + slot.first_condition;
  const auto at = [](std::size_t first, int k) { return first + static_cast<std::size_t>(k); };
  for (int j = 0; j < slot.n; ++j) {
    for (int i = 0; i < slot.n && slot.has_A; ++i)
      pattern.add(own[i], own[j], at(slot.matrix, j * slot.n + i));
    for (int i = 0; i < slot.m; ++i) {
      const std::size_t b = at(slot.at_B(), j * slot.m + i);
      pattern.add(condition + i, own[j], b);
      pattern.add(own[j], condition + i, b);
      if (slot.has_L) pattern.add(own[j], condition + i, at(slot.at_L(), i * slot.n + j));
    }
  }
}

inline void lay_out_matrix(const SparseMatrix& M, Layout& layout) {
  layout.pattern.begin(layout.unknowns());
  for (int j = 0; j < M.outerSize(); ++j)
    for (SparseMatrix::InnerIterator m(M, j); m; ++m)
      layout.pattern.keep(static_cast<int>(m.row()), j);
  for (const Slot& slot : layout.slots) add_blocks(layout, slot, layout.pattern);
  layout.zeros = layout.pattern.finish();
  layout.mass.assign(static_cast<std::size_t>(layout.zeros.nonZeros()), 0.0);
  const int* rows = layout.zeros.innerIndexPtr();
  for (int j = 0; j < M.outerSize(); ++j) {
    int k = layout.zeros.outerIndexPtr()[j];
    for (SparseMatrix::InnerIterator m(M, j); m; ++m) {
      while (rows[k] != m.row()) ++k;
      layout.mass[static_cast<std::size_t>(k)] = m.value();
    }
  }
}

}  // namespace detail

/// The layout of a structure with mass matrix M, as its joints stand now.
template <class Structure>
Layout lay_out(const Structure& structure, const SparseMatrix& M) {
  Layout layout;
  layout.coordinates = structure.coordinates();
  detail::lay_out_slots(structure, layout);
  detail::lay_out_vector(layout);
  detail::lay_out_matrix(M, layout);
  layout.roles.assign(static_cast<std::size_t>(layout.unknowns()), Role::multiplier);
  for (int k = 0; k < layout.coordinates; ++k)
    layout.roles[static_cast<std::size_t>(k)] = M.coeff(k, k) > 0 ? Role::massive : Role::massless;
  return layout;
}

/// What messages call the component behind an unknown: the joint or body of a multiplier, the first
/// part that has the coordinate.
template <class Structure>
std::string name_of_unknown(const Structure& structure, const Layout& layout, int unknown) {
  std::string name;
  std::size_t number = 0;
  const int condition = unknown - layout.coordinates;
  structure.for_each_type([&]<class T>(const auto& components) {
    for (const auto& component : components) {
      const Slot& slot = layout.slots[number++];
      const int* own = layout.own(slot);
      const bool held =
          condition >= slot.first_condition && condition < slot.first_condition + slot.m;
      const bool moved = Part<T> && std::find(own, own + slot.n, unknown) != own + slot.n;
      if (name.empty() && (condition >= 0 ? held : moved)) name = structure.name_of(component);
    }
  });
  return name.empty() ? "coordinate " + std::to_string(unknown) : name;
}

/// Where the conditions of a component begin among all, and how many they are.
/// @throws InvalidInput unless there is a component of the type with that number.
template <class T, class Structure>
std::pair<int, int> conditions_of(const Structure& structure, const Layout& layout, int number) {
  std::pair<int, int> range{0, 0};
  std::size_t first = 0;
  structure.for_each_type([&]<class Other>(const auto& components) {
    if constexpr (std::is_same_v<T, Other>) {
      expects(number >= 0 && number < static_cast<int>(components.size()),
              "number of a joint or body", number,
              "from 0 to " + std::to_string(static_cast<int>(components.size()) - 1));
      const Slot& slot = layout.slots.at(first + static_cast<std::size_t>(number));
      range = {slot.first_condition, slot.m};
    }
    first += components.size();
  });
  return range;
}

}  // namespace sphmbs::mbs
