// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace sphmbs::mbs::ancf {

/// Integral of f from 0 to 1 by the sum of weight[i] f(point[i]); points ascending, weights sum
/// to 1.
template <int N>
struct GaussRule {
  static constexpr int size = N;  ///< number of points
  /// In (0, 1).
  std::array<double, static_cast<std::size_t>(N)> point;
  /// Sum 1.
  std::array<double, static_cast<std::size_t>(N)> weight;
};

namespace detail {

template <int N>
using HalfRule = std::array<double, static_cast<std::size_t>((N + 1) / 2)>;

/// From [-1, 1] to [0, 1], given the abscissae that are not negative, ascending, with their
/// weights.
template <int N>
constexpr GaussRule<N> on_unit_interval(const HalfRule<N>& abscissa, const HalfRule<N>& weight) {
  constexpr std::size_t n = N, half = (n + 1) / 2;
  GaussRule<N> rule{};
  for (std::size_t k = 0; k < half; ++k) {
    const std::size_t right = n - half + k, left = half - 1 - k;
    rule.point[right] = 0.5 + 0.5 * abscissa[k];
    rule.point[left] = 0.5 - 0.5 * abscissa[k];
    rule.weight[right] = rule.weight[left] = 0.5 * weight[k];
  }
  return rule;
}

template <int N>
constexpr GaussRule<N> gauss_legendre() {
  static_assert(N >= 1 && N <= 6, "Gauss-Legendre rules have 1 to 6 points");
  if constexpr (N == 1) {
    return on_unit_interval<1>({0.0}, {2.0});
  } else if constexpr (N == 2) {
    return on_unit_interval<2>({0.57735026918962576451}, {1.0});
  } else if constexpr (N == 3) {
    return on_unit_interval<3>({0.0, 0.77459666924148337704}, {8.0 / 9, 5.0 / 9});
  } else if constexpr (N == 4) {
    return on_unit_interval<4>({0.33998104358485626480, 0.86113631159405257522},
                               {0.65214515486254614263, 0.34785484513745385737});
  } else if constexpr (N == 5) {
    return on_unit_interval<5>(
        {0.0, 0.53846931010568309104, 0.90617984593866399280},
        {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751});
  } else {
    return on_unit_interval<6>(
        {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781},
        {0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504});
  }
}

}  // namespace detail

/// Gauss-Legendre rule with N = 1 ... 6 points, exact for polynomials of degree 2 N - 1
/// (Abramowitz and Stegun, table 25.4).
template <int N>
inline constexpr GaussRule<N> gauss = detail::gauss_legendre<N>();

}  // namespace sphmbs::mbs::ancf
