// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <sphmbs/mbs/joints/time_function.hpp>

namespace sphmbs::mbs::joints {

/// Number with its derivative along one direction, by forward automatic differentiation.
using Dual = Eigen::AutoDiffScalar<Vector<1>>;

/// Number with its derivatives along two directions and the mixed second derivative.
using Dual2 = Eigen::AutoDiffScalar<Matrix<1, 1, Dual>>;

/// The number x whose derivative is `along`.
inline Dual dual(double x, double along) { return {x, Vector<1>(along)}; }

/// The number x with derivatives along two directions.
inline Dual2 dual2(double x, double along_1, double along_2) {
  return {dual(x, along_1), Matrix<1, 1, Dual>(dual(along_2, 0))};
}

/// Derivative.
inline double slope(const Dual& x) { return x.derivatives()[0]; }
/// Second derivative along the two directions.
inline double mixed(const Dual2& x) { return x.derivatives()[0].derivatives()[0]; }

/// A time function whose derivatives are found by automatic differentiation.
/// @param f callable with any scalar: `[](auto t) { using std::sin; return sin(t * t); }`; its
/// result is a number, so that an expression needs `decltype(t)(...)` around it
template <class F>
TimeFunction differentiated(F f) {
  return {[f](double t) { return static_cast<double>(f(t)); },
          [f](double t) { return slope(Dual(f(dual(t, 1)))); },
          [f](double t) { return mixed(Dual2(f(dual2(t, 1, 1)))); }};
}

}  // namespace sphmbs::mbs::joints
