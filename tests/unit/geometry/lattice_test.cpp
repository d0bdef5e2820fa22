// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <sphmbs/geometry/ball.hpp>
#include <sphmbs/geometry/lattice.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"

namespace {

using namespace sphmbs::geometry;
using Catch::Matchers::Contains;
using sphmbs::Vec;

}  // namespace

TEST_CASE("the pipe around a cylinder has the paper's numbers of particles", "[geometry]") {
  const double spacing = 0.1;
  const Domain<2> pipe{{{0, 0}, {100, 50}}, {true, false}};
  const Lattice<2> lattice{spacing};
  // r^2 <= 10001 spacing^2: no lattice point lies between that and this ball.
  const Ball<2> cylinder{{40, 25}, 10 + 0.01 * spacing};
  CHECK(lattice.points(pipe.box - cylinder, pipe).size() == 469567);
  CHECK(lattice.points(cylinder, pipe).size() == 31433);
  CHECK(lattice.points(pipe.box, pipe).size() == 1000 * 501);
  const double layers = 5 * spacing;
  CHECK(
      lattice.inner_points(pipe.box.grown(layers + spacing / 2) - pipe.box, pipe, layers).size() ==
      10000);
}

TEST_CASE("the sealed cavity has the paper's numbers of particles", "[geometry]") {
  const double spacing = 0.01;
  const Domain<2> cavity{{{-0.5, -0.5}, {0.5, 0.5}}, {false, false}};
  const Lattice<2> lattice{spacing, {spacing / 2, spacing / 2}};
  const auto gas = lattice.points(cavity.box, cavity);
  CHECK(gas.size() == 10000);
  CHECK(gas.front()[0] == Approx(-0.495));
  CHECK(gas.back()[1] == Approx(0.495));
  const double layers = 5 * spacing;
  CHECK(lattice.inner_points(cavity.box.grown(layers) - cavity.box, cavity, layers).size() ==
        110 * 110 - 100 * 100);
}

TEST_CASE("the spatial channel has the paper's numbers of particles", "[geometry]") {
  for (const int per_metre : {5, 9}) {
    const double spacing = 1.0 / per_metre;
    const Domain<3> channel{{{0, 0, 0}, {10, 5, 7}}, {true, false, false}};
    const Lattice<3> lattice{spacing};
    const int n = per_metre;
    const auto inside = lattice.points(channel.box, channel).size();
    CHECK(inside == static_cast<std::size_t>(10 * n * (5 * n + 1) * (7 * n + 1)));
    const double layers = 4 * spacing;
    const auto all = lattice.points(channel.box.grown(layers), channel, layers).size();
    CHECK(all == static_cast<std::size_t>(10 * n * (5 * n + 9) * (7 * n + 9)));
  }
}

TEST_CASE("points on a border are there once where it is periodic, and on both sides where not",
          "[geometry]") {
  const auto count = [](const Domain<1>& domain, const Lattice<1>& lattice) {
    return lattice.points(domain.box, domain).size();
  };
  const Domain<1> closed{{{0}, {1}}, {false}};
  const Domain<1> periodic{{{0}, {1}}, {true}};
  for (const double spacing : {0.1, 1.0 / 3, 1.0 / 7, 0.05}) {
    const auto intervals = static_cast<std::size_t>(std::lround(1 / spacing));
    CAPTURE(spacing);
    CHECK(count(closed, {spacing}) == intervals + 1);
    CHECK(count(periodic, {spacing}) == intervals);
    CHECK(count(closed, {spacing, {1}}) == intervals + 1);
    CHECK(count(periodic, {spacing, {1}}) == intervals);
    CHECK(count(closed, {spacing, {spacing / 2}}) == intervals);
    CHECK(count(periodic, {spacing, {spacing / 2}}) == intervals);
    CHECK(count(periodic, {spacing, {-17 * spacing}}) == intervals);
  }
}

TEST_CASE("lattice points lie inside the box wherever it begins", "[geometry]") {
  const Domain<1> domain{{{-3.7}, {-1.2}}, {true}};
  const auto points = Lattice<1>{0.25, {0.1}}.points(domain.box, domain);
  REQUIRE(points.size() == 10);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(points[i][0] == Approx(-3.65 + 0.25 * static_cast<double>(i)));
}

TEST_CASE("inner points are the points less those on the surface", "[geometry]") {
  const auto domain = test::cube<2>(4, false);
  const Lattice<2> lattice{1};
  CHECK(lattice.points(domain.box, domain).size() == 25);
  CHECK(lattice.inner_points(domain.box, domain).size() == 9);
  const Ball<2> ball{{2, 2}, 1};
  CHECK(lattice.points(ball, domain).size() == 5);
  CHECK(lattice.inner_points(ball, domain).size() == 1);
}

TEST_CASE("rounding decides for no point on a surface", "[geometry]") {
  // None of these spacings and shifts is a binary number.
  for (const double shift : {0.0, 0.1, 1e3 + 0.3}) {
    const double spacing = 0.1;
    const Domain<2> domain{{{shift, shift}, {shift + 0.7, shift + 0.7}}, {false, false}};
    const Lattice<2> lattice{spacing, {shift, shift}};
    CHECK(lattice.points(domain.box, domain).size() == 64);
    CHECK(lattice.inner_points(domain.box, domain).size() == 36);
  }
}

TEST_CASE("points come in lexicographic order, last axis fastest", "[geometry]") {
  const auto domain = test::cube<3>(1, false);
  const auto points = Lattice<3>{0.5}.points(domain.box, domain);
  REQUIRE(points.size() == 27);
  CHECK(points[0] == Vec<3>{0, 0, 0});
  CHECK(points[1] == Vec<3>{0, 0, 0.5});
  CHECK(points[3] == Vec<3>{0, 0.5, 0});
  CHECK(points[9] == Vec<3>{0.5, 0, 0});
  CHECK(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.component, a.component + 3, b.component, b.component + 3);
  }));
}

TEST_CASE("the margin lets points lie outside the box but along no periodic axis", "[geometry]") {
  const Domain<2> domain{{{0, 0}, {1, 1}}, {true, false}};
  const Lattice<2> lattice{0.25};
  const auto everywhere = Box<2>{{-9, -9}, {9, 9}};
  const auto points = lattice.points(everywhere, domain, 0.5);
  CHECK(points.size() == 4 * 9);
  for (const auto& x : points) {
    CHECK(x[0] >= 0);
    CHECK(x[0] < 1);
  }
}

TEST_CASE("a spacing that is not positive or does not divide a period is refused", "[geometry]") {
  const auto refusal = [](double spacing, bool periodic) {
    const auto domain = test::cube<2>(1, periodic);
    return test::refusal([&] { Lattice<2>{spacing}.points(domain.box, domain); });
  };
  CHECK(refusal(0.3, false).empty());
  CHECK(refusal(0.1, true).empty());
  CHECK_THAT(refusal(0.3, true), Contains("spacing = 0.3") && Contains("periodic length 1.0"));
  CHECK_THAT(refusal(3, true), Contains("spacing = 3"));
  CHECK_THAT(refusal(0, false), Contains("spacing = 0"));
  CHECK_THAT(refusal(-0.1, false), Contains("spacing = -0.1"));
  CHECK_THAT(refusal(std::numeric_limits<double>::quiet_NaN(), false), Contains("spacing = nan"));
  const auto inside_out = test::cube<2>(-1, false);
  CHECK_THAT(test::refusal([&] { Lattice<2>{0.1}.points(inside_out.box, inside_out); }),
             Contains("domain length = -1"));
}
