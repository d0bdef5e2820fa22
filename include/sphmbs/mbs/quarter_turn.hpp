// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

/// J: the quarter turn in the plane, anticlockwise.
inline Matrix<2, 2> quarter_turn() { return (Matrix<2, 2>() << 0, -1, 1, 0).finished(); }

/// J a.
inline Vector<2> quarter_turn(const Vector<2>& a) { return {-a[1], a[0]}; }

}  // namespace sphmbs::mbs
