// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include <sphmbs/coupling/wetted_point.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/quarter_turn.hpp>

namespace sphmbs::coupling {

/// Where on a plane line the point is that is nearest to x, from 0 to its length [m].
template <class Element>
double nearest_on(const mbs::ancf::Line<Element>& line, const mbs::VectorXd& q,
                  const mbs::Vector<2>& x) {
  const int pieces = 4 * static_cast<int>(line.elements.size());
  const auto at = [&](int piece) {
    return std::min(line.length, line.length * std::max(piece, 0) / pieces);
  };
  const auto distance = [&](int piece) { return (line.point(at(piece)).at(q) - x).norm(); };
  int nearest = 0;
  for (int k = 1; k <= pieces; ++k)
    if (distance(k) < distance(nearest)) nearest = k;
  // Bisection: before the nearest point the line leads towards x, beyond it away.
  double low = at(nearest - 1), high = at(nearest + 1);
  for (int k = 0; k < 50; ++k) {
    const double s = 0.5 * (low + high);
    const bool ahead = line.gradient(s).at(q).dot(line.point(s).at(q) - x) > 0;
    (ahead ? high : low) = s;
  }
  return 0.5 * (low + high);
}

/// The points of a plane line of cables or beams that a set's particles ride on: each at its
/// distance from the line, along the line's normal on the side that the cloud's normal is on. A
/// particle without a normal rides on the line itself.
/// @param q  coordinates of the structure
template <class Element>
requires(Element::dim ==
         2) std::vector<WettedPoint<2>> points_of(const mbs::ancf::Line<Element>& line,
                                                  const mbs::VectorXd& q,
                                                  const particles::Cloud<2>& cloud, int set) {
  std::vector<WettedPoint<2>> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != set) continue;
    const mbs::Vector<2> x = in_space<2>(cloud.r[i]);
    const double s = nearest_on(line, q, x);
    WettedPoint<2> point{.at = line.point(s)};
    if (norm2(cloud.normal[i]) > 0) {
      point.normal = line.gradient(s);
      const mbs::Vector<2> left = mbs::quarter_turn(point.normal.at(q));
      const double side = left.dot(in_space<2>(cloud.normal[i])) > 0 ? 1 : -1;
      point.normal.N = side * mbs::quarter_turn() * point.normal.N;
      point.normal.x0 = side * mbs::quarter_turn(point.normal.x0);
      point.offset = (x - point.at.at(q)).dot(point.normal.at(q).normalized());
    }
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace sphmbs::coupling
