// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/clamped.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

using namespace sphmbs::mbs;

/// A point with a mass.
struct Bead {
  using Material = Vector<1>;
  static constexpr std::string_view label = "bead";
  static constexpr int dim = 2, nodes = 1, node_dofs = 2, dofs = 2;
  double mass = 0;  // [kg]
  void check() const {}
  Matrix<2, 2> mass_matrix() const { return mass * Matrix<2, 2>::Identity(); }
  Matrix<2, 2> shape(const Material&) const { return Matrix<2, 2>::Identity(); }
  static Matrix<2, 2> translation() { return Matrix<2, 2>::Identity(); }
  double strain_energy(const Vector<2>&) const { return 0; }
  Vector<2> internal_force(const Vector<2>&, const Vector<2>&) const { return {0, 0}; }
  Matrix<2, 2> tangent(const Vector<2>&, const Vector<2>&, double) const {
    return Matrix<2, 2>::Zero();
  }
  double dissipation(const Vector<2>&, const Vector<2>&) const { return 0; }
};

using Cable = ancf::Cable<2>;
using Slope = Structure<Bead, Cable, joints::Joint<2>, joints::Sliding<Cable>>;

constexpr double mass = 0.5, g = 9.81, from = 0.1, length = 3;  // [kg], [m/s^2], [m], [m]
const Vector<2> down(std::sqrt(3) / 2, -0.5);                   // 30 degrees
const Vector<2> across(0.5, std::sqrt(3) / 2);

/// A bead on a straight rail of three elements that nothing can bend.
Slope slope(joints::SlidingOptions<2> options, double speed = 0) {
  Slope model;
  model.gravity = {0, -g};
  const auto line = ancf::line(
      model,
      {.from = {0, 0},
       .to = length * down,
       .elements = 3,
       .prototype = Cable{.axial_stiffness = 1, .bending_stiffness = 1, .mass_per_length = 1}});
  const auto& rail = line.elements;
  const auto clamp = [&](const Marker<2>& point, const Marker<2>& tangent) {
    model.add(joints::clamped(point, std::vector{tangent}, model.q()));
  };
  for (const auto& cable : rail) clamp(cable.start(), cable.gradient(cable.part.start(), 0));
  clamp(rail[2].end(), rail[2].gradient(rail[2].part.end(), 0));
  const auto bead =
      model.add(Bead{mass}, {model.add_node(Vector<2>(from * down), Vector<2>(speed * down))});
  options.slider = bead.point(Vector<1>(0));
  options.at = from;
  model.add(joints::sliding(model, rail, options));
  return model;
}

template <class System>
void advance(System& system, double until, double dt) {
  const GeneralizedAlpha integrator{.spectral_radius = 0.8};
  while (system.time() < until - 1e-9) integrator.step(system, [&] { return dt; });
}

template <class System>
double arc(System& system) {
  return system.state().q[system.state().q.size() - 1];
}
template <class System>
double speed(System& system) {
  return system.state().v[system.state().v.size() - 1];
}
/// The force of the bead on the rail: multipliers of the joint, the last ones.
template <class System>
Vector<2> reaction(System& system) {
  return system.state().lambda.template tail<2>();
}

}  // namespace

TEST_CASE("a bead slides down a straight rail without friction by g sin(30) t^2 / 2", "[mbs]") {
  Slope model = slope({});
  Dynamics system(model);
  advance(system, 1, 5e-3);
  CHECK(std::abs(arc(system) - (from + 2.4525)) < 1e-9);
  CHECK((reaction(system) + mass * g * std::cos(M_PI / 6) * across).norm() < 1e-6);
}

TEST_CASE("a slider may start at either end of a line, of any number of elements", "[mbs]") {
  for (int elements = 1; elements <= 60; ++elements) {
    Slope model;
    const auto line =
        ancf::line(model, {.from = {0, 0},
                           .to = {4.02, 0},
                           .elements = elements,
                           .prototype = Cable{.axial_stiffness = 1, .mass_per_length = 1}});
    for (const double s : {0.0, line.length}) {
      const auto joint = joints::sliding(model, line.elements, {.slider = line.point(s), .at = s});
      CHECK(joint.element() == (s > 0 ? line.elements.size() - 1 : 0));
    }
  }
}

TEST_CASE("friction slows a bead, and the reaction along the rail is its size", "[mbs]") {
  const double mu = 0.2, c = 0.1;
  const double start = 2, normal = mass * g * std::sqrt(3) / 2;
  const auto run = [&](double dt) {
    Slope model =
        slope({.friction = {.coefficient = mu, .viscous = c, .normal_smoothing = 1e-8}}, start);
    Dynamics system(model);
    const double before = system.energies().total();
    advance(system, 0.4, dt);
    // m w' = m g sin(30) - mu N - c w, at speeds where tanh is 1.
    const double terminal = (mass * g / 2 - mu * normal) / c, rate = c / mass;
    const double w = terminal + (start - terminal) * std::exp(-rate * 0.4);
    const double s =
        from + terminal * 0.4 - (start - terminal) / rate * (std::exp(-rate * 0.4) - 1);
    CHECK(std::abs(speed(system) - w) < 1e-4);
    const Vector<2> lambda = reaction(system);
    CHECK(std::abs(lambda.dot(across) + normal) < 1e-3);
    CHECK(lambda.dot(down) == Approx(mu * normal + c * w).epsilon(1e-3));
    CHECK(system.energies().dissipated > 0.1);
    CHECK(std::abs(system.energies().total() - before) < 1e-3);
    return std::abs(arc(system) - s);
  };
  const double coarse = run(2e-2), fine = run(1e-2);
  CHECK(coarse < 1e-4);
  CHECK(fine < coarse / 3);  // second order
}

TEST_CASE("a bead bounces off a stop with the restitution of its law", "[mbs]") {
  const double damping = 0.02;
  Slope model = slope({.ends = joints::Ends::stop,
                       .stop = {.stiffness = 1e5, .exponent = 1.5, .damping = damping}});
  Dynamics system(model);
  double arrival = 0, furthest = 0;
  while (system.time() < 1.3) {
    GeneralizedAlpha{.spectral_radius = 1}.step(system, [] { return 2e-4; });
    if (arc(system) < length) {
      if (speed(system) < 0) break;
      arrival = speed(system);
    }
    furthest = std::max(furthest, arc(system));
  }
  CHECK(arrival == Approx(std::sqrt(g * (length - from))).epsilon(1e-3));
  CHECK(furthest > length);
  CHECK(furthest < length + 0.04);
  CHECK(-speed(system) == Approx(arrival * (1 - 2.0 / 3 * damping * arrival)).epsilon(0.01));
}

TEST_CASE("a bead that leaves its rail ends the run with the place and the time", "[mbs][fault]") {
  Slope model = slope({.name = "bead"});
  Dynamics system(model);
  const std::string event =
      test::complaint<sphmbs::NumericalFailure>([&] { advance(system, 2, 1e-3); });
  CHECK_THAT(event, Catch::Contains("sliding joint 'bead': at t = 1.088 s the slider has left its "
                                    "rail: s = 3.0"));
}
