// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/SparseCore>

#include <sphmbs/coupling/riding.hpp>
#include <sphmbs/coupling/wetted_point.hpp>

namespace sphmbs::coupling {

/// Many wetted points as rows of sparse matrices: places x0 + N q and normals n0 + G q. With an
/// offset d along the unit normal n = g / |g|, g = n0 + G q,
///
///   r = x0 + N q + d n,   v = N q' + d n',   n' = (1 - n n^T) G q' / |g|
///
/// and a force f there is the generalized force N^T f + d G^T (1 - n n^T) f / |g|. Where the normal
/// is a product of two vectors, g = a x b, it is G = -[b] A + [a] B with their rows A and B.
template <int Space>
class PointRows {
 public:
  using Vector = mbs::Vector<Space>;  ///< a place or a force [m], [N]
  using VectorXd = mbs::VectorXd;     ///< one number for each coordinate

  /// @param lever  of what gas meets and the force acts on, beyond the particle, along the normal
  void add(const WettedPoint<Space>& point, double lever) {
    points_.push_back(point);
    arms_.push_back({point.offset, lever});
    const auto given = [](const mbs::Marker<Space>& m) { return m.N.size() > 0 || !m.x0.isZero(); };
    bare_ = bare_ && !given(point.normal) && !given(point.along[0]);
  }

  /// Number of points.
  std::size_t size() const { return points_.size(); }
  /// From a particle to where the force acts, along the normal [m].
  double lever(std::size_t i) const { return arms_[i].lever; }

  /// Makes the matrices, once all points are there.
  void assemble() {
    int coordinates = 0;
    for (const WettedPoint<Space>& p : points_)
      for (const auto* marker : {&p.at, &p.normal, &p.along[0], &p.along[1]})
        for (const int k : marker->index) coordinates = std::max(coordinates, k + 1);
    place_.assemble(points_, coordinates, [](const auto& p) { return p.at; });
    normal_.assemble(points_, coordinates, [](const auto& p) { return p.normal; });
    for (std::size_t k = 0; k < 2; ++k)
      along_[k].assemble(points_, coordinates, [k](const auto& p) { return p.along[k]; });
  }

  /// The courses of all points from coordinates q with rates v and accelerations a.
  template <int Dim>
  std::vector<Course<Dim>> depart(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
    place_.depart(q, v, a);
    if (!bare_)
      for (Stack* stack : {&normal_, &along_[0], &along_[1]}) stack->depart(q, v, a);
    std::vector<Course<Dim>> all(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const Vector r = place_.value(i), u = place_.rate(i), w = place_.acceleration(i);
      Vector n = Vector::Zero(), n1 = n, n2 = n;  // unit normal and its derivatives in time
      Vector g = n, g1 = n;
      if (!bare_) {
        g = normal_.value(i);
        g1 = normal_.rate(i);
        Vector g2 = normal_.acceleration(i);
        if constexpr (Space == 3) {
          const auto& [A, B] = along_;
          g += A.value(i).cross(B.value(i));
          g1 += A.rate(i).cross(B.value(i)) + A.value(i).cross(B.rate(i));
          g2 += A.acceleration(i).cross(B.value(i)) + A.value(i).cross(B.acceleration(i)) +
                2 * A.rate(i).cross(B.rate(i));
        }
        if (const double length = g.norm(); length > 0) {
          n = g / length;
          n1 = across(n, g1 / length);
          n2 = across(n, g2 / length) - 2 * (n.dot(g1) / length) * n1 - n1.squaredNorm() * n;
        }
      }
      const auto [offset, lever] = arms_[i];
      const double arm = offset + lever;
      all[i] = {gas<Dim>(r + offset * n),
                gas<Dim>(u + offset * n1),
                gas<Dim>(w + offset * n2),
                gas<Dim>(u + arm * n1),
                gas<Dim>(w + arm * n2),
                gas<Dim>(g),
                gas<Dim>(g1)};
    }
    return all;
  }

  /// Generalized force of forces on the points, s seconds after the start of their courses.
  template <int Dim>
  VectorXd load(const std::vector<Vec<Dim>>& forces, const std::vector<Course<Dim>>& courses,
                double s, int coordinates) const {
    VectorXd f(static_cast<int>(size()) * Space), turning = VectorXd::Zero(f.size());
    VectorXd on_A = turning, on_B = turning;
    for (std::size_t i = 0; i < size(); ++i) {
      const int row = static_cast<int>(i) * Space;
      f.segment<Space>(row) = in_space<Space>(forces[i]);
      const double arm = arms_[i].offset + arms_[i].lever;
      if (arm == 0) continue;
      const Vector g = in_space<Space>(courses[i].n + s * courses[i].m);
      const Vector turns = arm / g.norm() * across(g.normalized(), f.segment<Space>(row));
      turning.segment<Space>(row) = turns;
      if constexpr (Space == 3) {
        const auto& [A, B] = along_;
        on_A.segment<Space>(row) = (B.value(i) + s * B.rate(i)).cross(turns);
        on_B.segment<Space>(row) = turns.cross(A.value(i) + s * A.rate(i));
      }
    }
    VectorXd Q = VectorXd::Zero(coordinates);
    place_.add_load(f, Q);
    if (!bare_) {
      normal_.add_load(turning, Q);
      along_[0].add_load(on_A, Q);
      along_[1].add_load(on_B, Q);
    }
    return Q;
  }

 private:
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  // Rows of one marker of all points, with the values that they had at the last departure.
  struct Stack {
    Rows N;
    VectorXd x0, last, last_rate, last_acceleration;

    template <class Select>
    void assemble(const std::vector<WettedPoint<Space>>& points, int coordinates,
                  const Select& select) {
      const int n = static_cast<int>(points.size()) * Space;
      N = Rows(n, coordinates);
      x0 = VectorXd::Zero(n);
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const mbs::Marker<Space> marker = select(points[i]);
        const int row = static_cast<int>(i) * Space;
        x0.template segment<Space>(row) = marker.x0;
        for (std::size_t k = 0; k < marker.index.size(); ++k)
          for (int axis = 0; axis < Space; ++axis)
            entries.emplace_back(row + axis, marker.index[k], marker.N(axis, static_cast<int>(k)));
      }
      N.setFromTriplets(entries.begin(), entries.end());
    }

    void depart(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
      last = x0 + N * q.head(N.cols());
      last_rate = N * v.head(N.cols());
      last_acceleration = N * a.head(N.cols());
    }
    Vector value(std::size_t i) const { return of(last, i); }
    Vector rate(std::size_t i) const { return of(last_rate, i); }
    Vector acceleration(std::size_t i) const { return of(last_acceleration, i); }
    static Vector of(const VectorXd& all, std::size_t i) {
      return all.template segment<Space>(static_cast<int>(i) * Space);
    }
    void add_load(const VectorXd& f, VectorXd& Q) const { Q.head(N.cols()) += N.transpose() * f; }
  };

  struct Arm {
    double offset, lever;  // [m]
  };

  static Vector across(const Vector& n, const Vector& x) { return x - n.dot(x) * n; }

  template <int Dim>
  static Vec<Dim> gas(const Vector& x) {
    Vec<Dim> y;
    for (int k = 0; k < Dim; ++k) y[k] = x[k];
    return y;
  }

  std::vector<WettedPoint<Space>> points_;
  std::vector<Arm> arms_;
  bool bare_ = true;  // no point has a normal
  Stack place_, normal_;
  std::array<Stack, 2> along_;
};

}  // namespace sphmbs::coupling
