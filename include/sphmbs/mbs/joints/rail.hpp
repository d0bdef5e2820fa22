// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::joints {

/// Element with an axis that something can slide along: length, on_axis(x), and r', r'' on it.
template <class E>
concept RailElement = Part<E> && requires(const E element, double x) {
  { element.length } -> std::convertible_to<double>;
  { element.on_axis(x) } -> std::convertible_to<typename E::Material>;
  { element.shape_gradient(element.on_axis(x), 0) } -> std::same_as<Matrix<E::dim, E::dofs>>;
  { element.shape_curvature(element.on_axis(x)) } -> std::same_as<Matrix<E::dim, E::dofs>>;
};

/// A chain of elements as one line with the material arc parameter s, from 0 at its start to the
/// sum of the unstrained lengths at its end.
template <RailElement E>
class Rail {
 public:
  /// @throws InvalidInput for a chain without elements, or one that is not connected in this order.
  explicit Rail(std::vector<Placed<E>> elements) : elements_(std::move(elements)) {
    expects(!elements_.empty(), "elements of the rail", 0, "one or more");
    starts_.reserve(elements_.size());
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      expects(i == 0 || elements_[i - 1].nodes.back().offset == elements_[i].nodes.front().offset,
              "element of the rail", i, "one that begins at the node where the one before ends");
      starts_.push_back(length_);
      length_ += elements_[i].part.length;
    }
  }

  double length() const { return length_; }  ///< [m]
  /// Number of elements.
  std::size_t size() const { return elements_.size(); }
  /// Element i, counted from the start.
  const Placed<E>& element(std::size_t i) const { return elements_[i]; }
  /// s where element i begins [m].
  double start(std::size_t i) const { return starts_[i]; }

  /// The element that s is on; the first or the last one beyond the ends.
  std::size_t element_at(double s) const {
    const auto after = std::upper_bound(starts_.begin() + 1, starts_.end(), s);
    return static_cast<std::size_t>(after - starts_.begin()) - 1;
  }

  /// The point at s, and the tangent dr/ds there.
  Marker<E::dim> point(double s) const {
    const std::size_t i = element_at(s);
    return elements_[i].point(elements_[i].part.on_axis(s - starts_[i]));
  }
  /// r' at arc coordinate s [m].
  Marker<E::dim> tangent(double s) const {
    const std::size_t i = element_at(s);
    return elements_[i].gradient(elements_[i].part.on_axis(s - starts_[i]), 0);
  }

 private:
  std::vector<Placed<E>> elements_;
  std::vector<double> starts_;
  double length_ = 0;
};

}  // namespace sphmbs::mbs::joints
