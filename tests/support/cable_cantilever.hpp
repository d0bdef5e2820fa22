// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/forces/point_force.hpp>
#include <sphmbs/mbs/forces/torque.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

#include "support/rods.hpp"

/// Cantilevers made of cables, bent in a plane.
namespace test {

/// For errors of a few times rounding.
inline const sphmbs::mbs::StaticsOptions to_rounding{
    .newton = {.tolerance = 1e-13,
               .max_iterations = 30,
               .refactor = sphmbs::mbs::Refactor::every_iteration}};

template <int Dim>
using CableModel =
    sphmbs::mbs::Structure<sphmbs::mbs::ancf::Cable<Dim, sphmbs::mbs::ancf::Green>,
                           sphmbs::mbs::ancf::Cable<Dim, sphmbs::mbs::ancf::Engineering>,
                           sphmbs::mbs::joints::Joint<Dim>, sphmbs::mbs::forces::PointForce<Dim>,
                           sphmbs::mbs::forces::Torque<Dim>>;

/// Basis of the plane in which a cantilever bends: the plane itself, or a slanted one in space.
template <int Dim>
sphmbs::mbs::Matrix<Dim, 2> bending_plane() {
  sphmbs::mbs::Matrix<Dim, 2> basis = sphmbs::mbs::Matrix<Dim, 2>::Identity();
  if constexpr (Dim == 3) basis.col(1) << 0, 0.6, 0.8;
  return basis;
}

template <int Dim>
sphmbs::mbs::forces::Torque<Dim> tip_moment(const sphmbs::mbs::Marker<Dim>& tangent,
                                            double moment) {
  if constexpr (Dim == 2) {
    return {.on = tangent, .value = moment};
  } else {
    const auto basis = bending_plane<3>();
    return {.on = tangent,
            .axis = sphmbs::mbs::ground<3>(basis.col(0).cross(basis.col(1))),
            .value = moment};
  }
}

struct Bent {
  sphmbs::mbs::Vector<2> tip;  // in the plane [m]
  double angle;                // of the tangent there, in (-pi, pi]
  double aside;                // largest distance from the plane [m]
  sphmbs::mbs::Equilibrium found;
};

/// Cantilever of n cables of type C. Held are the place of its root and the direction of its
/// tangent: the stretch there follows from the load.
template <class C>
Bent bend(const RodLoad& load, int n, const sphmbs::mbs::StaticsOptions& options = {}) {
  using namespace sphmbs::mbs;
  constexpr int dim = C::dim;
  const Matrix<dim, 2> basis = bending_plane<dim>();
  const double mass = 1;
  CableModel<dim> rod;
  const auto line = ancf::line<C>(rod, {.to = load.length * basis.col(0),
                                        .elements = n,
                                        .prototype = C{.axial_stiffness = load.EA,
                                                       .bending_stiffness = load.EI,
                                                       .mass_per_length = mass}});
  rod.gravity = basis * load.line_load / mass;
  rod.add(joints::pinned(line.start(), rod.q()));
  for (int k = 1; k < dim; ++k)
    rod.add(joints::component(line.gradient(0), Vector<dim>::Unit(k), 0.0));
  rod.add(forces::PointForce<dim>{.at = line.end(), .value = basis * load.force});
  rod.add(tip_moment<dim>(line.gradient(line.length), load.moment));

  Bent bent{.tip = {},
            .angle = 0,
            .aside = 0,
            .found = equilibrium<solvers::SparseLDLT, sphmbs::execution::Serial>(rod, options)};
  const VectorXd& q = bent.found.state.q;
  bent.tip = basis.transpose() * line.end().at(q);
  const Vector<2> tangent = basis.transpose() * line.gradient(line.length).at(q);
  bent.angle = std::atan2(tangent[1], tangent[0]);
  for (int i = 0; i <= n; ++i) {
    const Vector<dim> r = line.point(load.length * i / n).at(q);
    bent.aside = std::max(bent.aside, (r - basis * (basis.transpose() * r)).norm());
  }
  return bent;
}

/// Cantilever of unit length and bending stiffness with EA L^2/(EI) = stiffness.
inline RodLoad unit_rod(double stiffness) { return {.length = 1, .EA = stiffness, .EI = 1}; }

/// Cantilever of Gerstmayr and Irschik 2008 (Journal of Sound and Vibration 318) with the tip force
/// 3 EI/L^2.
inline RodLoad gerstmayr_irschik() {
  RodLoad load{.length = 2, .EA = 2.07e9, .EI = 1.725e6};
  load.force = {0, -3 * load.EI / 4};
  return load;
}

/// Displacement of the tip [m].
inline sphmbs::mbs::Vector<2> displacement(const sphmbs::mbs::Vector<2>& tip, const RodLoad& load) {
  return tip - sphmbs::mbs::Vector<2>(load.length, 0);
}

}  // namespace test
