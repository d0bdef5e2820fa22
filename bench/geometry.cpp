// SPDX-License-Identifier: MIT
// Solids within triangles: building their tree, and distances from it.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <sphmbs/core/math.hpp>
#include <sphmbs/geometry/faceted.hpp>

#include "support/registry.hpp"

using namespace sphmbs;

namespace {

/// A torus of 4 n^2 triangles, 2.8 m across.
geometry::Facets<3> torus(int n) {
  geometry::Facets<3> facets;
  const int around = 2 * n;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = 2 * math::pi * i / around, b = 2 * math::pi * j / n;
      const double r = 1 + 0.4 * std::cos(b);
      facets.points.push_back({r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
      const auto number = [&](int k, int l) {
        return static_cast<std::uint32_t>((k % around) * n + l % n);
      };
      facets.corners.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      facets.corners.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return facets;
}

/// Points in the order in which a lattice is filled.
std::vector<Vec<3>> lattice(double reach, int n) {
  std::vector<Vec<3>> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        points.push_back(
            {reach * (2.0 * i / n - 1), reach * (2.0 * j / n - 1), reach * (2.0 * k / n - 1)});
  return points;
}

template <class Query>
void query(benchmark::State& state, int n, double reach, Query&& what) {
  const geometry::TriangleMesh mesh(torus(n));
  const auto points = lattice(reach, 20);
  for (auto _ : state)
    for (const Vec<3>& x : points) benchmark::DoNotOptimize(what(mesh, x));
  state.counters["queries/s"] = bench::per_second(static_cast<double>(points.size()));
}

[[maybe_unused]] const bool registered = [] {
  for (const int n : {16, 50, 158}) {
    const std::string size = std::to_string(4 * n * n);
    bench::add("geometry/build/" + size, 1, [n](benchmark::State& state) {
      const auto facets = torus(n);
      for (auto _ : state) benchmark::DoNotOptimize(geometry::TriangleMesh(facets));
      state.counters["triangles/s"] = bench::per_second(static_cast<double>(facets.size()));
    });
    // 1.4 m is the box of the torus, 4 m a domain around it.
    for (const double reach : {1.4, 4.0}) {
      const std::string where = reach < 2 ? "/near" : "/around";
      bench::add("geometry/distance/" + size + where, 1, [=](benchmark::State& state) {
        query(state, n, reach, [](const auto& mesh, const auto& x) { return mesh.distance(x); });
      });
      bench::add("geometry/nearest/" + size + where, 1, [=](benchmark::State& state) {
        query(state, n, reach, [](const auto& mesh, const auto& x) { return mesh.nearest(x); });
      });
      bench::add("geometry/winding/" + size + where, 1, [=](benchmark::State& state) {
        query(state, n, reach, [](const auto& mesh, const auto& x) { return mesh.winding(x); });
      });
    }
  }
  return true;
}();

}  // namespace
