// SPDX-License-Identifier: MIT
// Fields of float: what they lose against double is their own rounding, and not that of positions
// in a large domain.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/sph/presets.hpp>
#include <sphmbs/time/predictor_corrector.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"
#include "support/state.hpp"

namespace {

using sphmbs::Vec;
constexpr double spacing = 0.1;

/// A square of disordered gas whose lower corner lies `offset` from the origin.
template <int Dim>
struct Square {
  sphmbs::geometry::Domain<Dim> domain;
  sphmbs::particles::Cloud<Dim> cloud;

  Square(int per_side, double offset)
      : domain(test::cube<Dim>(per_side * spacing, true)),
        cloud(test::disordered_cloud<Dim>(per_side, spacing, 3, {.place = 0.1, .speed = 3})) {
    const auto far = Vec<Dim>::all(offset);
    for (Vec<Dim>& r : cloud.r) r += far;
    domain.box.lower += far;
    domain.box.upper += far;
  }
};

/// Largest error of accelerations in float, as a share of the largest one.
template <class Policy, int Dim>
double error_of_float(double offset) {
  const Square<Dim> square(Dim == 2 ? 24 : 12, offset);
  const test::Gas<Dim> gas{};
  const auto exact = test::rates_of<sphmbs::execution::Serial>(gas, square.domain, square.cloud);
  const auto found = test::rates_of<Policy, float>(gas, square.domain, square.cloud);
  double most = 0, size = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    REQUIRE(std::isfinite(test::length(found.v[i])));
    most = std::max(most, test::length(found.v[i] - exact.v[i]));
    size = std::max(size, test::length(exact.v[i]));
  }
  return most / size;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("forces in float are as good in a large domain as in a small one", "[sph]",
                        test::Policies) {
  const double near = error_of_float<TestType, 2>(0);
  CHECK(near < 1e-5);
  // A float holds 1000 m to 6e-5 m, which is 6e-4 of a spacing.
  CHECK(error_of_float<TestType, 2>(1000) < 2 * near);
  CHECK(error_of_float<TestType, 3>(1000) < 2e-5);
}

TEMPLATE_LIST_TEST_CASE("forces in float are as good across a long period as inside", "[sph]",
                        test::Policies) {
  // A float holds neither 1000.1 m nor differences of that size.
  sphmbs::geometry::Domain<1> domain{{{0.0}, {1000.1}}, {true}};
  auto cloud = test::disordered_cloud<1>(10001, spacing, 3, {.place = 0.1, .speed = 3});
  const test::Gas<1> gas{};
  const auto exact = test::rates_of<sphmbs::execution::Serial>(gas, domain, cloud);
  const auto found = test::rates_of<TestType, float>(gas, domain, cloud);
  double most = 0, size = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    REQUIRE(std::isfinite(found.v[i][0]));
    most = std::max(most, std::abs(found.v[i][0] - exact.v[i][0]));
    size = std::max(size, std::abs(exact.v[i][0]));
  }
  CHECK(most < 1e-5 * size);
}

TEMPLATE_LIST_TEST_CASE("small steps add up in float", "[sph]", test::Policies) {
  // Steps of 5e-8 m at 1000 m, a thousandth of what a float can tell there.
  Square<2> square(16, 1000);
  for (std::size_t i = 0; i < square.cloud.size(); ++i) {
    square.cloud.v[i] = {5e-3, -5e-3};
    square.cloud.rho[i] = 1.2;
    square.cloud.p[i] = 1e5;
  }
  // Disordered particles under one pressure still move: less than that noise must differ.
  const auto moved = [&]<class T>(auto policy) {
    sphmbs::sph::Fluid<test::Gas<2>, decltype(policy), sphmbs::boundary::Fixed, T> fluid(
        {}, square.domain, square.cloud);
    test::take_steps(fluid, sphmbs::time::PredictorCorrector{}, 100, 1e-5);
    const auto fields = fluid.particles().fields();
    std::vector<Vec<2>> r(fluid.size());
    for (int k = 0; k < 2; ++k) {
      const auto high = test::by_id<decltype(policy)>(fields.r[k], fields.id, fluid.size());
      for (std::size_t i = 0; i < r.size(); ++i) r[i][k] = static_cast<double>(high[i]);
      if constexpr (sphmbs::particles::splits_positions<T>) {
        const auto rest = test::by_id<decltype(policy)>(fields.rest[k], fields.id, fluid.size());
        for (std::size_t i = 0; i < r.size(); ++i) r[i][k] += static_cast<double>(rest[i]);
      }
    }
    return r;
  };
  const auto exact = moved.template operator()<double>(sphmbs::execution::Serial{});
  const auto found = moved.template operator()<float>(TestType{});
  double apart = 0, way = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    apart = std::max(apart, test::length(found[i] - exact[i]));
    way = std::max(way, test::length(exact[i] - square.cloud.r[i]));
  }
  CHECK(way > 5e-6);
  CHECK(apart < 1e-3 * way);
}
