// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include <sphmbs/core/vec.hpp>
#include <sphmbs/mbs/ancf/plate_shape.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ancf::detail {

/// What the functions on the unit square are multiplied with in a plate of this size, as the
/// coordinates are slopes in x and y: 1, length, width, length width.
template <class Shape>
class PlateScale {
 public:
  PlateScale(double length, double width) : node_{1, length, width, length * width} {}

  double operator()(int k) const {
    return node_[static_cast<std::size_t>(k % Shape::node_functions)];
  }

 private:
  std::array<double, 4> node_;
};

/// The coordinates times these factors, one vector a function.
template <class Shape, class S>
struct NodalVectors {
  static constexpr int size = PlateFunctions<Shape>::size;
  Array<Vec<3, S>, size> value;

  NodalVectors(const PlateScale<Shape>& scale, const Vector<3 * size, S>& q) {
    for (int k = 0; k < size; ++k)
      for (int c = 0; c < 3; ++c) value[k][c] = scale(k) * q[3 * k + c];
  }
};

}  // namespace sphmbs::mbs::ancf::detail
