// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/cross.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>

namespace sphmbs::mbs::forces {

/// What a user's law of a spring returns for a length l and its rate l'.
struct Tension {
  double force;            ///< T, pulls its ends together where positive [N]
  double by_length;        ///< dT/dl [N/m]
  double by_rate;          ///< dT/dl' [N s/m]
  double energy = 0;       ///< stored [J]
  double dissipation = 0;  ///< taken out [W]
};

/// Spring and damper between two points: T = k (l - l0) + c l', along the line between them.
template <int Dim>
struct SpringDamper {
  Marker<Dim> from = {};                                             ///< one end
  Marker<Dim> to = {};                                               ///< the other end
  double stiffness = 0;                                              ///< k [N/m]
  double damping = 0;                                                ///< c [N s/m]
  double natural_length = std::numeric_limits<double>::quiet_NaN();  ///< l0 [m]
  std::function<Tension(double, double)> law = {};  ///< T(l, l'); where given, in place of these
  std::string label = "spring-damper";              ///< name in messages and reports
  Marker<Dim> between = to - from;                  ///< follows from the others

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return between.index; }

  void force(VectorIn q, VectorIn v, double, VectorOut f) const {
    const Stretch now = stretch(q, v);
    add_force<Dim>(between, -tension(now.length, now.rate).force * now.axis.along, f);
  }

  void tangent(VectorIn q, VectorIn v, double, MatrixOut k, MatrixOut c) const {
    const Stretch now = stretch(q, v);
    const Tension T = tension(now.length, now.rate);
    const Vector<Dim>& n = now.axis.along;
    const Vector<Dim> turning = now.axis.slope * now.velocity;  // dl'/dd
    const Matrix<Dim, Dim> stiff =
        -n * (T.by_length * n + T.by_rate * turning).transpose() - T.force * now.axis.slope;
    const Matrix<Dim, Dim> viscous = -T.by_rate * n * n.transpose();
    add_tangent<Dim>(between, stiff, k);
    add_tangent<Dim>(between, viscous, c);
  }

  bool conservative() const { return !law; }
  double potential(VectorIn q, double) const { return tension(between.local(q).norm(), 0).energy; }

  double dissipation(VectorIn q, VectorIn v, double) const {
    const Stretch now = stretch(q, v);
    return tension(now.length, now.rate).dissipation;
  }
  ///@}

  /// @throws InvalidInput for a stiffness, damping or natural length below zero, a spring without
  ///         natural length, or ends that are the same point.
  void check() const {
    expects(!is_zero(between), "distance of its ends", 0,
            "positive for some coordinates, as the force has no direction else [m]");
    if (law) return;
    expects(std::isfinite(stiffness) && stiffness >= 0, "stiffness", stiffness,
            "zero or positive [N/m]");
    expects(std::isfinite(damping) && damping >= 0, "damping", damping, "zero or positive [N s/m]");
    expects((std::isfinite(natural_length) && natural_length >= 0) || stiffness == 0,
            "natural_length", natural_length, "given, zero or positive [m]");
  }

 private:
  struct Stretch {
    double length, rate;
    Vector<Dim> velocity;
    Direction<Dim> axis;
  };

  // Ends that coincide have no line between them.
  Stretch stretch(VectorIn q, VectorIn v) const {
    const Vector<Dim> d = between.local(q), velocity = between.N * v;
    const double length = d.norm();
    needs_direction(length, label, "the line between its ends");
    const Direction<Dim> axis(d, length);
    return {length, axis.along.dot(velocity), velocity, axis};
  }

  Tension tension(double length, double rate) const {
    if (law) return law(length, rate);
    const double stretched = stiffness > 0 ? length - natural_length : 0.0;
    return {.force = stiffness * stretched + damping * rate,
            .by_length = stiffness,
            .by_rate = damping,
            .energy = 0.5 * stiffness * stretched * stretched,
            .dissipation = damping * rate * rate};
  }
};

static_assert(Force<SpringDamper<2>> && Force<SpringDamper<3>>);

}  // namespace sphmbs::mbs::forces
