// SPDX-License-Identifier: MIT
#include <cmath>

#include <sphmbs/mbs/ancf/quadrature.hpp>

#include "support/catch.hpp"

using namespace sphmbs::mbs::ancf;

namespace {

constexpr double rounding = 4e-16;

template <int N>
double integral_of_power(int degree) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i)
    sum += gauss<N>.weight[i] * std::pow(gauss<N>.point[i], degree);
  return sum;
}

template <int N>
void check_rule() {
  INFO("points: " << N);
  for (int degree = 0; degree < 2 * N; ++degree) {
    INFO("degree " << degree);
    CHECK(std::abs(integral_of_power<N>(degree) - 1.0 / (degree + 1)) < rounding);
  }
  // The monic Legendre polynomial squared has the integral (N!)^4 / ((2N)!^2 (2N+1)) on [0, 1].
  const double missed =
      std::exp(4 * std::lgamma(N + 1.0) - 2 * std::lgamma(2 * N + 1.0)) / (2 * N + 1);
  CHECK(1.0 / (2 * N + 1) - integral_of_power<N>(2 * N) == Approx(missed).epsilon(1e-5));
  for (std::size_t i = 1; i < N; ++i) CHECK(gauss<N>.point[i - 1] < gauss<N>.point[i]);
}

}  // namespace

TEST_CASE("Gauss rules are exact up to degree 2N-1 and miss degree 2N by the known error",
          "[mbs]") {
  check_rule<1>();
  check_rule<2>();
  check_rule<3>();
  check_rule<4>();
  check_rule<5>();
  check_rule<6>();
}

static_assert(gauss<1>.point[0] == 0.5 && gauss<1>.weight[0] == 1.0);
