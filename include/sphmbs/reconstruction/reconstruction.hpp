// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/math.hpp>

/// From the values at two particles to the two sides of their Riemann problem.
namespace sphmbs::reconstruction {

/// What a reconstruction offers. `slopes` says whether the gas's first derivatives are needed. If
/// so, `step(projected, jump)` is the change of a field from a particle to the middle of a pair:
/// `projected` is the particle's slope times the way to the other one and `jump` the difference of
/// the two values; it must also accept packs. `limits_particles` says whether slopes are limited
/// particle by particle first, so that no value in the middle of a pair leaves the range of the
/// neighbours.
template <class R>
concept Reconstruction = std::is_trivially_copyable_v<R> && requires(const R r, double x) {
  { R::slopes } -> std::convertible_to<bool>;
  { R::limits_particles } -> std::convertible_to<bool>;
  { r.step(x, x) } -> std::same_as<double>;
};

}  // namespace sphmbs::reconstruction
