// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <sphmbs/reconstruction/constant.hpp>
#include <sphmbs/reconstruction/muscl.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

namespace reconstruction = sphmbs::reconstruction;

TEMPLATE_TEST_CASE("limiters keep linear fields", "[reconstruction]", reconstruction::VanLeer,
                   reconstruction::Minmod, reconstruction::BarthJespersen,
                   reconstruction::Unlimited) {
  const TestType limiter{};
  for (const double x : {-3.0, -1e-9, 2e-7, 5.0})
    CHECK(limiter.difference(x, x) == Approx(x).epsilon(1e-15));
  CHECK(limiter.difference(0.0, 0.0) == 0);
}

TEMPLATE_TEST_CASE("pairwise limiters let no new extremum arise", "[reconstruction]",
                   reconstruction::VanLeer, reconstruction::Minmod) {
  const TestType limiter{};
  test::Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const double projected = random.between(-2, 2);
    const double jump = random.between(-2, 2);
    const double taken = limiter.difference(projected, jump);
    const double behind = 2 * projected - jump;
    // Half of it, from the particle to the middle, stays between the two values.
    REQUIRE(taken * jump >= 0);
    REQUIRE(std::abs(taken) <= 2 * std::abs(jump));
    REQUIRE(std::abs(taken) <= 2 * std::abs(behind));
    if (behind * jump <= 0) REQUIRE(taken == 0);
    REQUIRE(limiter.difference(-projected, -jump) == -taken);
  }
}

TEST_CASE("minmod takes the smaller difference and van Leer the harmonic mean",
          "[reconstruction]") {
  // Behind 1, ahead 3.
  CHECK(reconstruction::Minmod{}.difference(2.0, 3.0) == 1);
  CHECK(reconstruction::VanLeer{}.difference(2.0, 3.0) == Approx(1.5));
  CHECK(reconstruction::BarthJespersen{}.difference(2.0, 3.0) == 2);
  CHECK(reconstruction::Unlimited{}.difference(2.0, 3.0) == 2);
}

TEMPLATE_TEST_CASE("packs are limited as their lanes", "[reconstruction]", reconstruction::VanLeer,
                   reconstruction::Minmod, reconstruction::Unlimited) {
  using Pack = sphmbs::Pack<double, 8>;
  const TestType limiter{};
  test::Random random(5);
  for (int i = 0; i < 100; ++i) {
    double projected[8];
    double jump[8];
    for (int l = 0; l < 8; ++l) {
      projected[l] = l == 0 ? 0.0 : random.between(-1, 1);
      jump[l] = l == 1 ? 0.0 : random.between(-1, 1);
    }
    const Pack taken = limiter.difference(Pack::load(projected), Pack::load(jump));
    for (int l = 0; l < 8; ++l) REQUIRE(taken.v[l] == limiter.difference(projected[l], jump[l]));
  }
}

TEST_CASE("a reconstruction steps half the limited difference", "[reconstruction]") {
  CHECK(reconstruction::Muscl<reconstruction::Minmod>{}.step(2.0, 3.0) == 0.5);
  CHECK(reconstruction::Constant{}.step(2.0, 3.0) == 0);
}
