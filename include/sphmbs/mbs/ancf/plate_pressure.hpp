// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/ancf/plate_nodal.hpp>
#include <sphmbs/mbs/ancf/plate_strain.hpp>

namespace sphmbs::mbs::ancf::detail {

/// Unit pressure on a plate element: integral of N^T (r_x x r_y), whose integrand has degree 8 in
/// either direction: exact by 5 x 5 Gauss points.
template <class Shape>
class PlatePressure {
 public:
  static constexpr int functions = PlateFunctions<Shape>::size;
  static constexpr int dofs = 3 * functions;

  explicit PlatePressure(const PlateScale<Shape>& scale) : scale_(scale) {}

  template <class S>
  Vector<dofs, S> force(const Vector<dofs, S>& q) const {
    const NodalVectors<Shape, S> x(scale_, q);
    Vector<dofs, S> F = Vector<dofs, S>::Zero();
    for (int p = 0; p < points; ++p) {
      const Vec3<S> n = cross(along(table.derivative[0], x, p), along(table.derivative[1], x, p));
      for (int k = 0; k < functions; ++k)
        for (int c = 0; c < 3; ++c)
          F[3 * k + c] += scale_(k) * table.weight[p] * table.value[k][p] * n[c];
    }
    return F;
  }

  /// As dn = -(r_y x dr_x - r_x x dr_y), each 3 x 3 block is minus the cross product with the
  /// integral of N_k (r_y dN_l/dx - r_x dN_l/dy).
  Matrix<dofs, dofs> tangent(const Vector<dofs>& q) const {
    const NodalVectors<Shape, double> x(scale_, q);
    Matrix<points, dofs> turn;
    for (int p = 0; p < points; ++p) {
      const Vec3<double> a = along(table.derivative[0], x, p), b = along(table.derivative[1], x, p);
      for (int l = 0; l < functions; ++l)
        for (int c = 0; c < 3; ++c)
          turn(p, 3 * l + c) =
              scale_(l) * table.weight[p] *
              (table.derivative[0][l][p] * b[c] - table.derivative[1][l][p] * a[c]);
    }
    using Values = Eigen::Matrix<double, functions, points, Eigen::RowMajor>;
    const Matrix<functions, dofs> d =
        Eigen::Map<const Values>(&table.value[0][0]).lazyProduct(turn);
    Matrix<dofs, dofs> K;
    for (int k = 0; k < functions; ++k)
      for (int l = 0; l < functions; ++l) {
        const Vector<3> t = scale_(k) * d.template block<1, 3>(k, 3 * l).transpose();
        K.template block<3, 3>(3 * k, 3 * l) << 0, t[2], -t[1], -t[2], 0, t[0], t[1], -t[0], 0;
      }
    return K;
  }

 private:
  static constexpr const auto& table = plate_table<Shape, 5>;
  static constexpr int points = table.points;

  template <class Table, class S>
  static Vec3<S> along(const Table& derivative, const NodalVectors<Shape, S>& x, int p) {
    Vec3<S> sum = Vec3<S>::all(S(0));
    for (int k = 0; k < functions; ++k) sum += derivative[k][p] * x.value[k];
    return sum;
  }

  PlateScale<Shape> scale_;
};

}  // namespace sphmbs::mbs::ancf::detail
