// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <sphmbs/geometry/facet_sight.hpp>

namespace sphmbs::geometry {

/// Facets in a tree of boxes, which finds the nearest one and adds up how often all of them wind
/// around a point, both in a time that grows with the logarithm of their number.
template <int Dim>
class FacetTree {
 public:
  /// Where the surface is nearest to a point.
  struct Nearest {
    Vec<Dim> point;     ///< of the surface [m]
    double distance2;   ///< to it, squared [m^2]
    std::size_t facet;  ///< that it lies on, for `facet`
  };

  /// @param facets  checked; those without extent, of which no direction is known, are left out
  explicit FacetTree(const Facets<Dim>& facets) {
    facets_.reserve(facets.size());
    for (std::size_t i = 0; i < facets.size(); ++i)
      if (has_extent(facets[i])) facets_.push_back(facets[i]);
    if (facets_.empty()) return;
    nodes_.reserve(facets_.size());  // about two leaves of half their size for each full leaf
    build(0, facets_.size());
  }

  /// Number of facets in the tree.
  std::size_t size() const { return facets_.size(); }
  /// Corners of a facet [m], in the order of the tree, which is not that of the facets given.
  const Facet<Dim>& facet(std::size_t i) const { return facets_[i]; }

  /// Box around all facets; of a tree that is not empty.
  const Box<Dim>& box() const { return nodes_.front().box; }

  /// The facet nearest to x, of a tree that is not empty.
  Nearest nearest(const Vec<Dim>& x) const {
    Nearest best{x, 1e300, 0};
    Pending stack[deepest];
    int waiting = 0;
    stack[waiting++] = {0, distance2(nodes_[0].box, x)};
    while (waiting > 0) {
      const Pending next = stack[--waiting];
      if (next.distance2 >= best.distance2) continue;
      const Node& node = nodes_[next.node];
      if (node.count == 0) {
        Pending near{next.node + 1, distance2(nodes_[next.node + 1].box, x)};
        Pending far{node.first, distance2(nodes_[node.first].box, x)};
        if (far.distance2 < near.distance2) std::swap(near, far);
        stack[waiting++] = far;
        stack[waiting++] = near;
        continue;
      }
      for (std::size_t i = node.first; i < node.first + node.count; ++i) {
        const Vec<Dim> point = nearest_on(facets_[i], x);
        const double d2 = norm2(x - point);
        if (d2 < best.distance2) best = {point, d2, i};
      }
    }
    return best;
  }

  /// How often the surface winds around x: 1 inside and 0 outside one that is closed. Where it has
  /// holes the number changes smoothly across them. Facets farther away than `sharpness` times the
  /// extent of their box count by their area vectors alone (Barill et al., ACM Trans. Graph. 37,
  /// 2018), which leaves an error of some hundredths; with infinity there is none.
  double winding(const Vec<Dim>& x, double sharpness = 2.5) const {
    double sum = 0;
    std::uint32_t stack[deepest];
    int waiting = 0;
    if (!nodes_.empty()) stack[waiting++] = 0;
    while (waiting > 0) {
      const std::uint32_t number = stack[--waiting];
      const Node& node = nodes_[number];
      const Vec<Dim> to = node.centre - x;
      if (norm2(to) > sharpness * sharpness * node.radius2) {
        sum += distant_share(node.area, to);
      } else if (node.count == 0) {
        stack[waiting++] = node.first;
        stack[waiting++] = number + 1;
      } else {
        for (std::size_t i = node.first; i < node.first + node.count; ++i)
          sum += share_of_view(facets_[i], x);
      }
    }
    return sum;
  }

 private:
  struct Node {
    Box<Dim> box;
    Vec<Dim> centre;      // of the facets, by their sizes [m]
    Vec<Dim> area;        // sum of their area vectors
    double radius2;       // of the ball around `centre` that holds them, squared [m^2]
    std::uint32_t first;  // facet of a leaf, else the second child; the first child comes next
    std::uint32_t count;  // facets of a leaf, else 0
  };
  struct Pending {
    std::uint32_t node;
    double distance2;
  };
  static constexpr std::size_t leaf = 4;
  static constexpr int deepest = 64;  // each level halves up to 2^32 facets and leaves one waiting

  static double distance2(const Box<Dim>& box, const Vec<Dim>& x) {
    double sum = 0;
    for (int k = 0; k < Dim; ++k) {
      const double d = std::max({box.lower[k] - x[k], x[k] - box.upper[k], 0.0});
      sum += d * d;
    }
    return sum;
  }

  static bool has_extent(const Facet<Dim>& f) {
    double longest2 = 0;
    for (std::size_t k = 0; k < Dim; ++k)
      longest2 = std::max(longest2, norm2(f[(k + 1) % Dim] - f[k]));
    const double size = std::sqrt(norm2(area_vector<Dim>(f)));
    return Dim == 2 ? size > 0 : size > 1e-10 * longest2;
  }

  std::uint32_t build(std::size_t from, std::size_t to) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(summary(from, to));
    if (to - from <= leaf) {
      nodes_[number].first = static_cast<std::uint32_t>(from);
      nodes_[number].count = static_cast<std::uint32_t>(to - from);
      return number;
    }
    const Box<Dim> box = nodes_[number].box;
    int axis = 0;
    for (int k = 1; k < Dim; ++k)
      if (box.length(k) > box.length(axis)) axis = k;
    const std::size_t middle = from + (to - from) / 2;
    const auto at = [this](std::size_t i) {
      return facets_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(from), at(middle), at(to),
                     [axis](const Facet<Dim>& a, const Facet<Dim>& b) {
                       return centre<Dim>(a)[axis] < centre<Dim>(b)[axis];
                     });
    build(from, middle);
    nodes_[number].first = build(middle, to);
    nodes_[number].count = 0;
    return number;
  }

  Node summary(std::size_t from, std::size_t to) const {
    const Vec<Dim> start = facets_[from][0];
    Node node{{start, start}, Vec<Dim>::all(0.0), Vec<Dim>::all(0.0), 0, 0, 0};
    double weights = 0;
    for (std::size_t i = from; i < to; ++i) {
      const Facet<Dim>& f = facets_[i];
      for (const Vec<Dim>& x : f)
        for (int k = 0; k < Dim; ++k) {
          node.box.lower[k] = std::min(node.box.lower[k], x[k]);
          node.box.upper[k] = std::max(node.box.upper[k], x[k]);
        }
      const Vec<Dim> area = area_vector<Dim>(f);
      const double weight = std::sqrt(norm2(area));
      node.area += area;
      node.centre += weight * (centre<Dim>(f) - start);
      weights += weight;
    }
    node.centre = start + (1 / weights) * node.centre;
    for (std::size_t i = from; i < to; ++i)
      for (const Vec<Dim>& x : facets_[i])
        node.radius2 = std::max(node.radius2, norm2(x - node.centre));
    return node;
  }

  std::vector<Facet<Dim>> facets_;  // those of a node side by side
  std::vector<Node> nodes_;
};

}  // namespace sphmbs::geometry
