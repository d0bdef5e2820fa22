// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <complex>

#include <Eigen/Geometry>
#include <sphmbs/mbs/types.hpp>

#include "support/random.hpp"

namespace test {

using Complex = std::complex<double>;
constexpr double complex_step = 1e-30;

/// Largest difference, as a share of the largest entry.
template <class A, class B>
double difference(const A& a, const B& b) {
  const double size = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  return size > 0 ? (a - b).cwiseAbs().maxCoeff() / size : 0;
}

template <int n>
sphmbs::mbs::Vector<n> random_vector(Random& random, double size) {
  sphmbs::mbs::Vector<n> x;
  for (int k = 0; k < n; ++k) x[k] = random.between(-size, size);
  return x;
}

template <int Dim>
sphmbs::mbs::Matrix<Dim, Dim> random_rotation(Random& random) {
  const double angle = random.between(-3, 3);
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  else
    return Eigen::AngleAxisd(angle, random_vector<3>(random, 1).normalized()).toRotationMatrix();
}

/// R times each of the vectors that q is made of.
template <int Dim, int n>
sphmbs::mbs::Vector<n> rotated(const sphmbs::mbs::Matrix<Dim, Dim>& R,
                               const sphmbs::mbs::Vector<n>& q) {
  sphmbs::mbs::Vector<n> turned;
  for (int k = 0; k < n; k += Dim) turned.template segment<Dim>(k) = R * q.template segment<Dim>(k);
  return turned;
}

/// The Jacobian of f, by a complex step; f takes and returns complex vectors.
template <int m, int n, class F>
sphmbs::mbs::Matrix<m, n> complex_jacobian(const sphmbs::mbs::Vector<n>& x, F&& f) {
  sphmbs::mbs::Matrix<m, n> jacobian;
  for (int k = 0; k < n; ++k) {
    sphmbs::mbs::Vector<n, Complex> stepped = x.template cast<Complex>();
    stepped[k] += Complex(0, complex_step);
    const sphmbs::mbs::Vector<m, Complex> y = f(stepped);
    jacobian.col(k) = y.imag() / complex_step;
  }
  return jacobian;
}

/// dU/dq of an element whose strain_energy takes complex coordinates.
template <class E>
sphmbs::mbs::Vector<E::dofs> energy_gradient(const E& element,
                                             const sphmbs::mbs::Vector<E::dofs>& q) {
  return complex_jacobian<1, E::dofs>(
             q,
             [&](const auto& x) {
               return sphmbs::mbs::Vector<1, Complex>(element.template strain_energy<Complex>(x));
             })
      .transpose();
}

/// dF/dq + w dF/dv of an element whose internal_force takes complex coordinates.
template <class E>
sphmbs::mbs::Matrix<E::dofs, E::dofs> force_jacobian(const E& element,
                                                     const sphmbs::mbs::Vector<E::dofs>& q,
                                                     const sphmbs::mbs::Vector<E::dofs>& v,
                                                     double w) {
  const auto in_q = complex_jacobian<E::dofs, E::dofs>(q, [&](const auto& x) {
    return element.template internal_force<Complex>(x, v.template cast<Complex>());
  });
  const auto in_v = complex_jacobian<E::dofs, E::dofs>(v, [&](const auto& x) {
    return element.template internal_force<Complex>(q.template cast<Complex>(), x);
  });
  return in_q + w * in_v;
}

}  // namespace test
