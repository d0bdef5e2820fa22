// SPDX-License-Identifier: MIT
// Sliding on flexible cables, against its limits and itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance, test::exactly;

namespace {

using Cable = ancf::Cable<2>;
using Slider = joints::Sliding<Cable>;
using Model = Structure<Cable, ncf::Bar, ncf::PlanarBody, joints::Joint<2>, Slider>;
using System = test::SingleThreaded<Model, solvers::SparseLU>;

constexpr double g = 9.81, mass = 0.5;  // [m/s^2], of a bead [kg]

/// A cable from the origin to a point, pinned at both ends.
ancf::Line<Cable> pinned_cable(Model& model, const Vector<2>& to, int elements,
                               const Cable& prototype) {
  model.gravity = {0, -g};
  const auto line = ancf::line(model, {.to = to, .elements = elements, .prototype = prototype});
  model.add(joints::pinned(line.start(), model.q(), "first end"));
  model.add(joints::pinned(line.end(), model.q(), "last end"));
  return line;
}

/// Light and all but rigid.
Cable stiff(double bending_stiffness, double mass_per_length) {
  return {.axial_stiffness = 1e3 * bending_stiffness,
          .bending_stiffness = bending_stiffness,
          .mass_per_length = mass_per_length};
}

/// A bead at 0.1 m on a cable, at a speed along it.
struct BeadOnCable {
  Model model;
  ancf::Line<Cable> line;
  Placed<ncf::PlanarBody> bead;
  Marker<1> arc;

  BeadOnCable(const Vector<2>& to, int elements, const Cable& prototype,
              joints::SlidingOptions<2> options = {}, double speed = 0)
      : line(pinned_cable(model, to, elements, prototype)),
        bead(model.add(ncf::PlanarBody{.inertia = {.mass = mass, .polar = 1e-3},
                                       .position = 0.1 * to.normalized(),
                                       .velocity = speed * to.normalized()})) {
    options.slider = point();
    options.at = 0.1;
    const Slider joint = joints::sliding(model, line.elements, options);
    arc = joint.arc();
    model.add(joint);
  }
  Marker<2> point() const { return bead.point({0, 0}); }
  double way(const System& system) const { return arc.at(system.state().q)[0] - 0.1; }
  double rate(const System& system) const { return arc.rate(system.state().v)[0]; }
};

Vector<2> downhill(double angle) { return 3 * Vector<2>(std::cos(angle), -std::sin(angle)); }

/// The double pendulum of two bars whose first point A slides on a rigid horizontal wire: places of
/// A and of the tip C, by its equations of minimal coordinates.
struct OnWire {
  double t, A_x, C_x, C_y;
};
constexpr std::array<OnWire, 10> on_wire{{{0.1, 4.0190863, 3.019697, -1.0551513},
                                          {0.2, 4.0052426, 3.0150734, -1.2203306},
                                          {0.3, 3.941468, 2.9936862, -1.4916283},
                                          {0.4, 3.7114668, 2.9251465, -1.826868},
                                          {0.5, 3.0042357, 3.1004608, -1.7973903},
                                          {0.6, 2.6309509, 3.6388014, -1.6052882},
                                          {0.7, 2.4897042, 4.1175047, -1.1380836},
                                          {0.8, 2.6301864, 4.1130683, -0.51487765},
                                          {0.9, 2.8969133, 3.7746294, -0.13024119},
                                          {1, 3.2194806, 3.3562381, -0.0048994168}}};

/// Largest distances of A and C from these up to 0.4, 0.6 and 1 s.
std::array<double, 3> apart_from_wire(double bending_stiffness) {
  Model model;
  const auto line = pinned_cable(model, {4.02, 0}, 6, stiff(bending_stiffness, 0.0368));
  const auto bar = [&](const Vector<2>& from, const Vector<2>& to) {
    return model.add(ncf::Bar{
        .from = from, .to = to, .density = 349.45, .area = 0.0874 * 0.0874, .height = 0.0874});
  };
  const auto upper = bar({4.02, 0}, {3.02, 0}), lower = bar({3.02, 0}, {3.02, -1});
  model.add(joints::revolute(upper.end(), lower.start(), "B"));
  model.add(joints::sliding(model, line.elements, {.slider = upper.start(), .at = 4.02}));
  System system(model);
  std::array<double, 3> apart{};
  for (const OnWire& row : on_wire) {
    advance(system, {}, row.t, 5e-4);
    const VectorXd& q = system.state().q;
    const std::size_t span = row.t < 0.45 ? 0 : row.t < 0.65 ? 1 : 2;
    apart[span] = std::max({apart[span], (upper.start().at(q) - Vector<2>(row.A_x, 0)).norm(),
                            (lower.end().at(q) - Vector<2>(row.C_x, row.C_y)).norm()});
  }
  return apart;
}

/// Course of a bead that begins with 2 m/s on a soft cable: arc, its place and the middle of the
/// cable each 50 ms.
struct Ride {
  std::vector<double> places;
  int borders = 0;   // crossed
  double drift = 0;  // largest change of the total energy [J]
};

const Vector<2> sloping(3, -1);
const Cable soft{.axial_stiffness = 2e3, .bending_stiffness = 5, .mass_per_length = 1};

Ride ride(int elements, double step) {
  BeadOnCable cable(sloping, elements, soft, {}, 2);
  System system(cable.model);
  Ride ride;
  const double start = system.energies().total();
  std::size_t element = 0;
  for (int k = 1; k <= 14; ++k) {
    advance(system, {.newton = exactly}, 0.05 * k, step, [&](System& s) {
      const std::size_t now = cable.model.all<Slider>()[0].element();
      ride.borders += now != element;
      element = now;
      ride.drift = std::max(ride.drift, std::abs(s.energies().total() - start));
    });
    const VectorXd& q = system.state().q;
    const Vector<2> bead = cable.point().at(q), middle = cable.line.point(1.5).at(q);
    ride.places.insert(ride.places.end(),
                       {cable.way(system), bead[0], bead[1], middle[0], middle[1]});
  }
  return ride;
}

double apart(const Ride& a, const Ride& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.places.size(); ++k)
    largest = std::max(largest, std::abs(a.places[k] - b.places[k]));
  return largest;
}

}  // namespace

TEST_CASE("a bead slides down a cable at 30 degrees by g sin(30) t^2 / 2 as the cable gets stiffer",
          "[mbs]") {
  double before = 0;
  for (const double bending_stiffness : {1e4, 1e5, 1e6}) {
    BeadOnCable cable(downhill(std::numbers::pi / 6), 6, stiff(bending_stiffness, 1e-3));
    System system(cable.model);
    advance(system, {}, 1, 2e-3);
    const double error = std::abs(cable.way(system) - 2.4525);
    CAPTURE(bending_stiffness, error);
    if (before > 0) CHECK(before / error == Approx(10).epsilon(0.1));
    before = error;
  }
  CHECK(before < 6e-6);
}

TEST_CASE("Coulomb friction slows a bead on a cable, or leaves it creeping", "[mbs]") {
  const double mu = 0.2, creep = 1e-4;
  const joints::SlidingOptions<2> options{
      .friction = {.coefficient = mu, .creep_velocity = creep, .normal_smoothing = 1e-6}};
  {
    const double angle = std::numbers::pi / 6;
    BeadOnCable cable(downhill(angle), 6, stiff(1e6, 1e-3), options);
    System system(cable.model);
    const double start = system.energies().total();
    advance(system, {}, 1, 1e-3);
    const double a = g * (std::sin(angle) - mu * std::cos(angle));
    const Energies e = system.energies();
    CHECK(std::abs(cable.way(system) - a / 2) < 1.5e-5);
    CHECK(std::abs(cable.rate(system) - a) < 2e-5);
    CHECK(e.dissipated == Approx(mu * mass * g * std::cos(angle) * a / 2).epsilon(1.5e-5));
    CHECK(std::abs(e.total() - start) < 2e-6);
  }
  {
    // mu N tanh(w / w0) = m g sin(angle)
    const double angle = std::atan(0.1);
    BeadOnCable cable(downhill(angle), 6, stiff(1e6, 1e-3), options);
    System system(cable.model);
    advance(system, {}, 0.5, 2e-3);
    CHECK(cable.rate(system) == Approx(creep * std::atanh(0.5)).epsilon(2e-5));
    CHECK(cable.way(system) < 0.5 * creep);
  }
}

TEST_CASE("a double pendulum sliding on a stiff cable tends to that on a rigid wire", "[mbs]") {
  const auto softer = apart_from_wire(1e6), harder = apart_from_wire(1e7);
  const std::array<double, 3> allowed{6e-6, 1.5e-4, 3e-4};
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(k, softer[k], harder[k]);
    CHECK(harder[k] < allowed[k]);
    CHECK(softer[k] > 5 * harder[k]);
  }
}

TEST_CASE("crossing borders of elements keeps energy and the order of the path", "[mbs]") {
  for (const auto& [elements, borders] : {std::pair(6, 4), std::pair(12, 9)}) {
    const Ride reference = ride(elements, 6.25e-5), coarse = ride(elements, 1e-3),
               fine = ride(elements, 2.5e-4);
    const double coarse_error = apart(coarse, reference), fine_error = apart(fine, reference);
    CAPTURE(elements, coarse_error, fine_error, coarse.drift, fine.drift);
    CHECK(reference.borders == borders);
    CHECK(fine_error < 6e-6);
    CHECK(fine.drift < 4e-5);
    CHECK(std::log2(coarse_error / fine_error) / 2 > 1.8);
    CHECK(std::log2(coarse.drift / fine.drift) / 2 == Approx(2).margin(0.1));
  }
}

TEST_CASE("a bead rebounds from a stop at the end of a cable, and the energy is accounted for",
          "[mbs]") {
  BeadOnCable cable(
      sloping, 6, soft,
      {.ends = joints::Ends::stop, .stop = {.stiffness = 1e5, .exponent = 1.5, .damping = 0.05}},
      2);
  System system(cable.model);
  const double start = system.energies().total(), turnover = mass * g;
  double drift = 0, furthest = 0, stored = 0, back = 0, lost = 0, regained = 0;
  advance(system, {}, 1, 1e-4, [&](System& s) {
    const Energies e = s.energies();
    drift = std::max(drift, std::abs(e.total() - start));
    stored = std::max(stored, e.springs);
    regained = std::max(regained, lost - e.dissipated);
    lost = e.dissipated;
    furthest = std::max(furthest, cable.way(s) + 0.1);
    back = std::min(back, cable.rate(s));
  });
  CAPTURE(drift, furthest, stored, back, lost, regained);
  CHECK(furthest > cable.line.length);
  CHECK(furthest < cable.line.length + 0.06);
  CHECK(back < -3);
  CHECK(stored > turnover / 2);
  CHECK(lost > 0.1 * turnover);
  CHECK(regained < 1e-12);
  CHECK(drift < 3e-4 * turnover);
}
