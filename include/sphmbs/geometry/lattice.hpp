// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/geometry/shape.hpp>

namespace sphmbs::geometry {

/// A plain lattice, the paper's initial arrangement: the points origin + i spacing.
template <int Dim>
struct Lattice {
  double spacing;        ///< [m]
  Vec<Dim> origin = {};  ///< any lattice point [m]

  /// Points on a surface are told from points beside it within this share of the spacing.
  static constexpr double tolerance = 1e-6;

  /// Lattice points of the shape, its surface included, in lexicographic order (last axis
  /// fastest).
  /// @param shape   what to fill
  /// @param domain  along periodic axes only one period is filled
  /// @param margin  how far beyond the domain's box the other axes are searched [m]
  /// @throws InvalidInput if the spacing is not positive, does not divide a periodic length, or is
  ///         too small for 32-bit particle numbers, or if the domain's box is empty or not finite.
  template <Shape S>
  std::vector<Vec<Dim>> points(const S& shape, const Domain<Dim>& domain, double margin = 0) const {
    return collect(shape, domain, margin, tolerance * spacing);
  }

  /// As `points`, without those on the surface.
  template <Shape S>
  std::vector<Vec<Dim>> inner_points(const S& shape, const Domain<Dim>& domain,
                                     double margin = 0) const {
    return collect(shape, domain, margin, -tolerance * spacing);
  }

  /// @throws InvalidInput as `points` says.
  void check(const Domain<Dim>& domain) const {
    expects(std::isfinite(spacing) && spacing > 0, "spacing", spacing, "positive [m]");
    domain.check();
    double count = 1;
    for (int k = 0; k < Dim; ++k) count *= domain.box.length(k) / spacing;
    expects(count < 4294967295.0, "spacing", spacing,
            "wide enough for fewer than 2^32 particles in the domain");
    for (int k = 0; k < Dim; ++k) {
      if (!domain.periodic[static_cast<std::size_t>(k)]) continue;
      const double intervals = domain.box.length(k) / spacing;
      expects(
          std::abs(intervals - std::round(intervals)) < 1e-6 * intervals, "spacing", spacing,
          "a whole fraction of the periodic length " + std::to_string(domain.box.length(k)) + " m");
    }
  }

 private:
  template <Shape S>
  std::vector<Vec<Dim>> collect(const S& shape, const Domain<Dim>& domain, double margin,
                                double surface) const {
    check(domain);
    long first[3] = {0, 0, 0};
    long last[3] = {0, 0, 0};
    for (int k = 0; k < Dim; ++k) {
      const double from = (domain.box.lower[k] - origin[k]) / spacing;
      const double to = (domain.box.upper[k] - origin[k]) / spacing;
      const bool periodic = domain.periodic[static_cast<std::size_t>(k)];
      const double beyond = periodic ? 0 : margin / spacing;
      first[k] = std::lround(std::ceil(from - beyond - tolerance));
      last[k] = periodic ? first[k] + std::lround(to - from) - 1
                         : std::lround(std::floor(to + beyond + tolerance));
    }
    std::vector<Vec<Dim>> found;
    for (long i = first[0]; i <= last[0]; ++i)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long k = first[2]; k <= last[2]; ++k) {
          const long index[3] = {i, j, k};
          Vec<Dim> x;
          for (int axis = 0; axis < Dim; ++axis)
            x[axis] = origin[axis] + static_cast<double>(index[axis]) * spacing;
          if (shape.distance(x) <= surface) found.push_back(x);
        }
    return found;
  }
};

}  // namespace sphmbs::geometry
