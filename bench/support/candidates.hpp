// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <sphmbs/neighbours/cell_grid.hpp>

namespace bench {

/// Pairs of particles in cells that may hold neighbours of each other: what a search by cells tests
/// for all particles together, each with itself included.
template <int Dim, class T, class Policy>
double candidates(sphmbs::particles::Particles<Dim, T, Policy>& particles,
                  const sphmbs::geometry::Domain<Dim>& domain,
                  const sphmbs::neighbours::Reach& reach) {
  using Grid = sphmbs::neighbours::CellGrid<Dim, T>;
  const Grid grid = Grid::around(particles, domain, reach);
  std::vector<T> x[Dim];
  for (int k = 0; k < Dim; ++k) {
    x[k].resize(particles.size());
    Policy::download(x[k].data(), particles.fields().r[k], particles.size() * sizeof(T));
  }
  std::vector<double> occupancy(grid.cells());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    sphmbs::Vec<Dim, T> r;
    for (int k = 0; k < Dim; ++k) r[k] = x[k][i];
    ++occupancy[grid.cell(r)];
  }
  // What each cell sees, summed over one axis after the other.
  std::vector<double> seen = occupancy;
  std::size_t stride = 1;
  for (int k = 0; k < Dim; ++k) {
    const std::size_t along = static_cast<std::size_t>(grid.count[k]);
    std::vector<double> sum(seen.size());
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const std::size_t at = c / stride % along;
      const auto span = grid.around_cell(k, static_cast<int>(at));
      for (int s = 0; s < span.cells; ++s) {
        const std::size_t other = static_cast<std::size_t>(span.begin + s) % along;
        sum[c] += seen[c - at * stride + other * stride];
      }
    }
    seen = std::move(sum);
    stride *= along;
  }
  double total = 0;
  for (std::size_t c = 0; c < seen.size(); ++c) total += occupancy[c] * seen[c];
  return total;
}

}  // namespace bench
