// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/marker.hpp>
#include <sphmbs/mbs/part.hpp>

namespace sphmbs::mbs {

/// Where the coordinates of a node begin in q, and how many there are.
struct Node {
  int offset;  ///< of its first coordinate among those of the structure
  int size;    ///< number of its coordinates
};

namespace detail {

/// Of the matrix N, which gives the place from the coordinates `own` of a part. Coordinates that do
/// not move the marker are left out: those of the other nodes, at a node.
/// @throws InvalidInput for a point that is not finite.
template <int Dim>
Marker<Dim> marker(const double* N, const Index& own, std::string_view label, int number) {
  constexpr double nothing = 1e-14;
  const auto largest = [](const double* begin, std::size_t n) {
    double most = 0;
    for (std::size_t k = 0; k < n; ++k) most = std::max(most, std::abs(begin[k]));
    return most;
  };
  const std::size_t numbers = Dim * own.size();
  expects(std::all_of(N, N + numbers, [](double x) { return std::isfinite(x); }),
          std::string(label) + " " + std::to_string(number) + ": a material point", "not finite",
          "finite [m]");
  const double size = largest(N, numbers);
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (largest(N + Dim * k, Dim) > nothing * size) kept.push_back(k);
  Marker<Dim> m;
  m.N.resize(Dim, static_cast<int>(kept.size()));
  for (const std::size_t k : kept) {
    std::copy_n(N + Dim * k, Dim, m.N.data() + Dim * m.index.size());
    m.index.push_back(own[k]);
  }
  return m;
}

}  // namespace detail

/// A part in its place in a structure: which coordinates are its own. It gives the markers that
/// joints, loads and sensors are made of.
template <Part P>
struct Placed {
  P part;                            ///< a copy of what was added
  std::array<Node, P::nodes> nodes;  ///< that carry its coordinates
  int number;                        ///< among the parts of this type, from 0

  /// Its coordinates, node by node.
  Index index() const {
    Index all;
    all.reserve(P::dofs);
    for (const Node& node : nodes)
      for (int k = 0; k < node.size; ++k) all.push_back(node.offset + k);
    return all;
  }

  /// Own coordinates, out of all coordinates q of the structure.
  Vector<P::dofs> local(VectorIn q) const {
    Vector<P::dofs> own;
    int k = 0;
    for (const Node& node : nodes)
      for (int i = 0; i < P::node_dofs; ++i) own[k++] = q[node.offset + i];
    return own;
  }

  /// The material point X.
  Marker<P::dim> point(const typename P::Material& X) const { return marker(part.shape(X)); }

  /// The material vector from `from` to `to`: of a rigid body, a direction fixed to it.
  Marker<P::dim> vector(const typename P::Material& from, const typename P::Material& to) const {
    return marker(part.shape(to) - part.shape(from));
  }

  /// The gradient dr/dX_k at X: of a cable, the tangent; of a plate, a vector along a material
  /// line.
  Marker<P::dim> gradient(const typename P::Material& X, int k) const requires requires(const P p) {
    p.shape_gradient(X, k);
  }
  { return marker(part.shape_gradient(X, k)); }

  /// d2r/dXdY of a plate at X. Those of 48 coordinates have it at their nodes, where a clamp holds
  /// it beside both gradients.
  Marker<P::dim> twist(const typename P::Material& X) const requires requires(const P p) {
    p.shape_twist(X);
  }
  { return marker(part.shape_twist(X)); }

  /// Point at the first end, where the part has one.
  Marker<P::dim> start() const requires requires(const P p) { p.start(); }
  { return point(part.start()); }
  /// Point at the second end, where the part has one.
  Marker<P::dim> end() const requires requires(const P p) { p.end(); }
  { return point(part.end()); }

 private:
  Marker<P::dim> marker(const Matrix<P::dim, P::dofs>& N) const {
    return detail::marker<P::dim>(N.data(), index(), P::label, number);
  }
};

/// Momentum of a part whose structure has rates v [kg m/s]; of accelerations, the sum of all forces
/// on it [N].
template <Part P>
Vector<P::dim> momentum(const Placed<P>& placed, VectorIn v) {
  return P::translation().transpose() * (placed.part.mass_matrix() * placed.local(v));
}

}  // namespace sphmbs::mbs
