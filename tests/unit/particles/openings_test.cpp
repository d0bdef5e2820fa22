// SPDX-License-Identifier: MIT
#include <limits>
#include <vector>

#include <sphmbs/particles/particles.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/on_host.hpp"
#include "support/policies.hpp"

namespace {

using Catch::Matchers::Contains;
using sphmbs::Vec;
using sphmbs::particles::Cloud;
using sphmbs::particles::Opening;

/// Gas beyond x = 0.
Opening<2> inlet() {
  return {.lower = {-0.5, 0},
          .upper = {0, 1},
          .axis = 0,
          .side = 1,
          .far = {.rho = 1.2, .p = 1e5, .v = {30, 0}},
          .distance = 10};
}

}  // namespace

TEST_CASE("an opening's particles start as the far gas", "[particles]") {
  Cloud<2> cloud;
  cloud.add_gas({{1, 1}}, {.rho = 1, .p = 1}, {.spacing = 0.1});
  CHECK(cloud.add_opening(inlet(), {{-0.05, 0.5}, {-0.45, 0.5}}, {.spacing = 0.1}) == 0);
  auto outlet = inlet();
  outlet.side = -1;
  CHECK(cloud.add_opening(outlet, {{-0.05, 0.5}}, {.spacing = 0.1}) == 1);
  CHECK(cloud.set == std::vector<std::uint8_t>{0, 192, 192, 193});
  CHECK(cloud.v[1] == Vec<2>{30, 0});
  CHECK(cloud.m[1] == Approx(0.012));
  CHECK(cloud.gas_count() == 1);
  CHECK(cloud.gas_mass() == Approx(0.01));
  CHECK(sphmbs::particles::opening_of(193) == 1);
  CHECK_FALSE(sphmbs::particles::is_virtual(192));
}

TEST_CASE("a bad opening is refused by name", "[particles]") {
  const auto refusal = [](auto change) {
    auto opening = inlet();
    change(opening);
    Cloud<2> cloud;
    return test::refusal([&] { cloud.add_opening(opening, {{-0.1, 0.5}}, {.spacing = 0.1}); });
  };
  CHECK(refusal([](auto&) {}).empty());
  Cloud<2> cloud;
  CHECK_THAT(test::refusal([&] { cloud.add_opening(inlet(), {}, {.spacing = 0.1}); }),
             Contains("points of an opening = 0"));
  CHECK_THAT(refusal([](auto& o) { o.axis = 2; }), Contains("axis of an opening = 2"));
  CHECK_THAT(refusal([](auto& o) { o.side = 0; }), Contains("side of an opening = 0"));
  CHECK_THAT(refusal([](auto& o) { o.far.p = -1; }), Contains("pressure = -1"));
  CHECK_THAT(refusal([](auto& o) { o.far.rho = 0; }), Contains("density = 0"));
  CHECK_THAT(refusal([](auto& o) { o.distance = 0; }), Contains("distance of the far gas = 0"));
  CHECK_THAT(refusal([](auto& o) { o.upper[1] = 0; }), Contains("width of an opening's zone = 0"));
  CHECK_THAT(refusal([](auto& o) { o.upper[0] = -0.2; }), Contains("place of an opening's point"));
  CHECK_THAT(refusal([](auto& o) { o.far.v[0] = std::numeric_limits<double>::infinity(); }),
             Contains("velocity of the far gas = inf"));
}

TEST_CASE("there is room for 64 openings", "[particles]") {
  Cloud<2> cloud;
  const auto add = [&] { cloud.add_opening(inlet(), {{-0.1, 0.5}}, {.spacing = 0.1}); };
  for (int i = 0; i < 64; ++i) add();
  CHECK(cloud.set.back() == 255);
  CHECK_THAT(test::refusal(add), Contains("openings = 65"));
}

TEMPLATE_LIST_TEST_CASE("particles can be replaced by a selection of themselves", "[particles]",
                        test::Policies) {
  using Policy = TestType;
  Cloud<2> cloud;
  for (int i = 0; i < 5; ++i)
    cloud.add_gas({{1.0 * i, -1.0 * i}}, {.rho = 1.0 + i, .p = 1, .v = {0, 2.0 * i}},
                  {.spacing = 0.1});
  cloud.add_virtual({{9, 9}}, {.rho = 6, .p = 1}, {.spacing = 0.1});
  sphmbs::particles::Particles<2, double, Policy> particles(cloud,
                                                            [](double, double p) { return p; });
  constexpr auto width = static_cast<std::size_t>(sphmbs::particles::record_size<2, double>);
  std::vector<double> records(6 * width);
  for (std::size_t k = 0; k < records.size(); ++k) records[k] = static_cast<double>(k);
  Policy::upload(particles.records(), records.data(), records.size() * sizeof(double));
  const std::vector<std::uint32_t> order{5, 0, 3, 3, 1, 2, 2, 2};
  sphmbs::execution::Field<std::uint32_t, Policy> there{order};
  particles.select(there.data(), order.size());
  REQUIRE(particles.size() == order.size());
  const test::FieldsOnHost fields(particles);
  const auto selected = test::fetch<Policy>(particles.records(), order.size() * width);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t j = order[i];
    CHECK(fields->id[i] == j);
    CHECK(fields->rho[i] == cloud.rho[j]);
    CHECK(fields->position(i) == cloud.r[j]);
    CHECK(fields->velocity(i) == cloud.v[j]);
    CHECK(fields->set[i] == cloud.set[j]);
    CHECK(selected[i * width + 3] == static_cast<double>(j * width + 3));
  }
}
