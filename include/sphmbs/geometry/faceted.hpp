// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include <sphmbs/core/error.hpp>
#include <sphmbs/geometry/facet_tree.hpp>
#include <sphmbs/geometry/shape.hpp>

namespace sphmbs::geometry {

/// What is inside where a surface winds around a point more than once.
enum class Fill {
  any,  ///< all that it winds around: solids that overlap are one
  odd   ///< what it winds around an odd number of times: an outline within another one is a hole,
        ///< whichever way round it goes
};

/// Solid within facets: a polygon with holes, a body from an STL file. Its distance is exact.
/// Inside is where the surface winds around a point, rounded to whole numbers, so that holes of the
/// surface do harm to nothing but their vicinity, and that it may be inside out. Copies share the
/// facets.
template <int Dim>
class Faceted {
 public:
  static constexpr int dim = Dim;  ///< dimension of space

  /// @throws InvalidInput for facets that are not finite, or none that has an extent.
  explicit Faceted(const Facets<Dim>& facets, Fill fill = Dim == 2 ? Fill::odd : Fill::any)
      : tree_(grown(facets)), fill_(fill) {}

  /// Negative inside [m].
  double distance(const Vec<Dim>& x) const {
    const double d = std::sqrt(tree_->nearest(x).distance2);
    return inside(x) ? -d : d;
  }

  /// Whether the surface winds around x, counted as `Fill` says.
  bool inside(const Vec<Dim>& x) const {
    for (int k = 0; k < Dim; ++k)
      if (!(x[k] >= box().lower[k] && x[k] <= box().upper[k])) return false;
    const double times = std::abs(winding(x));
    return fill_ == Fill::any ? times > 0.5 : std::fmod(std::round(times), 2) == 1;
  }

  /// Slope of the distance, a unit vector; on the surface that of the facet, and where several
  /// points of the surface are as near that of one of them.
  Vec<Dim> normal(const Vec<Dim>& x) const {
    const auto nearest = tree_->nearest(x);
    const Vec<Dim> off = x - nearest.point;
    const double d = std::sqrt(nearest.distance2), size = extent();
    if (d > 1e-9 * size) return ((inside(x) ? -1 : 1) / d) * off;
    const Vec<Dim> area = area_vector<Dim>(tree_->facet(nearest.facet));
    const Vec<Dim> n = (1 / std::sqrt(norm2(area))) * area;
    return inside(nearest.point + (1e-7 * size) * n) ? -1.0 * n : n;
  }

  /// The point of the surface nearest to x [m].
  Vec<Dim> nearest(const Vec<Dim>& x) const { return tree_->nearest(x).point; }

  /// How often the surface winds around x; without holes a whole number but for some hundredths.
  double winding(const Vec<Dim>& x) const { return tree_->winding(x); }

  /// The smallest box around the surface [m].
  const Box<Dim>& box() const { return tree_->box(); }

 private:
  static std::shared_ptr<const FacetTree<Dim>> grown(const Facets<Dim>& facets) {
    facets.check();
    auto tree = std::make_shared<const FacetTree<Dim>>(facets);
    if (tree->size() == 0)
      throw InvalidInput("surface of " + std::to_string(facets.size()) +
                             " facets: must have at least one that is larger than nothing",
                         "E155");
    return tree;
  }

  double extent() const { return std::sqrt(norm2(box().upper - box().lower)); }

  std::shared_ptr<const FacetTree<Dim>> tree_;
  Fill fill_;
};

static_assert(Shape<Faceted<2>> && Shape<Faceted<3>>);

/// A plane figure within outlines.
using Outline = Faceted<2>;
/// A body within triangles.
using TriangleMesh = Faceted<3>;

}  // namespace sphmbs::geometry
