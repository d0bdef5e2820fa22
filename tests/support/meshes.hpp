// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include <sphmbs/core/math.hpp>
#include <sphmbs/geometry/facets.hpp>

#include "support/random.hpp"

namespace test {

using Triangles = sphmbs::geometry::Facets<3>;

/// Triangles on a grid of n x m points of a surface that closes on itself both ways.
template <class Surface>
Triangles closed_grid(int n, int m, Surface&& at) {
  Triangles t;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      t.points.push_back(at(static_cast<double>(i) / n, static_cast<double>(j) / m));
  const auto number = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      t.corners.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      t.corners.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return t;
}

/// A torus around the z axis: 2 n m triangles.
inline Triangles torus(int n, int m, double ring, double tube) {
  return closed_grid(n, m, [=](double u, double v) {
    const double a = 2 * sphmbs::math::pi * u, b = 2 * sphmbs::math::pi * v;
    const double r = ring + tube * std::cos(b);
    return sphmbs::Vec<3>{r * std::cos(a), r * std::sin(a), tube * std::sin(b)};
  });
}

/// The faces of a box of two corners: twelve triangles.
inline Triangles box(const sphmbs::Vec<3>& lower, const sphmbs::Vec<3>& upper) {
  Triangles t;
  for (int corner = 0; corner < 8; ++corner) {
    sphmbs::Vec<3> x;
    for (int k = 0; k < 3; ++k) x[k] = ((corner >> k) & 1) != 0 ? upper[k] : lower[k];
    t.points.push_back(x);
  }
  t.corners = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return t;
}

/// A sphere: the faces of a cube in n x n squares each, blown up; 12 n^2 triangles, whose corners
/// lie on the sphere.
inline Triangles sphere(int n, double radius, const sphmbs::Vec<3>& centre = {0, 0, 0}) {
  Triangles t;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double side = face % 2 == 0 ? -1 : 1;
    const auto first = static_cast<std::uint32_t>(t.points.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        // Squares of equal angle; written so that faces have equal points on common edges.
        const auto spread = [n](int k) {
          return k == 0 ? -1.0 : k == n ? 1.0 : std::tan(sphmbs::math::pi / 4 * (2 * k - n) / n);
        };
        sphmbs::Vec<3> x;
        x[axis] = side;
        x[(axis + 1) % 3] = spread(i);
        x[(axis + 2) % 3] = spread(j);
        const double a = x[0] * x[0], b = x[1] * x[1], c = x[2] * x[2];
        const double low = std::fmin(a, std::fmin(b, c)), high = std::fmax(a, std::fmax(b, c));
        const double middle = std::fmax(std::fmin(a, b), std::fmin(std::fmax(a, b), c));
        t.points.push_back(centre + (radius / std::sqrt(low + middle + high)) * x);
      }
    const auto number = [&](int i, int j) {
      return first + static_cast<std::uint32_t>(i * (n + 1) + j);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const std::uint32_t a = number(i, j), b = number(i + 1, j), c = number(i + 1, j + 1),
                            d = number(i, j + 1);
        if (side > 0) {
          t.corners.push_back({a, b, c});
          t.corners.push_back({a, c, d});
        } else {
          t.corners.push_back({a, c, b});
          t.corners.push_back({a, d, c});
        }
      }
  }
  return sphmbs::geometry::welded(t);
}

/// The triangles without a random share of them.
inline Triangles without(Triangles t, double share, std::uint64_t seed) {
  Random random(seed);
  std::erase_if(t.corners, [&](const auto&) { return random.unit() < share; });
  return t;
}

/// The triangles as a binary STL file, whose numbers are floats.
inline std::string binary_stl(const Triangles& t, const std::string& title = "sphmbs") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  const auto put = [&](std::uint32_t value) {
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k));
  };
  put(static_cast<std::uint32_t>(t.size()));
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (int k = 0; k < 3; ++k) put(0);
    for (const auto& x : t[i])
      for (int k = 0; k < 3; ++k) put(std::bit_cast<std::uint32_t>(static_cast<float>(x[k])));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/// The same as text, with every digit.
inline std::string text_stl(const Triangles& t) {
  std::string text = "solid of triangles\n";
  for (std::size_t i = 0; i < t.size(); ++i) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const auto& x : t[i]) {
      char line[120];
      std::snprintf(line, sizeof line, "  vertex %.17g %.17g %.17g\n", x[0], x[1], x[2]);
      text += line;
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid of triangles\n";
}

}  // namespace test
