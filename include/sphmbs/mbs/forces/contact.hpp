// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/frame.hpp>
#include <sphmbs/mbs/forces/penalty.hpp>

namespace sphmbs::mbs::forces {

/// Distance of a surface from a point, in the frame of the surface.
template <int Dim>
struct Distance {
  double value;                ///< positive outside [m]
  Vector<Dim> normal;          ///< outwards, its gradient
  Matrix<Dim, Dim> curvature;  ///< its Hessian [1/m]
};

/// The half space below the plane through the origin of a frame, across its last vector.
template <int Dim>
struct Plane {
  static constexpr int dim = Dim;  ///< dimension of space

  /// Of a point x, in the frame of the surface, with its derivatives.
  Distance<Dim> distance(const Vector<Dim>& x) const {
    return {x[Dim - 1], Vector<Dim>::Unit(Dim - 1), Matrix<Dim, Dim>::Zero()};
  }
  /// @throws InvalidInput for a surface that is none.
  void check() const {}
};

/// The ball, in the plane the disc, around the origin of a frame.
template <int Dim>
struct Sphere {
  static constexpr int dim = Dim;  ///< dimension of space
  double radius = 0;               ///< [m]

  /// Of a point x, in the frame of the surface, with its derivatives.
  Distance<Dim> distance(const Vector<Dim>& x) const {
    const double length = x.norm();
    needs_direction(length, "sphere", "the line from its centre to the point in contact");
    const Direction<Dim> n(x, length);
    return {length - radius, n.along, n.slope};
  }
  /// @throws InvalidInput for a surface that is none.
  void check() const {
    expects(std::isfinite(radius) && radius > 0, "radius of the sphere", radius, "positive [m]");
  }
};

/// Penalty contact of a point, or of a ball around it, with a plane or a sphere that the ground or
/// a body carries. Along the normal n, into the point, `law`; across it Coulomb's friction, smooth
/// where the slip w reverses:
///   F = N (n - mu w / sqrt(|w|^2 + w0^2)),
/// where w is the rate of the point across n as seen from the frame of the surface, so that a body
/// that carries both feels no friction. Below w0 the point creeps instead of sticking. Friction
/// acts at the point and knows nothing of a spin of the ball around it.
///
///   forces::Contact<forces::Plane<2>> floor{.point = bar.end(),
///                                           .frame = forces::ground_frame<2>({0, 0}, {0, 1})};
template <class Surface>
struct Contact {
  static constexpr int dim = Surface::dim;  ///< dimension of space

  Marker<dim> point = {};  ///< what touches the surface, or the centre of the ball that does
  double radius = 0;       ///< of the ball around the point [m]
  Frame<dim> frame = joints::ground_frame<dim>(Vector<dim>::Zero());  ///< of the surface
  Surface surface = {};           ///< plane or sphere, in its frame
  Penalty law = {};               ///< push along the normal
  double friction = 0;            ///< mu [-]
  double creep_velocity = 1e-2;   ///< w0 [m/s]
  std::string label = "contact";  ///< name in messages and reports
  /// Point and frame, on all their coordinates.
  Marker<RelativePosition<dim>::size> y =  // follows from the others
      RelativePosition<dim>::y(frame, point);

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return y.index; }

  void force(VectorIn q, VectorIn v, double, VectorOut f) const {
    const Y now = y.local(q), velocity = y.N * v;
    const auto J = RelativePosition<dim>::jacobian(now);
    const Vector<dim> F = law_of(surface_at(now), J * velocity).force;
    add_force<size>(y, J.transpose() * F, f);
  }

  void tangent(VectorIn q, VectorIn v, double, MatrixOut k, MatrixOut c) const {
    const Y now = y.local(q), velocity = y.N * v;
    const Distance<dim> distance = surface_at(now);
    if (distance.value >= 0) return;
    const auto J = RelativePosition<dim>::jacobian(now);
    const Pressed F = law_of(distance, J * velocity);
    const Matrix<size, size> stiff =
        J.transpose() *
            (F.by_place * J + F.by_velocity * RelativePosition<dim>::jacobian(velocity)) +
        RelativePosition<dim>::hessian(F.force);
    const Matrix<size, size> viscous = J.transpose() * F.by_velocity * J;
    add_tangent(y, stiff, k);
    add_tangent(y, viscous, c);
  }

  /// The force on the point, in components along the vectors of the frame [N].
  Vector<dim> force_on_point(VectorIn q, VectorIn v) const {
    const Y now = y.local(q), velocity = y.N * v;
    return law_of(surface_at(now), RelativePosition<dim>::jacobian(now) * velocity).force;
  }

  bool conservative() const { return true; }
  double potential(VectorIn q, double) const {
    return law.push(-surface_at(y.local(q)).value, 0).energy;
  }

  double dissipation(VectorIn q, VectorIn v, double) const {
    const Y now = y.local(q), velocity = y.N * v;
    return law_of(surface_at(now), RelativePosition<dim>::jacobian(now) * velocity).dissipation;
  }
  ///@}

  /// @throws InvalidInput for a frame without vectors, a radius, stiffness, damping or friction
  /// below zero, an exponent outside [1, 3], or a sphere or creep velocity that is not positive.
  void check() const {
    expects(point.N.size() > 0, "point", "missing", "a point of a part");
    forces::check(frame, "frame");
    surface.check();
    law.check();
    expects(std::isfinite(radius) && radius >= 0, "radius", radius, "zero or positive [m]");
    expects(std::isfinite(friction) && friction >= 0, "friction", friction, "zero or positive [-]");
    expects(std::isfinite(creep_velocity) && creep_velocity > 0, "creep_velocity", creep_velocity,
            "positive [m/s]");
  }

 private:
  static constexpr int size = RelativePosition<dim>::size;
  using Y = Vector<size>;

  struct Pressed {
    Vector<dim> force;
    Matrix<dim, dim> by_place, by_velocity;
    double dissipation;
  };

  Distance<dim> surface_at(const Y& now) const {
    Distance<dim> distance = surface.distance(RelativePosition<dim>::value(now));
    distance.value -= radius;
    return distance;
  }

  Pressed law_of(const Distance<dim>& distance, const Vector<dim>& velocity) const {
    const Vector<dim>& n = distance.normal;
    const double approach = -n.dot(velocity);
    const Penalty::Push N = law.push(-distance.value, approach);
    const Matrix<dim, dim> across = Matrix<dim, dim>::Identity() - n * n.transpose();
    const Vector<dim> slip = across * velocity;
    const double speed = std::sqrt(slip.squaredNorm() + creep_velocity * creep_velocity);
    const Vector<dim> mobilised = friction / speed * slip;  // mu w / sqrt(|w|^2 + w0^2)
    const Vector<dim> direction = n - mobilised;

    const Vector<dim> turning = distance.curvature * velocity;  // -d approach / dx
    const Vector<dim> push_by_place = -N.by_depth * n - N.by_rate * turning;
    const Matrix<dim, dim> mobilised_by_slip = friction / speed * Matrix<dim, dim>::Identity() -
                                               mobilised * slip.transpose() / (speed * speed);
    const Matrix<dim, dim> slip_by_place = approach * distance.curvature - n * turning.transpose();
    return {.force = N.force * direction,
            .by_place = direction * push_by_place.transpose() +
                        N.force * (distance.curvature - mobilised_by_slip * slip_by_place),
            .by_velocity =
                -N.by_rate * direction * n.transpose() - N.force * mobilised_by_slip * across,
            .dissipation = N.dissipation + N.force * mobilised.dot(slip)};
  }
};

static_assert(Force<Contact<Plane<2>>> && Force<Contact<Plane<3>>>);
static_assert(Force<Contact<Sphere<2>>> && Force<Contact<Sphere<3>>>);

}  // namespace sphmbs::mbs::forces
