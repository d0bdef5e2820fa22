// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/execution/field.hpp>
#include <sphmbs/geometry/domain.hpp>

namespace sphmbs::sph {

/// Points sorted into the cells of a grid around them, as loop bodies see them.
template <int Dim>
struct PointGridView {
  Vec<Dim> lower;         ///< of all points [m]
  Vec<Dim> upper;         ///< of all points [m]
  Vec<Dim> inverse_side;  ///< of a cell [1/m]
  int count[Dim];         ///< of cells along each axis
  /// Of each cell its first point; one more entry holds the end.
  const std::uint32_t* first;
  const Vec<Dim>* points;  ///< cell after cell, in rows along the first axis

  /// The cell along an axis for a coordinate x [m], the nearest one for places outside the grid.
  SPHMBS_INLINE int along(int axis, double x) const {
    const double s = (x - lower[axis]) * inverse_side[axis];
    const double last = count[axis] - 1;
    return static_cast<int>(s > 0 ? (s < last ? s : last) : 0);
  }

  /// Calls visit(p) for each point p less than `reach` away from x, images of x not included.
  template <class Visit>
  SPHMBS_INLINE void visit_near(const Vec<Dim>& x, double reach, const Visit& visit) const {
    int begin[3] = {0, 0, 0};
    int end[3] = {0, 0, 0};
    for (int k = 0; k < Dim; ++k) {
      if (x[k] + reach < lower[k] || x[k] - reach > upper[k]) return;
      begin[k] = along(k, x[k] - reach);
      end[k] = along(k, x[k] + reach);
    }
    for (int z = begin[2]; z <= end[2]; ++z)
      for (int y = begin[1]; y <= end[1]; ++y) {
        int row = 0;
        if constexpr (Dim > 2) row = z * count[1];
        if constexpr (Dim > 1) row = (row + y) * count[0];
        for (std::uint32_t p = first[row + begin[0]]; p < first[row + end[0] + 1]; ++p)
          if (norm2(points[p] - x) < reach * reach) visit(p);
      }
  }
};

/// A grid of points that stay, in the memory of a policy: finds the points near a particle, so that
/// one pass over particles serves all of them. A cell holds about one point.
template <int Dim, execution::ExecutionPolicy Policy>
class PointGrid {
 public:
  /// @throws InvalidInput for no points, more than 10^8 of them, or one that is not finite.
  explicit PointGrid(std::span<const Vec<Dim>> points) {
    expects(!points.empty() && points.size() <= 100'000'000, "points of a probe", points.size(),
            "between 1 and 100000000");
    view_.lower = view_.upper = points.front();
    for (const Vec<Dim>& x : points)
      for (int k = 0; k < Dim; ++k) {
        expects(std::isfinite(x[k]), "coordinate of a probe's point", x[k], "finite [m]");
        view_.lower[k] = std::min(view_.lower[k], x[k]);
        view_.upper[k] = std::max(view_.upper[k], x[k]);
      }
    choose_cells(static_cast<double>(points.size()));
    sort(points);
  }

  /// Number of points.
  std::size_t size() const { return place_.size(); }
  /// The place among the points given of each point, in the order of the cells.
  const std::vector<std::uint32_t>& place() const { return place_; }

  /// For loop bodies; valid as long as the grid.
  PointGridView<Dim> view() const {
    PointGridView<Dim> view = view_;
    view.first = first_.data();
    view.points = points_.data();
    return view;
  }

 private:
  void choose_cells(double points) {
    double longest = 0;
    for (int k = 0; k < Dim; ++k) longest = std::max(longest, view_.upper[k] - view_.lower[k]);
    double side = longest > 0 ? longest / points : 1;
    for (;; side *= 1.25) {
      double cells = 1;
      for (int k = 0; k < Dim; ++k) {
        const double along = std::floor((view_.upper[k] - view_.lower[k]) / side) + 1;
        cells *= along;
        view_.count[k] = static_cast<int>(std::min(along, 1e9));
        view_.inverse_side[k] = 1 / side;
      }
      if (cells <= std::max(1000.0, 2 * points)) return;
    }
  }

  void sort(std::span<const Vec<Dim>> points) {
    const auto cell = [&](const Vec<Dim>& x) {
      std::size_t c = 0;
      for (int k = Dim - 1; k >= 0; --k)
        c = c * static_cast<std::size_t>(view_.count[k]) +
            static_cast<std::size_t>(view_.along(k, x[k]));
      return c;
    };
    std::size_t cells = 1;
    for (const int n : view_.count) cells *= static_cast<std::size_t>(n);
    std::vector<std::uint32_t> first(cells + 1);
    for (const Vec<Dim>& x : points) ++first[cell(x) + 1];
    for (std::size_t c = 0; c < cells; ++c) first[c + 1] += first[c];
    first_ = execution::Field<std::uint32_t, Policy>(first);
    std::vector<Vec<Dim>> sorted(points.size());
    place_.resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const std::uint32_t to = first[cell(points[p])]++;
      sorted[to] = points[p];
      place_[to] = static_cast<std::uint32_t>(p);
    }
    points_ = execution::Field<Vec<Dim>, Policy>(sorted);
  }

  PointGridView<Dim> view_{};
  execution::Field<std::uint32_t, Policy> first_;
  execution::Field<Vec<Dim>, Policy> points_;
  std::vector<std::uint32_t> place_;
};

}  // namespace sphmbs::sph
