// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/reference_rates.hpp"

namespace {

// Rounded positions change separations by 1e-16 times the side of the box over the spacing.
constexpr double rounding = 1e-12;
constexpr double spacing = 0.1;

template <int Dim>
using Cloud = sphmbs::particles::Cloud<Dim>;
template <int Dim>
using Domain = sphmbs::geometry::Domain<Dim>;

template <int Dim>
struct Case {
  Cloud<Dim> cloud = test::disordered_cloud<Dim>(test::some_hundreds<Dim>, spacing, 41);
  double side = test::some_hundreds<Dim> * spacing;
};

/// The largest change of the rates when the cloud is told in another way, against the sizes of the
/// terms they are sums of.
template <class Policy, int Dim>
double change(const Cloud<Dim>& before, const Cloud<Dim>& after, const Domain<Dim>& domain) {
  const auto sizes = test::reference_rates(test::ReferenceGas{}, domain, before);
  return test::largest_difference(test::rates_of<Policy, double>(test::Gas<Dim>{}, domain, before),
                                  test::rates_of<Policy, double>(test::Gas<Dim>{}, domain, after),
                                  sizes);
}

double into(double x, double side) { return x - side * std::floor(x / side); }

}  // namespace

TEMPLATE_LIST_TEST_CASE("rates in a periodic box do not depend on where the box begins", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const Case<Dim> start;
    Cloud<Dim> shifted = start.cloud;
    const double step[3] = {0.371, 0.805, 0.559};
    for (auto& r : shifted.r)
      for (int k = 0; k < Dim; ++k) r[k] = into(r[k] + step[k] * start.side, start.side);
    CHECK(change<TestType>(start.cloud, shifted, test::cube<Dim>(start.side, true)) < rounding);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("rates do not depend on which image of a particle is given", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const Case<Dim> start;
    Cloud<Dim> images = start.cloud;
    test::Random random(42);
    for (auto& r : images.r)
      for (int k = 0; k < Dim; ++k) r[k] += start.side * (static_cast<double>(random.below(3)) - 1);
    CHECK(change<TestType>(start.cloud, images, test::cube<Dim>(start.side, true)) < rounding);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a periodic gas is the same with its lower border anywhere", "[sph]",
                        test::Policies) {
  const Case<2> start;
  const auto domain = test::cube<2>(start.side, true);
  auto moved_domain = domain;
  moved_domain.box.lower = {-7.25, 3.5};
  moved_domain.box.upper = moved_domain.box.lower + domain.box.upper;
  Cloud<2> moved = start.cloud;
  for (auto& r : moved.r) r += moved_domain.box.lower;
  const auto sizes = test::reference_rates(test::ReferenceGas{}, domain, start.cloud);
  const auto here = test::rates_of<TestType, double>(test::Gas<2>{}, domain, start.cloud);
  const auto there = test::rates_of<TestType, double>(test::Gas<2>{}, moved_domain, moved);
  CHECK(test::largest_difference(here, there, sizes) < rounding);
}

TEMPLATE_LIST_TEST_CASE("rates turn with a gas that is turned by a right angle", "[sph]",
                        test::Policies) {
  const bool periodic = GENERATE(false, true);
  const auto check = [&]<int Dim>(std::integral_constant<int, Dim>) {
    const Case<Dim> start;
    // (x, y, z) becomes (-y, x, z), then in space also every axis becomes the next one.
    const auto turn = [](const sphmbs::Vec<Dim>& x) {
      sphmbs::Vec<Dim> turned = x;
      turned[0] = -x[1];
      turned[1] = x[0];
      if constexpr (Dim == 3) turned = {turned[2], turned[0], turned[1]};
      return turned;
    };
    const auto domain = test::cube<Dim>(start.side, periodic);
    auto turned_domain = domain;
    const sphmbs::Vec<Dim> lower = turn(domain.box.lower);
    const sphmbs::Vec<Dim> upper = turn(domain.box.upper);
    for (int k = 0; k < Dim; ++k) {
      turned_domain.box.lower[k] = std::min(lower[k], upper[k]);
      turned_domain.box.upper[k] = std::max(lower[k], upper[k]);
    }
    Cloud<Dim> turned = start.cloud;
    for (auto& r : turned.r) r = turn(r);
    for (auto& v : turned.v) v = turn(v);
    auto expected = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, start.cloud);
    for (auto& r : expected.r) r = turn(r);
    for (auto& v : expected.v) v = turn(v);
    const auto found = test::rates_of<TestType, double>(test::Gas<Dim>{}, turned_domain, turned);
    const auto sizes = test::reference_rates(test::ReferenceGas{}, domain, start.cloud);
    CHECK(test::largest_difference(found, expected, sizes) < rounding);
  };
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("rates belong to particles and not to their order", "[sph]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const Case<Dim> start;
    const auto order = test::Random(43).order(start.cloud.size());
    Cloud<Dim> shuffled = start.cloud;
    for (std::size_t i = 0; i < order.size(); ++i) {
      shuffled.r[i] = start.cloud.r[order[i]];
      shuffled.v[i] = start.cloud.v[order[i]];
      shuffled.rho[i] = start.cloud.rho[order[i]];
      shuffled.p[i] = start.cloud.p[order[i]];
      shuffled.h[i] = start.cloud.h[order[i]];
      shuffled.m[i] = start.cloud.m[order[i]];
    }
    const auto domain = test::cube<Dim>(start.side, true);
    const auto expected = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, start.cloud);
    const auto found = test::rates_of<TestType, double>(test::Gas<Dim>{}, domain, shuffled);
    auto sorted = found;
    for (std::size_t i = 0; i < order.size(); ++i) {
      sorted.r[order[i]] = found.r[i];
      sorted.v[order[i]] = found.v[i];
      sorted.rho[order[i]] = found.rho[i];
      sorted.e[order[i]] = found.e[i];
      sorted.h[order[i]] = found.h[i];
    }
    const auto sizes = test::reference_rates(test::ReferenceGas{}, domain, start.cloud);
    CHECK(test::largest_difference(sorted, expected, sizes) < rounding);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("forces do not depend on the observer's velocity", "[sph]",
                        test::Policies) {
  const Case<2> start;
  Cloud<2> moving = start.cloud;
  const sphmbs::Vec<2> velocity{40, -25};
  for (auto& v : moving.v) v += velocity;
  const auto domain = test::cube<2>(start.side, true);
  const auto sizes = test::reference_rates(test::ReferenceGas{}, domain, moving);
  const auto rest = test::rates_of<TestType, double>(test::Gas<2>{}, domain, start.cloud);
  auto found = test::rates_of<TestType, double>(test::Gas<2>{}, domain, moving);
  for (auto& r : found.r) r = r - velocity;
  CHECK(test::largest_difference(found, rest, sizes) < rounding);
}
