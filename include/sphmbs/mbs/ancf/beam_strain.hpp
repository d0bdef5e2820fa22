// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/ancf/pull_back.hpp>
#include <sphmbs/mbs/ancf/shape_functions.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ancf {

/// What the strains of a beam with deformable section depend on: the columns r_x, r_y, r_z, r_xy
/// and r_xz, on the axis.
template <class S = double>
using BeamGradients = Matrix<3, 5, S>;

/// Their coefficients C in the nodal vectors q_j = (r, r_x, r_y, r_z) at either end, g = q C^T,
/// where r is cubic in x and linear in y and z.
inline Matrix<5, 8> beam_coefficients(double xi, double length) {
  const auto h = hermite<1>(xi, length);
  const double left = 1 - xi, right = xi, d = 1 / length;
  Matrix<5, 8> C;
  C << h[0], h[1], 0, 0, h[2], h[3], 0, 0,  //
      0, 0, left, 0, 0, 0, right, 0,        //
      0, 0, 0, left, 0, 0, 0, right,        //
      0, 0, -d, 0, 0, 0, d, 0,              //
      0, 0, 0, -d, 0, 0, 0, d;
  return C;
}

/// Strains of a beam on its axis.
///
/// - 0 (r_x.r_x - 1)/2, stretch; 1 (r_y.r_y - 1)/2, width; 2 (r_z.r_z - 1)/2, height
/// - 3 r_x.r_y and 4 r_x.r_z, shear along y and z; 5 r_y.r_z, shear in the section
/// - 6 r_x.r_xy and 7 r_x.r_xz, bending of the fibres at y and at z
/// - 8 (r_xy.r_z - r_xz.r_y)/2, twist
///
/// They are Green's strain of r = r_0 + y r_y + z r_z at y = z = 0, shears doubled, and those of
/// its terms linear in y and z that bend and twist, as in E_xx = e_0 + y e_6 + z e_7 + ...
template <class S = double>
using BeamStrain = Vector<9, S>;

/// Rate of the strains where the gradients g have the rate h. All strains are of second degree.
template <class S>
BeamStrain<S> beam_strain_rate(const BeamGradients<S>& g, const BeamGradients<S>& h) {
  const auto direct = [&](int i, int j) { return inner(g.col(i), h.col(j)); };
  const auto mixed = [&](int i, int j) { return direct(i, j) + direct(j, i); };
  BeamStrain<S> rate;
  rate << direct(0, 0), direct(1, 1), direct(2, 2), mixed(0, 1), mixed(0, 2), mixed(1, 2),
      mixed(0, 3), mixed(0, 4), 0.5 * (mixed(3, 2) - mixed(4, 1));
  return rate;
}

template <class S>
BeamStrain<S> beam_strain(const BeamGradients<S>& g) {
  BeamStrain<S> e = 0.5 * beam_strain_rate<S>(g, g);
  for (int k = 0; k < 3; ++k) e[k] -= 0.5;
  return e;
}

/// Second derivative of sum_k s_k e_k in the gradients, a scalar for each pair of them; g times it
/// is the first derivative.
template <class S>
Matrix<5, 5, S> beam_strain_hessian(const BeamStrain<S>& s) {
  const S none = S(0), twist = 0.5 * s[8];
  Matrix<5, 5, S> h;
  h << s[0], s[3], s[4], s[6], s[7],   //
      s[3], s[1], s[5], none, -twist,  //
      s[4], s[5], s[2], twist, none,   //
      s[6], none, twist, none, none,   //
      s[7], -twist, none, none, none;
  return h;
}

/// Derivative of the strains, one a column, in the nodal vectors q behind g = q C^T.
template <int Nodal>
Matrix<3 * Nodal, 9> beam_strain_gradient(const BeamGradients<>& g, const Matrix<5, Nodal>& C) {
  Matrix<3 * Nodal, 9> B;
  const auto column = [&](int k) { return Eigen::Map<Matrix<3, Nodal>>(B.col(k).data()); };
  const auto mixed = [&](int i, int j) { return g.col(i) * C.row(j) + g.col(j) * C.row(i); };
  for (int k = 0; k < 3; ++k) column(k) = g.col(k) * C.row(k);
  column(3) = mixed(0, 1);
  column(4) = mixed(0, 2);
  column(5) = mixed(1, 2);
  column(6) = mixed(0, 3);
  column(7) = mixed(0, 4);
  column(8) = 0.5 * (mixed(3, 2) - mixed(4, 1));
  return B;
}

}  // namespace sphmbs::mbs::ancf
