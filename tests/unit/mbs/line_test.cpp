// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include <sphmbs/mbs/ancf/beam.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

using namespace sphmbs::mbs;
using namespace sphmbs::mbs::ancf;
using Catch::Matchers::Contains;

namespace {

constexpr double rounding = 1e-13;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

using Planar = Structure<Cable<2>>;
using Spatial = Structure<Cable<3>>;

LineSpec<Cable<2>> wire() {
  return {.from = {1, 2},
          .to = {4, 6},
          .elements = 5,
          .radius = 0.01,
          .density = 7800,
          .youngs_modulus = 2e11};
}

Beam slat() { return {.width = 0.02, .height = 0.05, .density = 1000, .youngs_modulus = 1e9}; }

template <class E, class S>
double energy(const Line<E>& line, const S& structure) {
  double sum = 0;
  for (const auto& element : line.elements)
    sum += element.part.strain_energy(element.local(structure.q()));
  return sum;
}

AlongLine<2> circle(double radius) {
  return {
      .value = [=](double s) -> Vector<2> {
        return radius * Vector<2>(std::cos(s / radius), std::sin(s / radius));
      },
      .gradient = [=](double s) { return Vector<2>(-std::sin(s / radius), std::cos(s / radius)); }};
}

std::string refusal(const LineSpec<Cable<2>>& spec) {
  return test::refusal([&] {
    Planar structure;
    line(structure, spec);
  });
}

}  // namespace

TEST_CASE("a line is straight, free of stress, and its elements share nodes", "[mbs]") {
  Planar structure;
  const auto made = line(structure, wire());
  CHECK(made.elements.size() == 5);
  CHECK(structure.nodes().size() == 6);
  CHECK(structure.coordinates() == 24);
  CHECK(made.length == Approx(5).epsilon(rounding));
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(made.elements[i].number == static_cast<int>(i));
    CHECK(made.elements[i].nodes[0].offset == static_cast<int>(4 * i));
    CHECK(made.elements[i].nodes[1].offset == static_cast<int>(4 * i + 4));
    CHECK(made.elements[i].part.length == Approx(1).epsilon(rounding));
  }
  CHECK(energy(made, structure) < 1e-20 * made.elements[0].part.axial_stiffness);
  const VectorXd q = structure.q();
  for (const double s : {0.0, 0.3, 1.0, 2.75, 5.0}) {
    CHECK((made.point(s).at(q) - Vector<2>(1 + 0.6 * s, 2 + 0.8 * s)).norm() < rounding);
    CHECK((made.gradient(s).at(q) - Vector<2>(0.6, 0.8)).norm() < rounding);
  }
  CHECK((made.start().at(q) - Vector<2>(1, 2)).norm() < rounding);
  CHECK((made.end().at(q) - Vector<2>(4, 6)).norm() < rounding);
  CHECK(structure.v().norm() == 0);
}

TEST_CASE("places on a line are found up to the borders of its elements and its ends", "[mbs]") {
  Planar structure;
  const auto made = line(structure, wire());
  CHECK(made.locate(0).element == 0);
  CHECK(made.locate(0.999).element == 0);
  CHECK(made.locate(1.001).element == 1);
  CHECK(made.locate(4.999).element == 4);
  CHECK(made.locate(5).element == 4);
  CHECK(made.locate(5).x == Approx(1).epsilon(rounding));
  CHECK(made.locate(5.2).element == 4);
  CHECK(made.locate(-0.2).element == 0);
  CHECK(made.locate(-0.2).x == Approx(-0.2).epsilon(rounding));
  for (int k = 0; k <= 50; ++k) {
    const auto place = made.locate(0.1 * k);
    CHECK(place.element + place.x == Approx(0.1 * k).margin(rounding));
    CHECK(place.x > -rounding);
    CHECK(place.x < 1 + rounding);
  }
  CHECK_THAT(test::refusal([&] { made.point(5.1); }), Contains("s = 5.1"));
  CHECK_THAT(test::refusal([&] { made.gradient(undefined); }), Contains("s = nan"));
}

TEST_CASE("a line with an unstretched length of its own is stretched evenly", "[mbs]") {
  auto spec = wire();
  spec.length = 4;
  Planar structure;
  const auto made = line(structure, spec);
  CHECK(made.length == 4);
  const double strain = (1.25 * 1.25 - 1) / 2;
  for (const auto& element : made.elements)
    CHECK(element.part.axial_strain(element.local(structure.q()), Vector<1>(0.3)) ==
          Approx(strain).epsilon(rounding));
}

TEST_CASE("a closed line is a ring with as many nodes as elements", "[mbs]") {
  const double radius = 0.5;
  auto spec = wire();
  spec.curve = circle(radius);
  spec.length = 2 * std::numbers::pi * radius;
  spec.elements = 32;
  spec.closed = true;
  Planar structure;
  const auto made = line(structure, spec);
  CHECK(structure.nodes().size() == 32);
  CHECK(made.elements.back().nodes[1].offset == made.elements.front().nodes[0].offset);
  const auto& cable = made.elements[0].part;
  const double bending = cable.bending_stiffness * *spec.length / (2 * radius * radius);
  CHECK(energy(made, structure) == Approx(bending).epsilon(1e-2));
}

TEST_CASE("a line starts with the rates of a rigid motion and those given along it", "[mbs]") {
  auto spec = wire();
  spec.velocity = {1, -2};
  spec.angular_velocity = 3;
  spec.rates = {.value = [](double s) { return Vector<2>(s * s, 0); },
                .gradient = [](double s) { return Vector<2>(2 * s, 0); }};
  Planar structure;
  const auto made = line(structure, spec);
  const VectorXd v = structure.v();
  for (const double s : {0.0, 0.4, 3.0, 5.0}) {
    const Vector<2> expected(1 - 3 * 0.8 * s + s * s, -2 + 3 * 0.6 * s);
    CHECK((made.point(s).rate(v) - expected).norm() < 1e-12);
    CHECK((made.gradient(s).rate(v) - Vector<2>(-3 * 0.8 + 2 * s, 3 * 0.6)).norm() < 1e-12);
  }
  Spatial space;
  const auto turning = line(space, {.from = {0, 0, 1},
                                    .to = {2, 0, 1},
                                    .elements = 2,
                                    .radius = 0.01,
                                    .density = 1000,
                                    .youngs_modulus = 1e9,
                                    .angular_velocity = {0, -4, 0}});
  CHECK((turning.end().rate(space.v()) - Vector<3>(0, 0, 8)).norm() < rounding);
  CHECK((turning.gradient(0).rate(space.v()) - Vector<3>(0, 0, 4)).norm() < rounding);
}

TEST_CASE("a line joins nodes that exist and takes the element it is given", "[mbs]") {
  Planar structure;
  const auto first = line(structure, wire());
  auto spec = wire();
  spec.from = {4, 6};
  spec.to = {7, 10};
  spec.first_node = first.elements.back().nodes[1];
  const auto second = line(structure, spec);
  CHECK(structure.nodes().size() == 11);
  CHECK(second.elements.front().nodes[0].offset == first.elements.back().nodes[1].offset);
  CHECK(second.elements.front().number == 5);
  spec.to = {7, 9};
  CHECK_THAT(test::refusal([&] { line(structure, spec); }),
             Contains("coordinates of the first node = 4 6 0.6 0.8: must be those of the line"));
  spec.first_node = Node{0, 3};
  CHECK_THAT(test::refusal([&] { line(structure, spec); }), Contains("size of the first node = 3"));

  Structure<Cable<2>, Cable<2, Engineering>> both;
  const auto chosen = line<Cable<2, Engineering>>(
      both, {.to = {3, 0},
             .elements = 3,
             .prototype = Cable<2, Engineering>{
                 .axial_stiffness = 7, .bending_stiffness = 0.1, .mass_per_length = 2}});
  CHECK(chosen.elements[2].part.axial_stiffness == 7);
  CHECK(chosen.elements[2].part.length == 1);
  CHECK(both.all<Cable<2>>().empty());
}

TEST_CASE("a line of beams is free of stress and its section stands upright", "[mbs]") {
  Structure<Beam> structure;
  const auto made = line(structure, {.from = {0, 0, 0},
                                     .to = {2, 2, 1},
                                     .elements = 3,
                                     .prototype = slat(),
                                     .angular_velocity = {1, 2, 3}});
  CHECK(structure.coordinates() == 48);
  CHECK(energy(made, structure) < 1e-18);
  const auto& beam = made.elements[1];
  const Vector<3> x = beam.gradient({0.5, 0, 0}, 0).at(structure.q());
  const Vector<3> y = beam.gradient({0.5, 0, 0}, 1).at(structure.q());
  const Vector<3> z = beam.gradient({0.5, 0, 0}, 2).at(structure.q());
  CHECK((x - Vector<3>(2, 2, 1) / 3).norm() < rounding);
  CHECK(std::abs(y[2]) < rounding);
  CHECK(z[2] > 0);
  CHECK((x.cross(y) - z).norm() < rounding);
  const Vector<3> omega(1, 2, 3);
  CHECK((beam.gradient({0.5, 0, 0}, 2).rate(structure.v()) - omega.cross(z)).norm() < 1e-12);
  CHECK_THAT(test::refusal([&] {
               line(structure, {.to = {0, 0, 1}, .elements = 1, .prototype = slat()});
             }),
             Contains("up = 0 0 1: must be a vector that is not along the line"));
  CHECK_THAT(test::refusal([&] {
               line(structure, {.to = {1, 0, 0}, .elements = 1});
             }),
             Contains("prototype"));
}

TEST_CASE("a line refuses what it cannot be made of", "[mbs]") {
  const auto refused = [](auto change) {
    auto spec = wire();
    change(spec);
    return refusal(spec);
  };
  CHECK(refused([](auto&) {}).empty());
  CHECK(refused([](auto& s) { s.elements = 0; }) == "line: elements = 0: must be 1 or more");
  CHECK_THAT(refused([](auto& s) { s.elements = -3; }), Contains("elements = -3"));
  CHECK(refused([](auto& s) { s.to = s.from; }) == "line: length = 0: must be positive [m]");
  CHECK_THAT(refused([](auto& s) { s.to[0] = undefined; }), Contains("line: to = nan"));
  CHECK_THAT(refused([](auto& s) { s.length = -1; }), Contains("length = -1"));
  CHECK_THAT(refused([](auto& s) {
               s.length = 1;
               s.to = s.from;
             }),
             Contains("distance between from and to"));
  CHECK_THAT(refused([](auto& s) { s.radius = 0; }), Contains("radius = 0"));
  CHECK_THAT(refused([](auto& s) { s.density = -1; }), Contains("density = -1"));
  CHECK_THAT(refused([](auto& s) { s.youngs_modulus = undefined; }), Contains("youngs_modulus"));
  CHECK_THAT(refused([](auto& s) { s.prototype = Cable<2>{}; }), Contains("prototype = given"));
  CHECK_THAT(refused([](auto& s) { s.velocity[1] = undefined; }), Contains("node 0: rates"));
  CHECK_THAT(refused([](auto& s) { s.closed = true; }), Contains("closed"));
  CHECK_THAT(refused([](auto& s) { s.curve.value = circle(1).value; }), Contains("curve"));
  CHECK_THAT(refused([](auto& s) { s.curve = circle(1); }), Contains("length = missing"));
  CHECK_THAT(refused([](auto& s) { s.rates.gradient = circle(1).value; }), Contains("rates"));
  CHECK_THAT(refused([](auto& s) {
               s.curve = circle(1);
               s.length = 5;
               s.closed = true;
             }),
             Contains("node that closes the loop"));
  CHECK_THAT(refused([](auto& s) { s.damping = -1; }), Contains("cable 0 (nodes 0, 1): damping"));
}
