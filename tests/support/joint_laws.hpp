// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <sphmbs/mbs/constraint.hpp>

#include "support/body_laws.hpp"

/// What holds for every constraint.
namespace test {

template <mbs::Constraint C>
mbs::VectorXd residual(const C& joint, const mbs::VectorXd& q, double t = 0) {
  mbs::VectorXd phi = mbs::VectorXd::Zero(joint.conditions());
  joint.residual(q(joint.index()), t, phi);
  return phi;
}

/// Phi_q in all coordinates of the structure.
template <mbs::Constraint C>
mbs::MatrixXd jacobian(const C& joint, const mbs::VectorXd& q, double t = 0) {
  mbs::MatrixXd own =
      mbs::MatrixXd::Zero(joint.conditions(), static_cast<int>(joint.index().size()));
  joint.jacobian(q(joint.index()), t, own);
  mbs::MatrixXd phi_q = mbs::MatrixXd::Zero(joint.conditions(), q.size());
  phi_q(Eigen::all, joint.index()) = own;
  return phi_q;
}

/// First and second derivative at 0 of a polynomial of degree 4, exact, by its values at five
/// points.
struct Slopes {
  mbs::VectorXd first, second;
};
template <class F>
Slopes quartic_slopes(F&& f) {
  const mbs::VectorXd a = f(-2.0), b = f(-1.0), c = f(0.0), d = f(1.0), e = f(2.0);
  return {(a - 8 * b + 8 * d - e) / 12, (-a + 16 * b - 30 * c + 16 * d - e) / 12};
}

/// First and second time derivative of Phi(q(t), t) along q + v t + a t^2 / 2, by what the joint
/// says.
template <mbs::Constraint C>
Slopes slopes_along(const C& joint, const mbs::VectorXd& q, const mbs::VectorXd& v,
                    const mbs::VectorXd& a, double t) {
  const auto n = static_cast<int>(joint.index().size());
  const int m = joint.conditions();
  mbs::MatrixXd phi_q = mbs::MatrixXd::Zero(m, n);
  mbs::VectorXd phi_t = mbs::VectorXd::Zero(m), gamma = mbs::VectorXd::Zero(m);
  joint.jacobian(q, t, phi_q);
  joint.rate(q, t, phi_t);
  joint.acceleration(q, v, t, gamma);
  Slopes slopes{phi_q * v + phi_t, phi_q * a + gamma};
  for (int i = 0; i < m; ++i) {
    mbs::MatrixXd h = mbs::MatrixXd::Zero(n, n);
    joint.add_hessian(q, t, mbs::VectorXd::Unit(m, i), h);
    slopes.second[i] += v.dot(h * v);
  }
  return slopes;
}

/// For a Phi of degree 2 in q: Phi_q and d(Phi_q^T lambda)/dq are what they say, at any q.
template <mbs::Constraint C>
void check_derivatives_in_q(const C& joint, Random& random, double t) {
  constexpr double rounding = 1e-11;
  const auto n = static_cast<int>(joint.index().size());
  const int m = joint.conditions();
  const mbs::VectorXd q = random_vector(random, n), lambda = random_vector(random, m);
  const auto own_jacobian = [&](const mbs::VectorXd& x) {
    mbs::MatrixXd phi_q = mbs::MatrixXd::Zero(m, n);
    joint.jacobian(x, t, phi_q);
    return phi_q;
  };
  const auto phi = [&](const mbs::VectorXd& x) {
    mbs::VectorXd y = mbs::VectorXd::Zero(m);
    joint.residual(x, t, y);
    return y;
  };
  const auto reaction = [&](const mbs::VectorXd& x) {
    return mbs::VectorXd(own_jacobian(x).transpose() * lambda);
  };
  mbs::MatrixXd h = mbs::MatrixXd::Identity(n, n);
  joint.add_hessian(q, t, lambda, h);
  CHECK(largest_difference(own_jacobian(q), quadratic_slopes(phi, q)) < rounding);
  CHECK(largest_difference(h - mbs::MatrixXd::Identity(n, n), quadratic_slopes(reaction, q)) <
        rounding);
}

/// For a Phi whose time functions are of degree 2 at most: velocity and acceleration of Phi along a
/// motion of degree 2 are what they say.
template <mbs::Constraint C>
void check_derivatives_in_time(const C& joint, Random& random, double t) {
  constexpr double rounding = 1e-10;
  const auto n = static_cast<int>(joint.index().size());
  const mbs::VectorXd q = random_vector(random, n), v = random_vector(random, n),
                      a = random_vector(random, n);
  const Slopes exact = quartic_slopes([&](double s) {
    mbs::VectorXd y = mbs::VectorXd::Zero(joint.conditions());
    joint.residual(q + s * v + s * s / 2 * a, t + s, y);
    return y;
  });
  const Slopes said = slopes_along(joint, q, v, a, t);
  CHECK(largest_difference(said.first, exact.first) < rounding);
  CHECK(largest_difference(said.second, exact.second) < rounding);
}

}  // namespace test
