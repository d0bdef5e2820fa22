// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/mbs/quarter_turn.hpp>

namespace sphmbs::mbs::ncf {

/// X1 + X2 J: what turns a unit vector e along the first axis into the place of X. Its columns are
/// orthogonal and of length |X|, hence the mass matrix needs no more than the polar moment.
inline Matrix<2, 2> similarity(const Vector<2>& X) {
  return X[0] * Matrix<2, 2>::Identity() + X[1] * quarter_turn();
}

}  // namespace sphmbs::mbs::ncf
