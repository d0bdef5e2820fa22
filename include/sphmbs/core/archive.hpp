// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string_view>

namespace sphmbs {

/// What a state is shown to, in order to be saved or restored: io::StateWriter and io::StateReader.
/// A class lets its state be seen by
///
///     template <Archive A> void visit_state(A& archive) {
///       archive("time", time_);
///       if constexpr (A::restores) { ... }   // what follows from the rest
///     }
///
/// with everything that the rest of a run depends on, to the bit, and that the constructor does not
/// set. Numbers, strings, vectors and matrices of numbers, std::vector, std::map, std::deque,
/// std::set and objects with a visit_state of their own can be shown.
template <class A>
concept Archive = requires(A archive, std::string_view name, double& number) {
  { A::restores } -> std::convertible_to<bool>;
  archive(name, number);
};

}  // namespace sphmbs
