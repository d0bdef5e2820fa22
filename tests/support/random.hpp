// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <sphmbs/core/vec.hpp>

namespace test {

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Uniform in [from, to).
  double between(double from, double to) { return from + (to - from) * unit(); }
  /// Every component uniform in [-size, size).
  template <int Dim>
  sphmbs::Vec<Dim> vector(double size) {
    sphmbs::Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = between(-size, size);
    return x;
  }
  /// Whole number below n.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

  /// The numbers 0 ... n - 1 in some order.
  std::vector<std::size_t> order(std::size_t n) {
    std::vector<std::size_t> shuffled(n);
    for (std::size_t i = 0; i < n; ++i) shuffled[i] = i;
    for (std::size_t i = n; i > 1; --i) std::swap(shuffled[i - 1], shuffled[below(i)]);
    return shuffled;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace test
