// SPDX-License-Identifier: MIT
#include <cstdint>
#include <limits>
#include <vector>

#include <sphmbs/particles/particles.hpp>

#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/on_host.hpp"
#include "support/policies.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::Vec;
using sphmbs::particles::Cloud;

}  // namespace

TEST_CASE("gas of a lattice has the mass of its density and the spacing's volume", "[particles]") {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>, double volume) {
    Cloud<Dim> cloud;
    cloud.add_gas({Vec<Dim>::all(0.0), Vec<Dim>::all(1.0)},
                  {.rho = 2, .p = 1e5, .v = Vec<Dim>::all(3.0)},
                  {.spacing = 0.5, .smoothing_ratio = 1.5});
    REQUIRE(cloud.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(cloud.m[i] == 2 * volume);
      CHECK(cloud.h[i] == 0.75);
      CHECK(cloud.rho[i] == 2);
      CHECK(cloud.p[i] == 1e5);
      CHECK(cloud.v[i] == Vec<Dim>::all(3.0));
      CHECK(cloud.set[i] == sphmbs::particles::gas);
    }
    CHECK(cloud.r[1] == Vec<Dim>::all(1.0));
  };
  check(std::integral_constant<int, 1>{}, 0.5);
  check(std::integral_constant<int, 2>{}, 0.25);
  check(std::integral_constant<int, 3>{}, 0.125);
}

TEST_CASE("sets of virtual particles are numbered from 1", "[particles]") {
  Cloud<2> cloud;
  const auto state = test::still_air<2>();
  CHECK(cloud.add_virtual({{0, 0}}, state, {.spacing = 0.1}) == 1);
  cloud.add_gas({{1, 0}, {2, 0}, {3, 0}}, state, {.spacing = 0.1});
  CHECK(cloud.add_virtual({{4, 0}, {5, 0}}, state, {.spacing = 0.1}) == 2);
  CHECK(cloud.set == std::vector<std::uint8_t>{1, 0, 0, 0, 2, 2});
  CHECK(cloud.gas_count() == 3);
  CHECK(cloud.h[0] == Approx(0.125));
}

TEST_CASE("there is room for 191 sets of virtual particles", "[particles]") {
  Cloud<1> cloud;
  const auto add = [&] { cloud.add_virtual({{0.0}}, test::still_air<1>(), {.spacing = 0.1}); };
  for (int i = 0; i < 191; ++i) add();
  CHECK(cloud.set.back() == 191);
  CHECK_THAT(test::refusal(add), Contains("sets of virtual particles = 192"));
}

TEST_CASE("a state or a resolution out of range is refused by name", "[particles]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto refusal = [](double rho, double p, double spacing, double ratio) {
    Cloud<2> cloud;
    const auto text = test::refusal([&] {
      cloud.add_gas({{0, 0}}, {.rho = rho, .p = p, .v = {}}, {spacing, ratio});
    });
    CHECK(cloud.size() == (text.empty() ? 1 : 0));
    return text;
  };
  CHECK(refusal(1, 1, 1, 1.25).empty());
  CHECK_THAT(refusal(0, 1, 1, 1.25), Contains("density = 0"));
  CHECK_THAT(refusal(nan, 1, 1, 1.25), Contains("density = nan"));
  CHECK_THAT(refusal(infinity, 1, 1, 1.25), Contains("density = inf"));
  CHECK_THAT(refusal(1, -1, 1, 1.25), Contains("pressure = -1"));
  CHECK_THAT(refusal(1, nan, 1, 1.25), Contains("pressure = nan"));
  CHECK_THAT(refusal(1, 1, 0, 1.25), Contains("spacing = 0"));
  CHECK_THAT(refusal(1, 1, infinity, 1.25), Contains("spacing = inf"));
  CHECK_THAT(refusal(1, 1, 1, 0.5), Contains("smoothing length / spacing = 0.5"));
  CHECK_THAT(refusal(1, 1, 1, nan), Contains("smoothing length / spacing = nan"));
}

TEST_CASE("a record read one by one or many at once is the record stored", "[particles]") {
  using namespace sphmbs::particles;
  const auto check = []<int Dim, class T>(std::integral_constant<int, Dim>, T) {
    std::vector<T> memory(20 * record_size<Dim, T>);
    for (std::size_t i = 0; i < 20; ++i) {
      const T x = static_cast<T>(100 * i);
      Record<Dim, T> s{.r = {},
                       .v = {},
                       .rho = x + 20,
                       .p = x + 21,
                       .c = x + 22,
                       .h = x + 23,
                       .m = x + 24,
                       .shell = x + 25,
                       .rest = {}};
      for (int k = 0; k < Dim; ++k) {
        s.r[k] = x + static_cast<T>(k);
        if constexpr (splits_positions<T>) s.rest[k] = x + static_cast<T>(30 + k);
        s.v[k] = x + static_cast<T>(10 + k);
      }
      store_record<Dim, T>(memory.data(), i, s);
    }
    const std::uint32_t index[4] = {7, 0, 19, 7};
    const auto many = load_records<Dim, 4>(memory.data(), index);
    const auto lanes_are = [&](const auto& pack, T offset) {
      for (int l = 0; l < 4; ++l) CHECK(pack.v[l] == static_cast<T>(100 * index[l]) + offset);
    };
    for (int k = 0; k < Dim; ++k) {
      lanes_are(many.r[k], static_cast<T>(k));
      if constexpr (splits_positions<T>) lanes_are(many.rest[k], static_cast<T>(30 + k));
      lanes_are(many.v[k], static_cast<T>(10 + k));
    }
    lanes_are(many.rho, 20);
    lanes_are(many.p, 21);
    lanes_are(many.c, 22);
    lanes_are(many.h, 23);
    lanes_are(many.m, 24);
    lanes_are(many.shell, 25);
    const auto one = load_record<Dim>(memory.data(), 7);
    CHECK(one.r[Dim - 1] == many.r[Dim - 1].v[0]);
    CHECK(one.shell == many.shell.v[0]);
  };
  check(std::integral_constant<int, 1>{}, 1.0);
  check(std::integral_constant<int, 2>{}, 1.0f);
  check(std::integral_constant<int, 3>{}, 1.0);
  check(std::integral_constant<int, 3>{}, 1.0f);
}

TEMPLATE_LIST_TEST_CASE("particles are the cloud's, with the energy of the equation of state",
                        "[particles]", test::Policies) {
  const auto cloud = test::disordered_cloud<2>(5, 0.1, 1);
  sphmbs::particles::Particles<2, float, TestType> particles(
      cloud, [](double rho, double p) { return p / (0.4 * rho); });
  const test::FieldsOnHost fields(particles);
  REQUIRE(particles.size() == 25);
  for (std::size_t i = 0; i < 25; ++i) {
    CHECK(fields->id[i] == i);
    // A float and its rest are better than a float by far.
    CHECK(std::sqrt(norm2(fields->position(i) - cloud.r[i].to<float>())) < 1e-7);
    CHECK(std::sqrt(norm2(fields->place(i) - cloud.r[i])) < 1e-14);
    CHECK(fields->velocity(i) == cloud.v[i].to<float>());
    CHECK(fields->rho[i] == static_cast<float>(cloud.rho[i]));
    CHECK(fields->e[i] == static_cast<float>(cloud.p[i] / (0.4 * cloud.rho[i])));
    CHECK(fields->h[i] == static_cast<float>(cloud.h[i]));
    CHECK(fields->m[i] == static_cast<float>(cloud.m[i]));
    CHECK(fields->set[i] == 0);
  }
  CHECK(particles.bytes() >= 25 * (8 + 4) * sizeof(float));
}

TEST_CASE("no particles at all are refused", "[particles][fault]") {
  const auto text = test::refusal([] {
    sphmbs::particles::Particles<2, double, sphmbs::execution::Serial>(
        Cloud<2>{}, [](double, double) { return 1.0; });
  });
  CHECK_THAT(text, Contains("particles = 0"));
}
