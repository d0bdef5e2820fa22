// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs::ncf {

/// Inertia of a planar body, in its own axes.
struct PlanarInertia {
  double mass;                           ///< [kg]
  Vector<2> centre = Vector<2>::Zero();  ///< centre of mass [m]
  double polar;                          ///< moment of inertia about the centre of mass [kg m^2]

  /// Moment of inertia about the origin [kg m^2].
  double polar_about_origin() const { return polar + mass * centre.squaredNorm(); }

  /// A point mass, polar = 0, is allowed: then a joint has to hold the body's rotation about it.
  /// @throws InvalidInput unless the mass is positive, the moment not negative and all finite.
  void check() const {
    expects(mass > 0 && std::isfinite(mass), "mass", mass, "positive [kg]");
    expects(centre.allFinite(), "centre", centre.transpose(), "finite [m]");
    expects(polar >= 0 && std::isfinite(polar), "polar", polar, "not negative [kg m^2]");
  }
};

}  // namespace sphmbs::mbs::ncf
