// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/boundary/wall_model.hpp>

namespace sphmbs::boundary {

/// The paper's walls: virtual particles answer with the density and energy that they themselves
/// evolved by eqs. (20) and (22), from the gas's initial state. Layers at the rim, whose support is
/// cut off, lag behind the gas and bleed that lag inwards; see docs/theory.md.
struct Evolved {
  /// Whether virtual particles carry a state, see `WallModel`.
  static constexpr bool evolves = true;
  static constexpr bool surfaces = false;  ///< whether the true surface is used, see `WallModel`
  static constexpr bool slips = false;     ///< whether gas slides along without friction

  /// The far side of the pair's Riemann problem: the virtual particle's own state.
  template <class N>
  SPHMBS_INLINE riemann::State<N> facing(const riemann::State<N>&,
                                         const riemann::State<N>& stored) const {
    return stored;
  }

  /// Does nothing: no parameter can be out of range.
  void check() const {}
};

static_assert(WallModel<Evolved>);

}  // namespace sphmbs::boundary
