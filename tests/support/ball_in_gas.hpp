// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/sphmbs.hpp>

#include <sphmbs/coupling/staggered.hpp>
#include <sphmbs/coupling/strong.hpp>

#include "support/clouds.hpp"

namespace test {

/// A free rigid disk, which may spin, in a periodic box of gas. Everything that a coupled run needs
/// stays together.
template <class Gas, class Policy = sphmbs::execution::Serial>
class BallInGas {
 public:
  static constexpr int set = 1;  // of the disk's virtual particles

  struct Plan {
    double spacing = 0.1;          // [m]
    double side = 3;               // of the box [m]
    double radius = 0.6;           // [m]
    double mass_ratio = 1;         // of the disk to the gas in its place
    sphmbs::Vec<2> velocity = {};  // of the disk [m/s]
    double spin = 0;               // [rad/s]
    std::uint64_t disorder = 0;    // seed of the gas's; 0: a lattice at rest
    double background = 1;         // of the gas's pressure
    bool sticks = false;
  };
  using Fluid = sphmbs::sph::Fluid<Gas, Policy, sphmbs::coupling::Riding<2>>;
  using Structure = sphmbs::mbs::Structure<sphmbs::mbs::ncf::PlanarBody>;
  using Bodies = sphmbs::mbs::Dynamics<Structure, sphmbs::mbs::solvers::SparseLU, Policy>;
  using Surface = sphmbs::coupling::WettedSurface<2, Policy>;

  explicit BallInGas(const Plan& plan)
      : plan_(plan),
        surface(plan.sticks),
        cloud_(cloud()),
        body(structure.add(disk())),
        fluid(gas(), domain(), cloud_, motion()),
        bodies(structure),
        system(fluid, bodies, surface) {}

  double mass() const { return plan_.mass_ratio * sphmbs::math::pi * plan_.radius * plan_.radius; }
  sphmbs::mbs::Vector<2> velocity() const { return body.point({0, 0}).rate(bodies.state().v); }

 private:
  Plan plan_;

 public:
  Structure structure;
  Surface surface;

 private:
  sphmbs::particles::Cloud<2> cloud_;

 public:
  sphmbs::mbs::Placed<sphmbs::mbs::ncf::PlanarBody> body;
  Fluid fluid;
  Bodies bodies;
  sphmbs::coupling::Immersed<Fluid, Bodies, Surface> system;

 private:
  sphmbs::geometry::Domain<2> domain() const { return cube<2>(plan_.side, true); }

  Gas gas() const {
    Gas gas{.eos = {.gamma = 1.4}};
    if constexpr (Gas::Wall::surfaces) gas.background = plan_.background;
    return gas;
  }

  sphmbs::particles::Cloud<2> cloud() {
    namespace geometry = sphmbs::geometry;
    const double dx = plan_.spacing, middle = plan_.side / 2;
    const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
    const geometry::Ball<2> ball{.centre = {middle, middle}, .radius = plan_.radius};
    const sphmbs::particles::State<2> still{.rho = 1, .p = 1};
    sphmbs::particles::Cloud<2> cloud;
    cloud.add_gas(lattice.points(domain().box - ball, domain()), still, {dx});
    if (plan_.disorder != 0) disturb(cloud, dx, plan_.disorder);
    cloud.add_virtual(lattice.inner_points(ball, domain()), still, {dx}, ball);
    return cloud;
  }

  sphmbs::mbs::ncf::PlanarBody disk() const {
    const double middle = plan_.side / 2, m = mass();
    return {.inertia = {.mass = m, .polar = m * plan_.radius * plan_.radius / 2},
            .position = {middle, middle},
            .velocity = {plan_.velocity[0], plan_.velocity[1]},
            .angle = 0.3,
            .angular_velocity = plan_.spin};
  }

  typename Surface::Motion motion() {
    const auto q = structure.q();
    surface.tie(cloud_, set, sphmbs::coupling::points_of(body, q, cloud_, set), q);
    return surface.motion();
  }
};

}  // namespace test
