// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/forces/cross.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>
#include <sphmbs/mbs/joints/frame.hpp>
#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::forces {

/// Bushings and contact look at a point from a frame whose vectors are of unit length and across
/// each other. Of a rigid body they are and stay so; of a deformable part, stretch and shear enter
/// what is measured.
using joints::Frame;

/// The frame of a rigid body at its material point X, its vectors the columns of R in material
/// coordinates.
template <Body B>
Frame<B::dim> frame(const Placed<B>& body, const typename B::Material& X,
                    const Matrix<B::dim, B::dim>& R = Matrix<B::dim, B::dim>::Identity()) {
  Frame<B::dim> result{.origin = body.point(X), .vectors = {}};
  for (int k = 0; k < B::dim; ++k)
    result.vectors[static_cast<std::size_t>(k)] = body.vector(X, X + R.col(k));
  return result;
}

/// The planar frame with a given first vector, such as one of a body of unit length.
inline Frame<2> frame(const Marker<2>& origin, const Marker<2>& x) {
  Marker<2> y = x;
  for (int k = 0; k < y.N.cols(); ++k) y.N.col(k) = quarter_turn(x.N.col(k));
  y.x0 = quarter_turn(x.x0);
  return {.origin = origin, .vectors = {x, y}};
}

/// The frame that goes along with a point and keeps the directions of the ground.
template <int Dim>
Frame<Dim> translating_frame(const Marker<Dim>& origin) {
  Frame<Dim> result = joints::ground_frame<Dim>(Vector<Dim>::Zero());
  result.origin = origin;
  return result;
}

/// A frame of the ground whose last vector is along `normal`.
/// @throws InvalidInput for a normal without length.
template <int Dim>
Frame<Dim> ground_frame(const Vector<Dim>& origin, const Vector<Dim>& normal) {
  expects(normal.allFinite() && normal.norm() > 0, "normal", normal.transpose(),
          "of positive length");
  const Vector<Dim> n = normal.normalized();
  if constexpr (Dim == 2) {
    return frame(ground<2>(origin), ground<2>(-quarter_turn(n)));
  } else {
    const Vector<3> x = n.unitOrthogonal();
    return {.origin = ground<3>(origin),
            .vectors = {ground<3>(x), ground<3>(n.cross(x)), ground<3>(n)}};
  }
}

/// @throws InvalidInput for a frame that lacks vectors.
template <int Dim>
void check(const Frame<Dim>& frame, const char* name) {
  for (const Marker<Dim>& vector : frame.vectors)
    expects(!is_zero(vector), std::string(name) + ".vectors", "zero", "as many as dimensions");
}

/// Where a point is, seen in a frame: zeta_i = a_i . d with its vectors a_i and d from the origin
/// to the point; bilinear in y = (d, a_1, ..., a_Dim).
template <int Dim>
struct RelativePosition {
  static constexpr int size = Dim * (Dim + 1);  ///< numbers in y

  /// Vectors of the frame and the way of the point from its origin, as one marker.
  static Marker<size> y(const Frame<Dim>& frame, const Marker<Dim>& point) {
    const Marker<Dim> d = point - frame.origin;
    if constexpr (Dim == 2)
      return stacked(d, frame.vectors[0], frame.vectors[1]);
    else
      return stacked(d, frame.vectors[0], frame.vectors[1], frame.vectors[2]);
  }

  /// The place in the frame as a function of these [m].
  static Vector<Dim> value(const Vector<size>& y) { return 0.5 * jacobian(y) * y; }

  /// dzeta/dy. Linear in y: of dy/dt it is d(dzeta/dt)/dy.
  static Matrix<Dim, size> jacobian(const Vector<size>& y) {
    Matrix<Dim, size> J = Matrix<Dim, size>::Zero();
    for (int i = 0; i < Dim; ++i) {
      J.template block<1, Dim>(i, 0) = y.template segment<Dim>(Dim * (i + 1)).transpose();
      J.template block<1, Dim>(i, Dim * (i + 1)) = y.template head<Dim>().transpose();
    }
    return J;
  }

  /// d(J^T f)/dy for constant f.
  static Matrix<size, size> hessian(const Vector<Dim>& f) {
    Matrix<size, size> H = Matrix<size, size>::Zero();
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) H(k, Dim * (i + 1) + k) = H(Dim * (i + 1) + k, k) = f[i];
    return H;
  }
};

}  // namespace sphmbs::mbs::forces
