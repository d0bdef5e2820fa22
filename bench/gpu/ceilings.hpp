// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include <sphmbs/core/inline.hpp>
#include <sphmbs/execution/field.hpp>

/// What a device can do at best: speeds that no particle loop exceeds.
namespace bench {

/// Shortest of some runs [s].
template <class Run>
double shortest(int runs, Run&& run) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int k = 0; k < runs; ++k) {
    const auto begin = Clock::now();
    run();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return best;
}

struct CopyNumber {
  const double* from;
  double* to;
  SPHMBS_INLINE void operator()(std::size_t i) const { to[i] = from[i]; }
};

/// Bytes read and written a second by a loop that copies.
template <class Policy>
double copy_bandwidth(std::size_t numbers) {
  const std::vector<double> zeros(numbers);
  sphmbs::execution::Field<double, Policy> from(zeros), to(zeros);
  const double seconds = shortest(8, [&] {
    Policy::for_each(numbers, CopyNumber{from.data(), to.data()});
  });
  return 2 * sizeof(double) * static_cast<double>(numbers) / seconds;
}

/// Eight chains of dependent multiplications and additions.
template <class T, int length>
struct MultiplyAdd {
  T* result;
  T factor, term;
  SPHMBS_INLINE void operator()(std::size_t i) const {
    T a = static_cast<T>(i), b = a + T(1), c = a + T(2), d = a + T(3);
    T e = a + T(4), f = a + T(5), g = a + T(6), h = a + T(7);
    for (int k = 0; k < length; ++k) {
      a = factor * a + term;
      b = factor * b + term;
      c = factor * c + term;
      d = factor * d + term;
      e = factor * e + term;
      f = factor * f + term;
      g = factor * g + term;
      h = factor * h + term;
    }
    result[i] = ((a + b) + (c + d)) + ((e + f) + (g + h));
  }
};

/// Floating-point operations a second, a multiplication and an addition counted as two.
template <class Policy, class T>
double operation_rate(std::size_t bodies) {
  constexpr int length = 512;
  sphmbs::execution::Field<T, Policy> result(bodies);
  const MultiplyAdd<T, length> body{result.data(), static_cast<T>(0.999), static_cast<T>(1e-3)};
  const double seconds = shortest(4, [&] { Policy::for_each(bodies, body); });
  return 2.0 * 8 * length * static_cast<double>(bodies) / seconds;
}

struct StoreOne {
  std::uint32_t* to;
  SPHMBS_INLINE void operator()(std::size_t) const { *to = 1; }
};

/// Time of a loop that does nothing [s].
template <class Policy>
double launch_time() {
  sphmbs::execution::Field<std::uint32_t, Policy> one(1);
  return shortest(5,
                  [&] {
                    for (int k = 0; k < 100; ++k) Policy::for_each(1, StoreOne{one.data()});
                  }) /
         100;
}

}  // namespace bench
