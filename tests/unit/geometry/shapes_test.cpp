// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <sphmbs/geometry/ball.hpp>
#include <sphmbs/geometry/box.hpp>
#include <sphmbs/geometry/capsule.hpp>
#include <sphmbs/geometry/polygon.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"

namespace {

using namespace sphmbs::geometry;
using sphmbs::Vec;

constexpr double rounding = 1e-14;

/// Length of the gradient of the signed distance, by central differences of step 1e-6, whose error
/// is 1e-10 by rounding and 1e-12 by the curvature of the distance.
template <class S>
double steepness(const S& shape, const Vec<S::dim>& x) {
  constexpr double step = 1e-6;
  double sum = 0;
  for (int k = 0; k < S::dim; ++k) {
    Vec<S::dim> ahead = x;
    Vec<S::dim> behind = x;
    ahead[k] += step;
    behind[k] -= step;
    const double slope = (shape.distance(ahead) - shape.distance(behind)) / (2 * step);
    sum += slope * slope;
  }
  return std::sqrt(sum);
}

/// The gradient has length 1 at random points, but at those within a step of a kink, of which there
/// are few.
template <class S>
void check_steepness(const S& shape, std::uint64_t seed) {
  test::Random random(seed);
  int kinks = 0;
  for (int trial = 0; trial < 1000; ++trial)
    kinks += std::abs(steepness(shape, random.vector<S::dim>(3)) - 1) > 1e-8 ? 1 : 0;
  CHECK(kinks <= 1);
}

}  // namespace

TEST_CASE("the distance from a box is that from its nearest face, edge or corner", "[geometry]") {
  const Box<2> box{{-1, 0}, {3, 2}};
  CHECK(box.distance({1, 1}) == -1);
  CHECK(box.distance({2.75, 1}) == -0.25);
  CHECK(box.distance({3, 1}) == 0);
  CHECK(box.distance({3, 2}) == 0);
  CHECK(box.distance({5, 1}) == 2);
  CHECK(box.distance({6, 6}) == 5);
  CHECK(box.distance({-4, -4}) == 5);
  CHECK(Box<1>{{2}, {5}}.distance({3}) == -1);
  CHECK(Box<1>{{2}, {5}}.distance({7}) == 2);
  CHECK(Box<3>{{0, 0, 0}, {1, 1, 1}}.distance({3, 4, 7}) == 7);
  CHECK(box.length(0) == 4);
  CHECK(box.length(1) == 2);
  CHECK(box.grown(0.5).lower == Vec<2>{-1.5, -0.5});
  CHECK(box.grown(0.5).upper == Vec<2>{3.5, 2.5});
  check_steepness(box, 1);
  check_steepness(Box<3>{{-1, -1.3, -0.7}, {1, 0.9, 1.1}}, 2);
}

TEST_CASE("the distance from a ball is that from its centre less the radius", "[geometry]") {
  const Ball<3> ball{{1, 2, 3}, 1.5};
  CHECK(ball.distance({1, 2, 3}) == -1.5);
  CHECK(ball.distance({1, 2, 4}) == -0.5);
  CHECK(ball.distance({4, 6, 3}) == 3.5);
  CHECK(Ball<1>{{1}, 2}.distance({3}) == 0);
  CHECK(Ball<2>{{0, 0}, 5}.distance({3, 4}) == 0);
  check_steepness(ball, 3);
  check_steepness(Ball<2>{{0.1, 0.2}, 1}, 4);
}

TEST_CASE("the distance from a capsule is that from its segment less the radius", "[geometry]") {
  const Capsule<2> bar{{0, 0}, {4, 0}, 0.5};
  CHECK(bar.distance({2, 0}) == -0.5);
  CHECK(bar.distance({2, 3}) == 2.5);
  CHECK(bar.distance({2, -3}) == 2.5);
  CHECK(bar.distance({7, 4}) == 4.5);
  CHECK(bar.distance({-3, 4}) == 4.5);
  CHECK(bar.distance({4.5, 0}) == 0);
  CHECK(Capsule<3>{{0, 0, 0}, {0, 0, 2}, 1}.distance({3, 4, 1}) == 4);
  const Capsule<2> point{{1, 1}, {1, 1}, 0.25};
  CHECK(point.distance({4, 5}) == 4.75);
  check_steepness(Capsule<2>{{-1, -0.5}, {1.3, 0.8}, 0.3}, 5);
  check_steepness(Capsule<3>{{-1, -0.5, 0.2}, {1.3, 0.8, -1}, 0.3}, 6);
}

TEST_CASE("a rectangle as a polygon is the box, either way round", "[geometry]") {
  const Box<2> box{{-1, -0.5}, {2, 1.5}};
  const Polygon forwards({{-1, -0.5}, {2, -0.5}, {2, 1.5}, {-1, 1.5}});
  const Polygon backwards({{-1, 1.5}, {2, 1.5}, {2, -0.5}, {-1, -0.5}});
  test::Random random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const auto x = random.vector<2>(3);
    CHECK(std::abs(forwards.distance(x) - box.distance(x)) < rounding);
    CHECK(std::abs(backwards.distance(x) - box.distance(x)) < rounding);
  }
}

TEST_CASE("a polygon may be concave, and may begin at any corner", "[geometry]") {
  // An L: the notch at its inner corner is outside.
  std::vector<Vec<2>> corners{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (std::size_t turn = 0; turn < corners.size(); ++turn) {
    const Polygon shape(corners);
    CHECK(shape.distance({0.5, 0.5}) == -0.5);
    CHECK(shape.distance({2, 0.5}) == -0.5);
    CHECK(shape.distance({0.5, 2.75}) == -0.25);
    CHECK(shape.distance({2, 2}) == 1);
    CHECK(shape.distance({1.5, 1.25}) == 0.25);
    CHECK(shape.distance({6, 5}) == 5);
    CHECK(shape.distance({1, 1}) == 0);
    CHECK(shape.distance({-1, 1}) == 1);  // a ray from here runs along an edge
    CHECK(shape.distance({-1, 0}) == 1);
    CHECK(shape.distance({-1, 3}) == 1);
    corners.push_back(corners.front());
    corners.erase(corners.begin());
  }
  check_steepness(Polygon(corners), 8);
}

TEST_CASE("a diamond's distances are those of its edges", "[geometry]") {
  const Polygon diamond({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  test::Random random(9);
  for (int trial = 0; trial < 500; ++trial) {
    const auto x = random.vector<2>(0.9);
    const double sum = std::abs(x[0]) + std::abs(x[1]);
    const double across = std::abs(std::abs(x[0]) - std::abs(x[1]));
    if (across > 1) continue;  // nearest to a corner
    CHECK(std::abs(diamond.distance(x) - (sum - 1) / std::sqrt(2.0)) < rounding);
  }
  CHECK(diamond.distance({4, 0}) == 3);
}

TEST_CASE("repeated corners change no polygon, and two corners make none", "[geometry]") {
  const Polygon once({{0, 0}, {2, 0}, {0, 2}});
  const Polygon twice({{0, 0}, {2, 0}, {2, 0}, {0, 2}, {0, 2}, {0, 0}});
  test::Random random(10);
  for (int trial = 0; trial < 100; ++trial) {
    const auto x = random.vector<2>(3);
    CHECK(once.distance(x) == twice.distance(x));
  }
  CHECK_THAT(test::refusal([] {
               Polygon({{0, 0}, {1, 1}});
             }),
             Catch::Matchers::Contains("polygon corners = 2"));
}

TEST_CASE("a union is in one or the other, a difference in the first and not the second",
          "[geometry]") {
  const Box<2> box{{-1, -1}, {1, 1}};
  const Ball<2> ball{{1, 0}, 0.5};
  const auto either = box | ball;
  const auto without = box - ball;
  test::Random random(11);
  for (int trial = 0; trial < 500; ++trial) {
    const auto x = random.vector<2>(2);
    const bool in_box = box.distance(x) < 0;
    const bool in_ball = ball.distance(x) < 0;
    CHECK((either.distance(x) < 0) == (in_box || in_ball));
    CHECK((without.distance(x) < 0) == (in_box && !in_ball));
  }
  CHECK(either.distance({3, 0}) == 1.5);
  CHECK(without.distance({0.75, 0}) == 0.25);
  check_steepness(either, 12);
  check_steepness(without, 13);
  CHECK((box - ball | Ball<2>{{1, 0}, 0.25}).distance({1, 0}) == -0.25);
}
