// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <sphmbs/mbs/structure.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

/// What holds for every rigid body, and tools for joints between them.
namespace test {

namespace mbs = sphmbs::mbs;

template <int Rows>
mbs::Vector<Rows> random_vector(Random& random, double size = 1) {
  mbs::Vector<Rows> x;
  for (int k = 0; k < Rows; ++k) x[k] = random.between(-size, size);
  return x;
}
inline mbs::VectorXd random_vector(Random& random, int rows, double size = 1) {
  mbs::VectorXd x(rows);
  for (int k = 0; k < rows; ++k) x[k] = random.between(-size, size);
  return x;
}

inline Eigen::Quaterniond random_rotation(Random& random) {
  const mbs::Vector<4> x = random_vector<4>(random);
  return Eigen::Quaterniond(x[0], x[1], x[2], x[3]).normalized();
}

/// Derivative of a polynomial f of degree 2: central differences, by a step as large as q, are
/// exact.
template <class F>
mbs::MatrixXd quadratic_slopes(F&& f, const mbs::VectorXd& q) {
  mbs::MatrixXd slopes(f(q).size(), q.size());
  for (int k = 0; k < q.size(); ++k) {
    const mbs::VectorXd step = mbs::VectorXd::Unit(q.size(), k);
    slopes.col(k) = (f(q + step) - f(q - step)) / 2;
  }
  return slopes;
}

/// Largest size of a number in x; NaN if there is one. A plain loop: for Eigen's reductions GCC 12
/// with AVX-512 warns of its own header.
template <class X>
double largest(const Eigen::MatrixBase<X>& x) {
  const mbs::MatrixXd values = x;
  double size = 0;
  for (int i = 0; i < values.rows(); ++i)
    for (int j = 0; j < values.cols(); ++j)
      if (!(std::abs(values(i, j)) <= size)) size = std::abs(values(i, j));
  return size;
}
template <class A, class B>
double largest_difference(const A& a, const B& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() ? largest(a - b) : std::nan("");
}

/// The rigidity conditions hold at the start, and so do their rates.
template <class B>
void check_start(const B& body) {
  constexpr double rounding = 1e-13;
  body.check();
  const mbs::Vector<B::dofs> q = body.initial_coordinates(), v = body.initial_rates();
  CHECK(largest(body.rigidity(q)) < rounding);
  CHECK(largest(body.rigidity_jacobian(q) * v) < rounding * (1 + largest(v)));
}

/// Phi_q and d(Phi_q^T lambda)/dq are what they say, at any q.
template <class B>
void check_rigidity_derivatives(const B& body, Random& random) {
  constexpr double rounding = 1e-12;
  const mbs::VectorXd q = random_vector(random, B::dofs);
  const mbs::Vector<B::conditions> lambda = random_vector<B::conditions>(random);
  const auto phi = [&](const mbs::VectorXd& x) { return mbs::VectorXd(body.rigidity(x)); };
  const auto reaction = [&](const mbs::VectorXd& x) {
    return mbs::VectorXd(body.rigidity_jacobian(x).transpose() * lambda);
  };
  CHECK(largest_difference(body.rigidity_jacobian(q), quadratic_slopes(phi, q)) < rounding);
  CHECK(largest_difference(body.rigidity_hessian(lambda), quadratic_slopes(reaction, q)) <
        rounding);
}

/// The coordinates of a translation move every point alike, and mass is what resists it.
template <class B>
void check_translation(const B& body, const typename B::Material& X, double mass) {
  constexpr double rounding = 1e-13;
  using Square = mbs::Matrix<B::dim, B::dim>;
  const auto T = B::translation();
  CHECK(largest_difference(body.shape(X) * T, Square::Identity()) < rounding);
  CHECK(largest_difference(T.transpose() * body.mass_matrix() * T, mass * Square::Identity()) <
        rounding * mass);
}

template <class B>
double kinetic_energy(const B& body) {
  const mbs::Vector<B::dofs> v = body.initial_rates();
  return 0.5 * v.dot(body.mass_matrix() * v);
}

/// Smallest singular value of [M, Phi_q^T; Phi_q, 0] as a share of the largest one.
inline double regularity(const mbs::MatrixXd& M, const mbs::MatrixXd& phi_q) {
  const auto n = M.rows(), m = phi_q.rows();
  mbs::MatrixXd kkt = mbs::MatrixXd::Zero(n + m, n + m);
  kkt.topLeftCorner(n, n) = M;
  kkt.topRightCorner(n, m) = phi_q.transpose();
  kkt.bottomLeftCorner(m, n) = phi_q;
  const mbs::VectorXd sizes = kkt.jacobiSvd().singularValues();
  return sizes[sizes.size() - 1] / sizes[0];
}

}  // namespace test
