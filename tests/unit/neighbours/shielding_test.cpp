// SPDX-License-Identifier: MIT
// Thin bodies: who sees whom past them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <sphmbs/neighbours/cell_list.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/on_host.hpp"
#include "support/policies.hpp"

namespace {

using sphmbs::Vec;

constexpr double spacing = 0.1;
constexpr double reach = 3 * 1.25 * spacing;

template <int Dim>
double length(const Vec<Dim>& x) {
  return std::sqrt(norm2(x));
}

/// A square or cube of gas with a sheet at height 1 over a part of it.
template <int Dim>
struct Case {
  sphmbs::particles::Cloud<Dim> cloud;
  std::size_t gas = 0;
  sphmbs::geometry::Domain<Dim> domain = test::cube<Dim>(Dim == 2 ? 2.0 : 1.2, false);

  explicit Case(bool periodic) {
    domain.periodic.fill(periodic);
    const int n = Dim == 2 ? 20 : 12;
    cloud.add_gas(test::cell_centres<Dim>(n, spacing), test::still_air<Dim>(),
                  {.spacing = spacing});
    test::disturb(cloud, spacing, 91, {.smoothing = 0, .mass = 0});
    gas = cloud.size();
    std::vector<Vec<Dim>> patches;
    for (const auto& x : test::cell_centres<Dim>(n, spacing)) {
      if (std::abs(x[Dim - 1] - 0.55) > 0.01) continue;
      bool inside = true;
      for (int k = 0; k < Dim - 1; ++k) inside = inside && x[k] > 0.3 && x[k] < 0.9;
      Vec<Dim> centre = x;
      centre[Dim - 1] = 0.6;
      if (inside) patches.push_back(centre);
    }
    Vec<Dim> up = Vec<Dim>::all(0.0);
    up[Dim - 1] = 1;
    cloud.add_sheet(patches, std::vector<Vec<Dim>>(patches.size(), up), test::still_air<Dim>(),
                    {.spacing = spacing});
  }

  /// Whether the straight way between two points crosses the sheet, whose patches are squares, or
  /// comes so near to its rim.
  bool crosses(const Vec<Dim>& a, const Vec<Dim>& b, double rim = 0) const {
    const double start = a[Dim - 1] - 0.6;
    const double end = b[Dim - 1] - 0.6;
    if (start * end >= 0) return false;
    const Vec<Dim> x = a + (start / (start - end)) * (b - a);
    for (int k = 0; k < Dim - 1; ++k)
      if (x[k] < 0.3 - rim || x[k] > 0.9 + rim) return false;
    return true;
  }
};

/// Ordered pairs by id that are listed.
template <int Dim, class Policy>
std::set<std::pair<std::uint32_t, std::uint32_t>> listed(const Case<Dim>& c) {
  sphmbs::particles::Particles<Dim, double, Policy> particles(c.cloud,
                                                              [](double, double) { return 1.0; });
  sphmbs::neighbours::CellList<Dim, double, Policy> search;
  search.rebuild(particles, c.domain, {.support = 3, .skin = 0, .h_max = 1.25 * spacing});
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  test::for_listed<Policy>(search.view(), particles.fields().id, particles.size(),
                           [&](std::uint32_t a, std::uint32_t b) {
                             pairs.insert({a, b});
                           });
  return pairs;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("gas does not see gas through a thin body", "[neighbours]",
                        test::Policies) {
  const Case<2> c(false);
  const auto pairs = listed<2, TestType>(c);
  std::size_t hidden = 0;
  for (std::uint32_t a = 0; a < c.gas; ++a)
    for (std::uint32_t b = 0; b < c.gas; ++b) {
      if (a == b || length(c.cloud.r[a] - c.cloud.r[b]) >= reach) continue;
      const bool crosses = c.crosses(c.cloud.r[a], c.cloud.r[b]);
      hidden += crosses ? 1 : 0;
      if (crosses != c.crosses(c.cloud.r[a], c.cloud.r[b], 0.03 * spacing)) continue;
      REQUIRE(pairs.count({a, b}) == (crosses ? 0 : 1));
    }
  CHECK(hidden > 100);
}

TEMPLATE_LIST_TEST_CASE("in space no way through a sheet is left and only its rim is wider",
                        "[neighbours]", test::Policies) {
  const Case<3> c(false);
  const auto pairs = listed<3, TestType>(c);
  std::size_t hidden = 0, wrongly = 0;
  for (std::uint32_t a = 0; a < c.gas; ++a)
    for (std::uint32_t b = 0; b < c.gas; ++b) {
      if (a == b || length(c.cloud.r[a] - c.cloud.r[b]) >= reach) continue;
      const bool crosses = c.crosses(c.cloud.r[a], c.cloud.r[b]);
      const bool seen = pairs.count({a, b}) == 1;
      if (crosses) {
        ++hidden;
        REQUIRE(!seen);
      } else if (!seen) {
        ++wrongly;
      }
    }
  CHECK(hidden > 1000);
  CHECK(wrongly < hidden / 4);
}

TEMPLATE_LIST_TEST_CASE("gas sees the layers of its own side alone, and pairs see each other",
                        "[neighbours]", test::Policies) {
  for (const bool periodic : {false, true}) {
    const Case<2> c(periodic);
    const auto pairs = listed<2, TestType>(c);
    std::size_t seen = 0;
    for (const auto& [a, b] : pairs) {
      REQUIRE(pairs.count({b, a}) == 1);
      if (a >= c.gas || b < c.gas) continue;
      const bool front = c.cloud.normal[b][1] > 0;
      // Without a wrap, since the sheet is far from the border along y.
      REQUIRE(front == (c.cloud.r[a][1] > 0.6));
      ++seen;
    }
    CHECK(seen > 100);
    for (const auto& [a, b] : pairs)
      if (a >= c.gas && b >= c.gas) REQUIRE(c.cloud.set[a] == c.cloud.set[b]);
  }
}

TEMPLATE_LIST_TEST_CASE("layers behind a thin body are seen where it hides the gas there",
                        "[neighbours]", test::Policies) {
  const Case<2> c(false);
  const auto pairs = listed<2, TestType>(c);
  std::size_t through = 0, past = 0;
  for (std::uint32_t a = 0; a < c.gas; ++a)
    for (auto b = static_cast<std::uint32_t>(c.gas); b < c.cloud.size(); ++b) {
      const Vec<2>&x = c.cloud.r[a], &y = c.cloud.r[b];
      const bool own_side = (c.cloud.normal[b][1] > 0) == (x[1] > 0.6);
      if (length(x - y) >= reach || !own_side || c.cloud.depth[b] == 0) continue;
      const bool crosses = c.crosses(x, y);
      if (crosses != c.crosses(x, y, 0.03 * spacing)) continue;
      (crosses ? through : past) += 1;
      REQUIRE(pairs.count({a, b}) == (crosses ? 1 : 0));
    }
  CHECK(through > 100);
  CHECK(past > 10);
}

TEST_CASE("a thin body on a line hides one side from the other", "[neighbours]") {
  test::Random random(92);
  for (int i = 0; i < 50; ++i) {
    sphmbs::particles::Cloud<1> cloud;
    std::vector<Vec<1>> gas;
    for (int k = 0; k < 20; ++k)
      if (k != 10) gas.push_back({(k + random.between(-0.3, 0.3)) * spacing});
    cloud.add_gas(gas, test::still_air<1>(), {.spacing = spacing});
    const double at = 1 + random.between(-0.01, 0.01);
    cloud.add_sheet({Vec<1>{at}}, {Vec<1>{1.0}}, test::still_air<1>(), {.spacing = spacing});
    sphmbs::particles::Particles<1, double, sphmbs::execution::Serial> particles(
        cloud, [](double, double) { return 1.0; });
    sphmbs::neighbours::CellList<1, double, sphmbs::execution::Serial> search;
    search.rebuild(particles, test::cube<1>(2, false),
                   {.support = 3, .skin = 0, .h_max = 1.25 * spacing});
    const auto f = particles.fields();
    const auto view = search.view();
    for (std::size_t a = 0; a < particles.size(); ++a)
      for (auto k = view.first[a]; k < view.last[a]; ++k) {
        const std::uint32_t b = view.list[k];
        if (f.set[a] == sphmbs::particles::gas && f.set[b] == sphmbs::particles::gas)
          REQUIRE((f.r[0][a] > at) == (f.r[0][b] > at));
      }
  }
}

TEST_CASE("a curved thin body has no slits, however its density may evolve", "[neighbours]") {
  // A ring of radius three spacings; the density of its patches is twice the initial one.
  constexpr double radius = 3 * spacing;
  std::vector<Vec<2>> patches, normals;
  const int n = static_cast<int>(std::ceil(2 * sphmbs::math::pi * radius / spacing));
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * sphmbs::math::pi * i / n;
    normals.push_back({std::cos(angle), std::sin(angle)});
    patches.push_back({1 + radius * std::cos(angle), 1 + radius * std::sin(angle)});
  }
  sphmbs::particles::Cloud<2> cloud;
  std::vector<Vec<2>> gas;
  for (const auto& x : test::cell_centres<2>(20, spacing))
    if (std::abs(length(x - Vec<2>{1, 1}) - radius) > spacing / 2) gas.push_back(x);
  cloud.add_gas(gas, test::still_air<2>(), {.spacing = spacing});
  test::disturb(cloud, spacing, 93, {.place = 0.4, .smoothing = 0, .mass = 0});
  cloud.add_sheet(patches, normals, test::still_air<2>(), {.spacing = spacing});
  sphmbs::particles::Particles<2, double, sphmbs::execution::Serial> particles(
      cloud, [](double, double) { return 1.0; });
  auto f = particles.fields();
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (f.set[i] != sphmbs::particles::gas) f.rho[i] *= 2;
  sphmbs::neighbours::CellList<2, double, sphmbs::execution::Serial> search;
  search.rebuild(particles, test::cube<2>(2, false),
                 {.support = 3, .skin = 0, .h_max = 1.25 * spacing});
  f = particles.fields();
  const auto view = search.view();
  const auto out = [&](std::size_t i) {
    return length(Vec<2>{f.r[0][i] - 1, f.r[1][i] - 1}) / radius - 1;
  };
  const double sagitta = 0.06;  // chords of patches lie inside the ring
  for (std::size_t a = 0; a < particles.size(); ++a)
    for (auto k = view.first[a]; k < view.last[a]; ++k) {
      const std::uint32_t b = view.list[k];
      if (f.set[a] != sphmbs::particles::gas || f.set[b] != sphmbs::particles::gas) continue;
      if (out(a) > sagitta) REQUIRE(out(b) > -sagitta);
    }
}

TEST_CASE("sheets that make no sense are refused", "[particles]") {
  sphmbs::particles::Cloud<2> cloud;
  const auto air = test::still_air<2>();
  CHECK_THROWS_WITH(cloud.add_sheet({{0, 0}}, {}, air, {.spacing = 1}), Catch::Contains("normals"));
  CHECK_THROWS_WITH(cloud.add_sheet({{0, 0}}, {{0, 2}}, air, {.spacing = 1}),
                    Catch::Contains("length of a sheet's normal = 2"));
  CHECK_THROWS_WITH(cloud.add_sheet({{0, 0}}, {{0, 1}}, air, {.spacing = 1}, 0),
                    Catch::Contains("layers of a sheet = 0"));
}
