// SPDX-License-Identifier: MIT
#include <cmath>

#include <sphmbs/boundary/evolved.hpp>
#include <sphmbs/boundary/motion.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

using sphmbs::Vec;
using sphmbs::boundary::Contraction;
using sphmbs::boundary::Fixed;

constexpr double rounding = 1e-14;
constexpr Contraction cavity{.length = 1, .speed = 0.5};

}  // namespace

TEST_CASE("a fixed wall stays where it is", "[boundary]") {
  const Vec<3> r{1, -2, 3};
  CHECK(Fixed{}.position({1, 0}, r, 0.0, 7.0) == r);
  CHECK(Fixed{}.velocity({1, 0}, r, 7.0) == Vec<3>{0, 0, 0});
  CHECK(Fixed{}.velocity({1, 0}, Vec<2, float>{1, 2}, 1.0f) == Vec<2, float>{0, 0});
}

TEST_CASE("the length of a contraction is l - 2 v t, and its walls move at v", "[boundary]") {
  CHECK(cavity.length_at(0.0) == 1);
  CHECK(cavity.length_at(0.8) == Approx(0.2).epsilon(rounding));
  for (const double t : {0.0, 0.3, 0.79}) {
    const double wall = cavity.length_at(t) / 2;
    CHECK(cavity.velocity({1, 0}, Vec<2>{wall, 0}, t)[0] == Approx(-0.5).epsilon(rounding));
    CHECK(cavity.velocity({1, 0}, Vec<2>{0, -wall}, t)[1] == Approx(0.5).epsilon(rounding));
  }
}

TEST_CASE("a contraction in two steps is the contraction in one", "[boundary]") {
  const Vec<2> r{0.53, -0.41};
  const auto half_way = cavity.position({1, 0}, r, 0.1, 0.45);
  const auto two = cavity.position({1, 0}, half_way, 0.45, 0.7);
  const auto one = cavity.position({1, 0}, r, 0.1, 0.7);
  CHECK(test::length(two - one) < rounding);
  CHECK(test::length(cavity.position({1, 0}, one, 0.7, 0.1) - r) < rounding);
  CHECK(cavity.position({1, 0}, r, 0.3, 0.3) == r);
  CHECK(test::length(cavity.position({1, 0}, r, 0.0, 0.8) - 0.2 * r) < rounding);
}

TEST_CASE("the velocity of a contraction is the rate of its position", "[boundary]") {
  const Vec<3> r{0.5, -0.2, 0.1};
  for (const double t : {0.0, 0.25, 0.6}) {
    // Positions are linear in time, so central differences err by rounding alone.
    const double step = 1e-3;
    const auto difference =
        cavity.position({2, 0}, r, t, t + step) - cavity.position({2, 0}, r, t, t - step);
    CHECK(test::length(1 / (2 * step) * difference - cavity.velocity({2, 0}, r, t)) < 1e-12);
  }
}

TEST_CASE("a contraction works in single precision", "[boundary]") {
  const auto r = cavity.position({1, 0}, Vec<2, float>{0.5f, 0.25f}, 0.0f, 0.5f);
  CHECK(r[0] == Approx(0.25f));
  CHECK(r[1] == Approx(0.125f));
}

TEMPLATE_LIST_TEST_CASE("virtual particles follow the contraction over stages and steps",
                        "[boundary]", test::Policies) {
  auto cloud = test::lattice_cloud<2>(12, 0.1, test::still_air<2>());
  for (auto& r : cloud.r) r = r - Vec<2>::all(0.6);
  for (auto& set : cloud.set) set = 1;
  sphmbs::sph::Fluid<test::Gas<2>, TestType, Contraction> fluid({}, test::cube<2>(1, false), cloud,
                                                                cavity);
  double t = 0;
  for (const double dt : {0.1, 0.05, 0.2}) {
    fluid.stage(0, 0);
    fluid.rates(0);
    fluid.stage(0, dt / 2);  // no change of density and energy, only of place
    fluid.rates(0);
    fluid.commit(0, dt);
    t += dt;
  }
  const auto fields = fluid.particles().fields();
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const auto expected = cavity.position({1, 0}, cloud.r[fields.id[i]], 0.0, t);
    CHECK(test::length(fields.position(i) - expected) < rounding);
    CHECK(test::length(fields.velocity(i) - cavity.velocity({1, 0}, expected, t)) < 1e-13);
  }
}

TEST_CASE("an evolved wall answers with its own state", "[boundary]") {
  using sphmbs::riemann::State;
  const State<double> gas{1, 2, 3, 4};
  const State<double> wall{5, 6, 7, 8};
  const auto facing = sphmbs::boundary::Evolved{}.facing(gas, wall);
  CHECK(facing.rho == 5);
  CHECK(facing.u == 6);
  CHECK(facing.p == 7);
  CHECK(facing.c == 8);
  CHECK(sphmbs::boundary::Evolved::evolves);
}
