// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/neighbours/neighbour_search.hpp>

namespace sphmbs::neighbours {

/// Tests all pairs on the host: the reference for other searches, in O(n^2).
template <int Dim, class T, execution::ExecutionPolicy Policy>
class BruteForce {
 public:
  /// Lists the neighbours of each particle in ascending order; the particles stay where they are.
  /// @throws InvalidInput if a periodic axis is shorter than two supports.
  void rebuild(particles::Particles<Dim, T, Policy>& particles, const geometry::Domain<Dim>& domain,
               const Reach& reach) {
    check_reach(domain, reach);
    const std::size_t n = particles.size();
    std::vector<T> coordinate[Dim];
    for (int k = 0; k < Dim; ++k) coordinate[k] = copy(particles.fields().r[k], n);
    const std::vector<T> h = copy(particles.fields().h, n);
    const auto space = domain.template periodicity<T>();
    std::vector<std::uint64_t> first{0};
    std::vector<std::uint32_t> list;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        Vec<Dim, T> d;
        for (int k = 0; k < Dim; ++k) d[k] = coordinate[k][b] - coordinate[k][a];
        d = space.nearest(d);
        const T limit =
            static_cast<T>(reach.support / 2) * (h[a] + h[b]) + static_cast<T>(reach.skin);
        if (b != a && norm2(d) < limit * limit) list.push_back(static_cast<std::uint32_t>(b));
      }
      first.push_back(list.size());
    }
    first_ = execution::Field<std::uint64_t, Policy>(first);
    list_ = execution::Field<std::uint32_t, Policy>(list);
  }

  /// The lists, for loops.
  NeighbourView view() const { return {first_.data(), first_.data() + 1, list_.data()}; }

  /// Memory held [bytes].
  std::size_t bytes() const { return first_.bytes() + list_.bytes(); }

 private:
  static std::vector<T> copy(const T* field, std::size_t n) {
    std::vector<T> host(n);
    Policy::download(host.data(), field, n * sizeof(T));
    return host;
  }

  execution::Field<std::uint64_t, Policy> first_;
  execution::Field<std::uint32_t, Policy> list_;
};

}  // namespace sphmbs::neighbours
