// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <sphmbs/geometry/advice.hpp>
#include <sphmbs/geometry/inspection.hpp>

#include "support/catch.hpp"
#include "support/meshes.hpp"

namespace {

using namespace sphmbs::geometry;
using Catch::Matchers::Contains;
using sphmbs::Vec;

const Box<3> space{{-1, -1, -1}, {3, 3, 3}};

/// The ids of what is said about a surface.
std::string ids(const test::Triangles& t, const Box<3>& box = space) {
  std::string all;
  for (const auto& advice : advise(inspect(t), box)) all += std::string(advice.id) + " ";
  return all;
}

/// As a file of triangles has them: each with points of its own.
test::Triangles torn(const test::Triangles& t) {
  test::Triangles own;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(own.points.size());
    for (const auto& x : t[i]) own.points.push_back(x);
    own.corners.push_back({first, first + 1, first + 2});
  }
  return own;
}

}  // namespace

TEST_CASE("closed surfaces are watertight, also with a point for each corner", "[geometry]") {
  for (const auto& t :
       {test::box({0, 0, 0}, {1, 2, 3}), test::sphere(6, 1), test::torus(20, 10, 1, 0.3)}) {
    const auto seen = inspect(torn(t));
    CHECK(seen.watertight());
    CHECK_FALSE(seen.inside_out());
    CHECK(seen.facets == t.size());
    CHECK(seen.degenerate + seen.duplicate == 0);
    CHECK(seen.volume == Approx(volume(t)));
    CHECK(ids(torn(t)).empty());
  }
  CHECK(inspect(torn(test::box({0, 0, 0}, {1, 2, 3}))).box.upper == Vec<3>{1, 2, 3});
}

TEST_CASE("holes are listed with their place and size, the largest first", "[geometry]") {
  auto t = test::box({0, 0, 0}, {1, 2, 3});
  // A whole face, and of the opposite one a half.
  t.corners.erase(t.corners.begin(), t.corners.begin() + 3);
  const auto seen = inspect(t);
  CHECK_FALSE(seen.watertight());
  REQUIRE(seen.holes.size() == 2);
  CHECK(seen.holes[0].edges + seen.holes[1].edges == 7);
  CHECK(seen.holes[0].size == Approx(std::sqrt(5)));
  const auto& face = seen.holes[seen.holes[0].edges == 4 ? 0 : 1];
  CHECK(face.edges == 4);
  CHECK(face.rim == Approx(6));
  CHECK(face.at == Vec<3>{0.5, 1, 0});
  const auto advice = advise(seen, space);
  REQUIRE(advice.size() == 1);
  CHECK(advice[0].id == "W150");
  CHECK_THAT(advice[0].text, Contains("2 holes") && Contains("4 edges") && Contains("(0.5, 1, 0)"));
}

TEST_CASE("many holes are counted and few listed", "[geometry]") {
  const auto seen = inspect(test::without(test::sphere(20, 1), 0.01, 1));
  CHECK(seen.holes.size() > 20);
  CHECK(std::is_sorted(seen.holes.begin(), seen.holes.end(),
                       [](const auto& a, const auto& b) { return a.size > b.size; }));
  CHECK(advise(seen, space)[0].text.size() < 500);
}

TEST_CASE("facets that contradict, repeat or vanish are counted", "[geometry]") {
  auto turned = test::sphere(5, 1);
  std::swap(turned.corners[7][0], turned.corners[7][1]);
  CHECK(inspect(turned).contradicting == 3);
  CHECK(inspect(turned).holes.empty());
  CHECK(ids(turned) == "W151 ");

  auto twice = test::sphere(5, 1);
  twice.corners.push_back(twice.corners[3]);
  CHECK(inspect(twice).duplicate == 1);
  CHECK(inspect(twice).branched == 3);
  CHECK(ids(twice) == "W151 W152 ");

  auto flat = test::sphere(5, 1);
  flat.corners.push_back({4, 4, 2});
  CHECK(inspect(flat).degenerate == 1);
  CHECK(inspect(flat).watertight());
  CHECK(ids(flat) == "W152 ");

  auto all = test::sphere(5, 1);
  for (auto& c : all.corners) std::swap(c[0], c[1]);
  CHECK(inspect(all).watertight());
  CHECK(inspect(all).inside_out());
}

TEST_CASE("a size of another unit and a place outside are told", "[geometry]") {
  const auto ball = test::sphere(5, 1);
  const auto scaled = [&](double s) {
    return mapped(ball, [s](const Vec<3>& x) { return s * x; });
  };
  CHECK(ids(scaled(1000)) == "W153 ");
  CHECK(ids(scaled(1e-4)) == "W153 ");
  CHECK(ids(scaled(0.1)).empty());
  CHECK(ids(mapped(ball, [](const Vec<3>& x) { return x + Vec<3>{9, 0, 0}; })) == "W154 ");
  CHECK_THAT(advise(inspect(scaled(1000)), space)[0].text, Contains("0.001 for millimetres"));
}

TEST_CASE("outlines are looked over too", "[geometry]") {
  const Facets<2> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  CHECK(inspect(square).watertight());
  CHECK(inspect(square).volume == 1);
  auto open = square;
  open.corners.pop_back();
  CHECK(inspect(open).holes.size() == 2);
  auto turned = square;
  std::swap(turned.corners[1][0], turned.corners[1][1]);
  CHECK(inspect(turned).contradicting == 2);
  CHECK(inspect(Facets<2>{}).watertight() == false);
}
