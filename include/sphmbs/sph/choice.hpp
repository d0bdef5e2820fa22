// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

namespace sphmbs::sph {

namespace detail {

template <class Fits, class Default, class... Policies>
struct Choose {
  using type = Default;
};
template <class Fits, class Default, class First, class... Rest>
struct Choose<Fits, Default, First, Rest...> {
  using type = typename std::conditional_t<Fits::template value<First>, std::type_identity<First>,
                                           Choose<Fits, Default, Rest...>>::type;
};

}  // namespace detail

/// The first of some policies that fits a place, or the default where none does. `Fits` has a
/// member template `value<Policy>`.
template <class Fits, class Default, class... Policies>
using Choice = typename detail::Choose<Fits, Default, Policies...>::type;

}  // namespace sphmbs::sph
