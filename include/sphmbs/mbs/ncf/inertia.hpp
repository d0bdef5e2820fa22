// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ncf {

/// Inertia of a spatial body, in its own axes.
struct Inertia {
  double mass;                                 ///< [kg]
  Vector<3> centre = Vector<3>::Zero();        ///< centre of mass [m]
  Matrix<3, 3> tensor = Matrix<3, 3>::Zero();  ///< about the centre of mass [kg m^2]

  /// Integral of rho X X^T dV = tr(J) / 2 - J + m c c^T [kg m^2].
  Matrix<3, 3> second_moments() const {
    return central_moments() + mass * centre * centre.transpose();
  }

  /// The same about the centre of mass.
  Matrix<3, 3> central_moments() const {
    return 0.5 * tensor.trace() * Matrix<3, 3>::Identity() - tensor;
  }

  /// A flat body, whose largest principal moment is the sum of the others, and a thin rod, whose
  /// smallest one is 0, are allowed. The mass matrix is singular then. Of a flat body the rigidity
  /// conditions hold all that has no mass; the spin of a rod about its axis has to be held by
  /// joints.
  /// @throws InvalidInput unless the mass is positive, the tensor symmetric, not zero and that of a
  /// distribution of mass (the sum of any two principal moments is not below the third).
  void check() const {
    expects(mass > 0 && std::isfinite(mass), "mass", mass, "positive [kg]");
    expects(centre.allFinite(), "centre", centre.transpose(), "finite [m]");
    const auto rows = tensor.format(Eigen::IOFormat(6, Eigen::DontAlignCols, ", ", "; "));
    expects(tensor.allFinite(), "inertia tensor", rows, "finite [kg m^2]");
    const double rounding = 1e-10 * tensor.cwiseAbs().maxCoeff();
    expects((tensor - tensor.transpose()).cwiseAbs().maxCoeff() <= rounding, "inertia tensor", rows,
            "symmetric [kg m^2]");
    const Vector<3> moments =
        Eigen::SelfAdjointEigenSolver<Matrix<3, 3>>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
    expects(moments[0] >= -rounding && moments[2] > 0, "principal moments of inertia",
            moments.transpose(), "positive, or one of them 0 for a thin rod [kg m^2]");
    expects(moments[0] + moments[1] >= moments[2] - rounding, "principal moments of inertia",
            moments.transpose(), "such that none exceeds the sum of the others [kg m^2]");
  }
};

/// Inertia whose tensor is given about the origin of the body's axes.
inline Inertia about_origin(double mass, const Vector<3>& centre, const Matrix<3, 3>& tensor) {
  const Matrix<3, 3> steiner =
      mass * (centre.squaredNorm() * Matrix<3, 3>::Identity() - centre * centre.transpose());
  return {.mass = mass, .centre = centre, .tensor = tensor - steiner};
}

/// Inertia from the principal moments [kg m^2] about the centre of mass, along the body's axes.
inline Inertia principal(double mass, const Vector<3>& moments,
                         const Vector<3>& centre = Vector<3>::Zero()) {
  return {.mass = mass, .centre = centre, .tensor = moments.asDiagonal()};
}

/// Solid box with edges along the axes; one of zero length is that of a thin plate, whose mass is
/// the density per area times the area.
inline Inertia box(double mass, const Vector<3>& lengths) {
  const Vector<3> s = lengths.cwiseAbs2();
  return principal(mass, mass / 12 * Vector<3>(s[1] + s[2], s[2] + s[0], s[0] + s[1]));
}
inline Inertia solid_box(double density, const Vector<3>& lengths) {
  return box(density * lengths.prod(), lengths);
}

/// Thin rod along the x axis.
inline Inertia rod(double mass, double length) { return box(mass, {length, 0, 0}); }

/// Solid cylinder about the z axis; with a small height, a disc.
inline Inertia solid_cylinder(double density, double radius, double height) {
  const double mass = density * std::numbers::pi * radius * radius * height;
  const double across = mass / 12 * (3 * radius * radius + height * height);
  return principal(mass, {across, across, mass / 2 * radius * radius});
}

/// Solid ball.
inline Inertia solid_ball(double density, double radius) {
  const double mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  return principal(mass, Vector<3>::Constant(0.4 * mass * radius * radius));
}

/// The same matter, moved by `shift` [m].
inline Inertia shifted(const Inertia& inertia, const Vector<3>& shift) {
  return {.mass = inertia.mass, .centre = inertia.centre + shift, .tensor = inertia.tensor};
}

/// The same matter, turned by the rotation matrix R about the origin.
inline Inertia rotated(const Inertia& inertia, const Matrix<3, 3>& R) {
  return {.mass = inertia.mass,
          .centre = R * inertia.centre,
          .tensor = R * inertia.tensor * R.transpose()};
}

/// Both together, by Steiner's theorem.
inline Inertia operator+(const Inertia& a, const Inertia& b) {
  const double mass = a.mass + b.mass;
  const Vector<3> d = b.centre - a.centre;
  const Matrix<3, 3> steiner =
      a.mass * b.mass / mass * (d.squaredNorm() * Matrix<3, 3>::Identity() - d * d.transpose());
  return {.mass = mass,
          .centre = (a.mass * a.centre + b.mass * b.centre) / mass,
          .tensor = a.tensor + b.tensor + steiner};
}

}  // namespace sphmbs::mbs::ncf
