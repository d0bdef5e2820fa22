// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <sphmbs/core/pack.hpp>
#include <sphmbs/geometry/domain.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"

namespace {

using sphmbs::Vec;
using sphmbs::geometry::Domain;

/// Periodic along x and z.
const Domain<3> domain{{{-2, -1, 5}, {3, 4, 8}}, {true, false, true}};

}  // namespace

TEST_CASE("the nearest image is the shortest separation, in single and double precision",
          "[geometry]") {
  const auto check = []<class T>(T tolerance) {
    const auto space = domain.periodicity<T>();
    test::Random random(1);
    for (int trial = 0; trial < 1000; ++trial) {
      // Less than 1.5 periods, as between staged positions of particles that left the box.
      const Vec<3> d{random.between(-7.4, 7.4), random.between(-100, 100),
                     random.between(-4.4, 4.4)};
      const Vec<3, T> image = space.nearest(d.to<T>());
      CHECK(std::abs(image[0] - static_cast<T>(std::remainder(d[0], 5.0))) < tolerance);
      CHECK(image[1] == static_cast<T>(d[1]));
      CHECK(std::abs(image[2] - static_cast<T>(std::remainder(d[2], 3.0))) < tolerance);
    }
  };
  check(1e-15 * 8);
  check(1e-6f);
}

TEST_CASE("nearest images of packs are those of their lanes", "[geometry]") {
  using P = sphmbs::Pack<double, 4>;
  const auto space = domain.periodicity<double>();
  test::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    Vec<3, P> packed{P(0.0), P(0.0), P(0.0)};
    Vec<3> single[4];
    for (int l = 0; l < 4; ++l) {
      single[l] = random.vector<3>(4.4);
      for (int k = 0; k < 3; ++k) packed[k].v[l] = single[l][k];
    }
    packed = space.nearest(packed);
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 3; ++k) CHECK(packed[k].v[l] == space.nearest(single[l])[k]);
  }
}

TEST_CASE("a separation of no length, or along an axis without period, is its own image",
          "[geometry]") {
  const auto space = Domain<2>{{{0, 0}, {1, 1}}, {}}.periodicity<float>();
  CHECK(space.nearest(Vec<2, float>{1e20f, -1e20f}) == Vec<2, float>{1e20f, -1e20f});
  CHECK(domain.periodicity<double>().nearest(Vec<3>{0, 0, 0}) == Vec<3>{0, 0, 0});
}

TEST_CASE("a point that left the box comes in at the other side", "[geometry]") {
  const auto space = domain.periodicity<double>();
  CHECK(space.wrap({3.5, 9, 4}) == Vec<3>{-1.5, 9, 7});
  CHECK(space.wrap({-2.5, -9, 8.25}) == Vec<3>{2.5, -9, 5.25});
  CHECK(space.wrap({1, 1, 6}) == Vec<3>{1, 1, 6});
  CHECK(space.wrap({3, 0, 8}) == Vec<3>{-2, 0, 5});
  CHECK(space.wrap({-2, 0, 5}) == Vec<3>{-2, 0, 5});
}

TEST_CASE("a wrapped point lies in the half-open box, also next to its borders", "[geometry]") {
  const auto check = []<class T>(T) {
    const auto space = domain.periodicity<T>();
    for (const T border : {T(-2), T(3)})
      for (const T beyond : {T(0), T(1e-30), T(1e-9), T(1e-7), T(1e-5)})
        for (const T sign : {T(-1), T(1)}) {
          const T inside = space.wrap({border + sign * beyond, T(0), T(6)})[0];
          CHECK(inside >= T(-2));
          CHECK(inside < T(3));
        }
    const T just_below = std::nextafter(T(-2), T(-3));
    CHECK(space.wrap({just_below, T(0), T(6)})[0] < T(3));
  };
  check(1.0);
  check(1.0f);
}

TEST_CASE("only particles near a periodic border can see across it", "[geometry]") {
  const auto space = domain.periodicity<double>();
  CHECK(space.near_border({-1.9, 0, 6.5}, 0.5));
  CHECK(space.near_border({2.9, 0, 6.5}, 0.5));
  CHECK(space.near_border({0, 0, 5.25}, 0.5));
  CHECK(space.near_border({0, 0, 7.75}, 0.5));
  CHECK(space.near_border({-2.4, 0, 6.5}, 0.1));  // has left the box
  CHECK_FALSE(space.near_border({0, -1, 6.5}, 0.5));
  CHECK_FALSE(space.near_border({0, 4, 6.5}, 0.5));
  CHECK_FALSE(space.near_border({0, 0, 6.5}, 0.5));
}

TEST_CASE("an empty, inside-out or infinite box is refused", "[geometry]") {
  using Catch::Matchers::Contains;
  const auto refusal = [](double upper) {
    return test::refusal([&] { Domain<2>{{{0, 0}, {1, upper}}, {}}.check(); });
  };
  CHECK(refusal(1).empty());
  CHECK_THAT(refusal(0), Contains("domain length = 0"));
  CHECK_THAT(refusal(-1), Contains("domain length = -1"));
  CHECK_THAT(refusal(std::numeric_limits<double>::infinity()), Contains("domain length = inf"));
  CHECK_THAT(refusal(std::numeric_limits<double>::quiet_NaN()), Contains("domain length = nan"));
}
