// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Geometry>
#include <unsupported/Eigen/AutoDiff>

#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/marker.hpp>

#include "support/random.hpp"

namespace test {

namespace mbs = sphmbs::mbs;
using mbs::Marker;
using mbs::Matrix;
using mbs::Vector;

/// Numbers that carry their derivatives in n directions; of doubles or of such numbers.
template <int n, class S = double>
using Dual = Eigen::AutoDiffScalar<Vector<n, S>>;

/// q as numbers that carry the derivatives in q.
template <int n, class S = double>
Vector<n, Dual<n, S>> dual(const Vector<n, S>& q) {
  Vector<n, Dual<n, S>> x;
  for (int i = 0; i < n; ++i) {
    Vector<n, S> unit;
    for (int k = 0; k < n; ++k) unit[k] = S(k == i ? 1.0 : 0.0);
    x[i] = Dual<n, S>(q[i], unit);
  }
  return x;
}

/// q as numbers of type T without derivatives.
template <class T, int n>
Vector<n, T> constant(const Vector<n>& q) {
  Vector<n, T> x;
  for (int i = 0; i < n; ++i) x[i] = T(q[i]);
  return x;
}

/// Jacobian of a vector that carries derivatives.
template <int m, int n>
Matrix<m, n> jacobian(const Vector<m, Dual<n>>& f) {
  Matrix<m, n> J;
  for (int i = 0; i < m; ++i) J.row(i) = f[i].derivatives().transpose();
  return J;
}

/// Gradient and Hessian of an energy V(q), a template in the type of the coordinates.
template <int n>
struct Slopes {
  Vector<n> gradient;
  Matrix<n, n> hessian;
};
template <int n, class Energy>
Slopes<n> slopes(const Energy& V, const Vector<n>& q) {
  using First = Dual<n>;
  const Vector<n, First> inner = dual<n>(q);
  const Dual<n, First> energy = V(dual<n, First>(inner));
  Slopes<n> result;
  for (int i = 0; i < n; ++i) {
    result.gradient[i] = energy.derivatives()[i].value();
    result.hessian.row(i) = energy.derivatives()[i].derivatives().transpose();
  }
  return result;
}

/// Free points as a model: its coordinates are their positions, and a marker is a sum of these with
/// weights that add up to 1 of a place and to 0 of a vector, so that rigid motion is what it is.
template <int Dim, int Points>
struct FreePoints {
  static constexpr int n = Dim * Points;
  Random random;
  Vector<n> q = Vector<n>::Zero(), v = Vector<n>::Zero();

  explicit FreePoints(std::uint64_t seed) : random(seed) {
    for (int k = 0; k < n; ++k) {
      q[k] = random.between(-1, 1);
      v[k] = random.between(-1, 1);
    }
  }

  /// On all points.
  Marker<Dim> place() { return weighted(1); }
  Marker<Dim> vector() { return weighted(0); }
  /// On one point.
  static Marker<Dim> point(int i) {
    Marker<Dim> m;
    m.N = Matrix<Dim, mbs::Dynamic>::Identity(Dim, Dim);
    for (int k = 0; k < Dim; ++k) m.index.push_back(Dim * i + k);
    return m;
  }

  static Vector<n> translation(int axis) {
    Vector<n> T = Vector<n>::Zero();
    for (int i = 0; i < Points; ++i) T[Dim * i + axis] = 1;
    return T;
  }
  /// All points turned by R.
  static Vector<n> turned(const Matrix<Dim, Dim>& R, const Vector<n>& x) {
    Vector<n> y;
    for (int i = 0; i < Points; ++i)
      y.template segment<Dim>(Dim * i) = R * x.template segment<Dim>(Dim * i);
    return y;
  }

 private:
  Marker<Dim> weighted(double total) {
    Marker<Dim> m;
    m.N = Matrix<Dim, mbs::Dynamic>::Zero(Dim, n);
    double sum = 0;
    for (int i = 0; i < Points; ++i) {
      const double weight = i + 1 < Points ? random.between(-1, 1) : total - sum;
      sum += weight;
      m.N.template middleCols<Dim>(Dim * i) = weight * Matrix<Dim, Dim>::Identity();
    }
    for (int k = 0; k < n; ++k) m.index.push_back(k);
    return m;
  }
};

/// Rates of unit turning: about each axis in space, about the normal in the plane.
template <int Dim>
std::vector<Matrix<Dim, Dim>> unit_turns() {
  std::vector<Matrix<Dim, Dim>> turns;
  for (int i = 0; i < Dim; ++i)
    for (int j = 0; j < i; ++j) {
      Matrix<Dim, Dim> W = Matrix<Dim, Dim>::Zero();
      W(i, j) = 1;
      W(j, i) = -1;
      turns.push_back(W);
    }
  return turns;
}

/// A finite turn.
template <int Dim>
Matrix<Dim, Dim> some_turn() {
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(2.1).toRotationMatrix();
  else
    return Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

/// A marker for coordinates of any number type.
template <int Dim, int n, class S>
Vector<Dim, S> at(const Marker<Dim>& marker, const Vector<n, S>& q) {
  Vector<Dim, S> x;
  for (int i = 0; i < Dim; ++i) {
    x[i] = S(marker.x0[i]);
    for (std::size_t k = 0; k < marker.index.size(); ++k)
      x[i] += S(marker.N(i, static_cast<int>(k))) * q[marker.index[k]];
  }
  return x;
}
template <int Dim, int n, class S>
Vector<Dim, S> rate(const Marker<Dim>& marker, const Vector<n, S>& v) {
  Marker<Dim> moving = marker;
  moving.x0.setZero();
  return at(moving, v);
}

/// N^T F for numbers of any type.
template <int Dim, int n, class S>
void pull_back(const Marker<Dim>& marker, const Vector<Dim, S>& F, Vector<n, S>& Q) {
  for (std::size_t k = 0; k < marker.index.size(); ++k)
    for (int i = 0; i < Dim; ++i) Q[marker.index[k]] += S(marker.N(i, static_cast<int>(k))) * F[i];
}

/// A force over all n coordinates.
template <int n>
struct Assembled {
  Vector<n> Q = Vector<n>::Zero();
  Matrix<n, n> K = Matrix<n, n>::Zero(), C = Matrix<n, n>::Zero();
  double potential = 0, dissipation = 0;
};
template <int n, mbs::Force F>
Assembled<n> assembled(const F& force, const Vector<n>& q, const Vector<n>& v, double t = 0) {
  const mbs::Index& index = force.index();
  const int own = static_cast<int>(index.size());
  mbs::VectorXd x = q(index), rates = v(index), f = mbs::VectorXd::Zero(own);
  mbs::MatrixXd k = mbs::MatrixXd::Zero(own, own), c = k;
  force.force(x, rates, t, f);
  force.tangent(x, rates, t, k, c);
  Assembled<n> all;
  all.Q(index) = f;
  all.K(index, index) = k;
  all.C(index, index) = c;
  all.potential = force.potential(x, t);
  all.dissipation = force.dissipation(x, rates, t);
  return all;
}

}  // namespace test
