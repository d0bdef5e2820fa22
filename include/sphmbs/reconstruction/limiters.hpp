// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/reconstruction/reconstruction.hpp>

namespace sphmbs::reconstruction {

/// What a limiter offers: the difference over the way between two particles that one of them may
/// assume. `projected` is its own slope times that way, `jump` the difference of the two values;
/// the difference on the other side of the particle is then 2 projected - jump.
template <class L>
concept Limiter = std::is_trivially_copyable_v<L> && requires(const L limiter, double x) {
  { L::limits_particles } -> std::convertible_to<bool>;
  { limiter.difference(x, x) } -> std::same_as<double>;
};

/// Harmonic mean of the differences on both sides, none at extrema (van Leer 1974).
struct VanLeer {
  /// Whether slopes are limited particle by particle first.
  static constexpr bool limits_particles = false;

  /// Limited difference between two particles, from the slope's and the true one.
  template <class N>
  SPHMBS_INLINE N difference(N projected, N jump) const {
    const N behind = N(2) * projected - jump;
    const N product = behind * jump;
    return math::select(product > N(0), product / projected, N(0));
  }
};

/// The smaller of the differences on both sides, none at extrema: the most careful (Roe 1986).
struct Minmod {
  /// Whether slopes are limited particle by particle first.
  static constexpr bool limits_particles = false;

  /// Limited difference between two particles, from the slope's and the true one.
  template <class N>
  SPHMBS_INLINE N difference(N projected, N jump) const {
    const N behind = N(2) * projected - jump;
    const N smaller = math::select(math::abs(behind) < math::abs(jump), behind, jump);
    return math::select(behind * jump > N(0), smaller, N(0));
  }
};

/// Slopes are shortened particle by particle until no value in the middle of a pair leaves the
/// range of the neighbours (Barth and Jespersen 1989; in this form Hopkins 2015). Sound is damped
/// as little as with van Leer's; shear flow along walls, whose largest values have no equal beyond
/// them, is braked more.
struct BarthJespersen {
  /// Whether slopes are limited particle by particle first.
  static constexpr bool limits_particles = true;

  /// Limited difference between two particles, from the slope's and the true one.
  template <class N>
  SPHMBS_INLINE N difference(N projected, N) const {
    return projected;
  }
};

/// None: for flows known to be smooth.
struct Unlimited {
  /// Whether slopes are limited particle by particle first.
  static constexpr bool limits_particles = false;

  /// Limited difference between two particles, from the slope's and the true one.
  template <class N>
  SPHMBS_INLINE N difference(N projected, N) const {
    return projected;
  }
};

static_assert(Limiter<VanLeer> && Limiter<Minmod> && Limiter<BarthJespersen> && Limiter<Unlimited>);

}  // namespace sphmbs::reconstruction
