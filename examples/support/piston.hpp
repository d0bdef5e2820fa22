// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::examples {

/// A part of one's own: a piston that slides along x, whose one coordinate is its way.
struct Piston {
  static constexpr std::string_view label = "piston";
  static constexpr int dim = 2, nodes = 1, node_dofs = 1, dofs = 1, conditions = 0;
  using Material = mbs::Vector<2>;
  using Matrix1 = mbs::Matrix<1, 1>;

  double mass;          // [kg]
  double position = 0;  // at t = 0 [m]
  double velocity = 0;  // at t = 0 [m/s]

  void check() const { expects(mass > 0, "mass", mass, "positive [kg]"); }
  Matrix1 mass_matrix() const { return Matrix1(mass); }
  mbs::Matrix<2, 1> shape(const Material&) const { return {1, 0}; }
  static mbs::Matrix<1, 2> translation() { return {1, 0}; }
  mbs::Vector<0> rigidity(const mbs::Vector<1>&) const { return {}; }
  mbs::Matrix<0, 1> rigidity_jacobian(const mbs::Vector<1>&) const { return {}; }
  Matrix1 rigidity_hessian(const mbs::Vector<0>&) const { return Matrix1::Zero(); }
  mbs::Vector<1> initial_coordinates() const { return mbs::Vector<1>(position); }
  mbs::Vector<1> initial_rates() const { return mbs::Vector<1>(velocity); }
};

static_assert(mbs::Body<Piston>);

}  // namespace sphmbs::examples
