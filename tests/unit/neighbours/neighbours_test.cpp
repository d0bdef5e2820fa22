// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/neighbours/brute_force.hpp>
#include <sphmbs/neighbours/cell_list.hpp>

#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/clouds.hpp"
#include "support/errors.hpp"
#include "support/on_host.hpp"
#include "support/policies.hpp"
#include "support/rates.hpp"

namespace {

using sphmbs::neighbours::BruteForce;
using sphmbs::neighbours::CellList;
using sphmbs::neighbours::Reach;

template <int Dim>
using Cloud = sphmbs::particles::Cloud<Dim>;
template <int Dim>
using Domain = sphmbs::geometry::Domain<Dim>;
using Lists = std::vector<std::vector<std::uint32_t>>;

constexpr double spacing = 0.1;

/// The lists of a search in the order it gives them, by particle id.
template <template <int, class, class> class Search, class Policy, class T, int Dim>
Lists lists_of(const Cloud<Dim>& cloud, const Domain<Dim>& domain, const Reach& reach) {
  sphmbs::particles::Particles<Dim, T, Policy> particles(cloud, [](double, double) { return 1.0; });
  Search<Dim, T, Policy> search;
  search.rebuild(particles, domain, reach);
  Lists lists(cloud.size());
  test::for_listed<Policy>(search.view(), particles.fields().id, cloud.size(),
                           [&](std::uint32_t a, std::uint32_t b) { lists[a].push_back(b); });
  return lists;
}

Lists sorted(Lists lists) {
  for (auto& list : lists) std::sort(list.begin(), list.end());
  return lists;
}

std::size_t pairs(const Lists& lists) {
  std::size_t n = 0;
  for (const auto& list : lists) n += list.size();
  return n;
}

template <int Dim>
double largest_h(const Cloud<Dim>& cloud) {
  return *std::max_element(cloud.h.begin(), cloud.h.end());
}

/// The cell list and the test of all pairs agree, and nobody is his own or twice a neighbour.
template <class Policy, class T = double, int Dim>
void check_same(const Cloud<Dim>& cloud, const Domain<Dim>& domain, double skin = 0,
                double support = 3) {
  const Reach reach{.support = support, .skin = skin, .h_max = largest_h(cloud)};
  const Lists expected = lists_of<BruteForce, Policy, T>(cloud, domain, reach);
  const Lists found = sorted(lists_of<CellList, Policy, T>(cloud, domain, reach));
  CHECK(found == expected);
  std::size_t wrong = 0;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const auto& list = found[a];
    wrong += std::adjacent_find(list.begin(), list.end()) != list.end() ? 1 : 0;
    wrong += std::binary_search(list.begin(), list.end(), static_cast<std::uint32_t>(a)) ? 1 : 0;
  }
  CHECK(wrong == 0);
}

/// A disordered cloud in a box of its own shape, periodic along the axes whose bits are set.
template <int Dim>
std::pair<Cloud<Dim>, Domain<Dim>> random_case(unsigned periodic, std::uint64_t seed) {
  const double sides[3] = {Dim == 1 ? 9.0 : 1.3, 1.1, 0.98};
  Domain<Dim> domain{{}, {}};
  for (int k = 0; k < Dim; ++k) {
    domain.box.lower[k] = 3.0 * k - 4;
    domain.box.upper[k] = domain.box.lower[k] + sides[k];
    domain.periodic[static_cast<std::size_t>(k)] = (periodic >> k & 1u) != 0;
  }
  test::Random random(seed);
  std::vector<sphmbs::Vec<Dim>> points(Dim == 1 ? 120 : Dim == 2 ? 250 : 400);
  for (auto& x : points)
    for (int k = 0; k < Dim; ++k) x[k] = random.between(domain.box.lower[k], domain.box.upper[k]);
  Cloud<Dim> cloud;
  cloud.add_gas(points, test::still_air<Dim>(), {.spacing = spacing});
  for (double& h : cloud.h) h *= random.between(0.5, 1.25);
  return {cloud, domain};
}

template <int Dim>
Cloud<Dim> cloud_at(const std::vector<sphmbs::Vec<Dim>>& points) {
  Cloud<Dim> cloud;
  cloud.add_gas(points, test::still_air<Dim>(), {.spacing = spacing});
  return cloud;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a cell list finds the neighbours that the test of all pairs finds",
                        "[neighbours]", test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    for (unsigned periodic = 0; periodic < (1u << Dim); ++periodic) {
      CAPTURE(Dim, periodic);
      const auto [cloud, domain] = random_case<Dim>(periodic, 100 + periodic);
      check_same<TestType>(cloud, domain);
      check_same<TestType>(cloud, domain, 0.02);
      check_same<TestType, float>(cloud, domain);
      check_same<TestType>(cloud, domain, 0, 2);
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a pair is listed where it is closer than the mean of its supports",
                        "[neighbours]", test::Policies) {
  auto [cloud, domain] = random_case<2>(3, 110);
  const double skin = 0.03;
  const Reach reach{.support = 3, .skin = skin, .h_max = largest_h(cloud)};
  const Lists found = lists_of<CellList, TestType, double>(cloud, domain, reach);
  std::size_t wrong = 0;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const std::set<std::uint32_t> list(found[a].begin(), found[a].end());
    for (std::size_t b = 0; b < cloud.size(); ++b) {
      if (b == a) continue;
      const double x = std::remainder(cloud.r[b][0] - cloud.r[a][0], domain.box.length(0));
      const double y = std::remainder(cloud.r[b][1] - cloud.r[a][1], domain.box.length(1));
      const bool near = std::hypot(x, y) < 3 * (cloud.h[a] + cloud.h[b]) / 2 + skin;
      wrong += list.contains(static_cast<std::uint32_t>(b)) != near ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
}

TEMPLATE_LIST_TEST_CASE("every number of cells along a periodic axis is searched once around",
                        "[neighbours]", test::Policies) {
  // From two supports, the shortest period allowed, which makes 4 cells, to 9 cells.
  for (const double reaches : {2.0, 2.3, 2.5, 2.7, 3.0, 3.2, 3.5, 3.9, 4.0, 4.6}) {
    CAPTURE(reaches);
    const double period = reaches * 3 * 0.125 * (1 + 1e-12);
    const auto check = [&]<int Dim>(std::integral_constant<int, Dim>) {
      test::Random random(120);
      std::vector<sphmbs::Vec<Dim>> points(Dim == 1 ? 40 : 150);
      for (auto& x : points)
        for (int k = 0; k < Dim; ++k) x[k] = random.between(0, period);
      check_same<TestType>(cloud_at(points), test::cube<Dim>(period, true));
    };
    check(std::integral_constant<int, 1>{});
    check(std::integral_constant<int, 2>{});
    check(std::integral_constant<int, 3>{});
  }
}

TEMPLATE_LIST_TEST_CASE("particles on the borders of cells and of the domain are not missed",
                        "[neighbours]", test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    constexpr int per_side = Dim == 3 ? 9 : 16;
    for (const bool periodic : {false, true}) {
      CAPTURE(Dim, periodic);
      auto cloud = test::lattice_cloud<Dim>(per_side, spacing, test::still_air<Dim>());
      for (auto& r : cloud.r) r = r - sphmbs::Vec<Dim>::all(spacing / 2);  // on the lower border
      const auto domain = test::cube<Dim>(per_side * spacing, periodic);
      check_same<TestType>(cloud, domain);
      // Half a reach, the side of the cells, is a whole number of spacings; no pair is at the
      // reach.
      for (double& h : cloud.h) h = spacing * 4 / 3;
      check_same<TestType>(cloud, domain, 0, 2.999);
      check_same<TestType>(cloud, domain, 0, 3.001);
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("particles on both periodic borders are neighbours at one place",
                        "[neighbours]", test::Policies) {
  check_same<TestType>(cloud_at<2>({{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.99, 0.5}, {0, 0.5}}),
                       test::cube<2>(1, true));
}

TEMPLATE_LIST_TEST_CASE("walls outside a box that is not periodic are neighbours", "[neighbours]",
                        test::Policies) {
  auto [cloud, domain] = random_case<2>(1, 130);
  test::Random random(131);
  for (std::size_t i = 0; i < cloud.size(); i += 3)
    cloud.r[i][1] = domain.box.lower[1] - 0.8 + 2.7 * random.unit();
  check_same<TestType>(cloud, domain);
}

TEMPLATE_LIST_TEST_CASE("one particle is alone and two see each other", "[neighbours]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    for (const bool periodic : {false, true}) {
      const auto domain = test::cube<Dim>(1, periodic);
      const auto corner = sphmbs::Vec<Dim>::all(0.05);
      auto across = corner;
      across[Dim - 1] = 0.95;
      check_same<TestType>(cloud_at<Dim>({corner}), domain);
      check_same<TestType>(cloud_at<Dim>({corner, across}), domain);
      const auto found = lists_of<CellList, TestType, double>(
          cloud_at<Dim>({corner, across}), domain, {.support = 3, .skin = 0, .h_max = 0.125});
      CHECK(pairs(found) == (periodic ? 2 : 0));
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("particles at one point are neighbours of each other", "[neighbours]",
                        test::Policies) {
  auto [cloud, domain] = random_case<2>(3, 140);
  for (std::size_t i = 1; i < 30; ++i) cloud.r[i] = cloud.r[0];
  check_same<TestType>(cloud, domain);
  for (auto& r : cloud.r) r = cloud.r[0];
  check_same<TestType>(cloud, domain);
  const Reach reach{.support = 3, .skin = 0, .h_max = largest_h(cloud)};
  CHECK(pairs(lists_of<CellList, TestType, double>(cloud, domain, reach)) ==
        cloud.size() * (cloud.size() - 1));
}

TEMPLATE_LIST_TEST_CASE("a particle that is extremely far away spoils nothing", "[neighbours]",
                        test::Policies) {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    for (const unsigned periodic : {0u, 1u}) {
      if (Dim == 1 && periodic != 0) continue;
      CAPTURE(Dim, periodic);
      auto [cloud, domain] = random_case<Dim>(periodic, 150);
      cloud.r[7][Dim - 1] = 1e6 * domain.box.length(0);
      check_same<TestType>(cloud, domain);
      cloud.r[8][Dim - 1] = -1e9 * domain.box.length(0);
      check_same<TestType>(cloud, domain);
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("a large particle among small ones is seen by all it reaches",
                        "[neighbours]", test::Policies) {
  auto [cloud, domain] = random_case<2>(0, 160);
  for (double& h : cloud.h) h /= 10;
  cloud.h[11] = 0.3;
  check_same<TestType>(cloud, domain);
}

TEST_CASE("lists are in the same order for any number of threads", "[neighbours]") {
  const auto check = []<int Dim>(std::integral_constant<int, Dim>) {
    const auto cloud = test::disordered_cloud<Dim>(Dim == 1   ? 6000
                                                   : Dim == 2 ? 70
                                                              : 17,
                                                   spacing, 170);
    const auto domain = test::cube<Dim>(spacing * (Dim == 1 ? 6000 : Dim == 2 ? 70 : 17), true);
    const Reach reach{.support = 3, .skin = 0.01, .h_max = largest_h(cloud)};
    const auto expected =
        lists_of<CellList, sphmbs::execution::Serial, double>(cloud, domain, reach);
    for (const int count : {1, 2, 3, 4}) {
      const test::Threads threads(count);
      CHECK(lists_of<CellList, sphmbs::execution::Default, double>(cloud, domain, reach) ==
            expected);
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

TEMPLATE_LIST_TEST_CASE("sorting by cells takes all of a particle's data along", "[neighbours]",
                        test::Policies) {
  auto [cloud, domain] = random_case<3>(5, 180);
  test::disturb(cloud, spacing, 181, {.place = 0, .smoothing = 0});
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.set[i] = static_cast<std::uint8_t>(i % 7);
  sphmbs::particles::Particles<3, double, TestType> particles(
      cloud, [](double rho, double p) { return p / rho; });
  CellList<3, double, TestType> search;
  for (int again = 0; again < 3; ++again)
    search.rebuild(particles, domain, {.support = 3, .skin = 0, .h_max = largest_h(cloud)});
  const test::FieldsOnHost fields(particles);
  std::set<std::uint32_t> ids;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t id = fields->id[i];
    ids.insert(id);
    CHECK(fields->position(i) == cloud.r[id]);
    CHECK(fields->velocity(i) == cloud.v[id]);
    CHECK(fields->rho[i] == cloud.rho[id]);
    CHECK(fields->e[i] == cloud.p[id] / cloud.rho[id]);
    CHECK(fields->h[i] == cloud.h[id]);
    CHECK(fields->m[i] == cloud.m[id]);
    CHECK(fields->set[i] == cloud.set[id]);
  }
  CHECK(ids.size() == cloud.size());
}

TEMPLATE_LIST_TEST_CASE("lists made again from the same search are those of a fresh one",
                        "[neighbours]", test::Policies) {
  auto [cloud, domain] = random_case<2>(3, 190);
  const auto policy_lists = [&, &where = domain](const Cloud<2>& particles_of, const Reach& reach) {
    return lists_of<CellList, TestType, double>(particles_of, where, reach);
  };
  sphmbs::particles::Particles<2, double, TestType> particles(cloud,
                                                              [](double, double) { return 1.0; });
  CellList<2, double, TestType> search;
  // Long, short and long lists again, so that memory is taken, kept and given back.
  for (const double support : {3.0, 1.0, 0.001, 3.0}) {
    const Reach reach{.support = support, .skin = 0, .h_max = largest_h(cloud)};
    search.rebuild(particles, domain, reach);
    Lists found(cloud.size());
    test::for_listed<TestType>(search.view(), particles.fields().id, cloud.size(),
                               [&](std::uint32_t a, std::uint32_t b) { found[a].push_back(b); });
    CHECK(sorted(found) == sorted(policy_lists(cloud, reach)));
  }
}

TEMPLATE_LIST_TEST_CASE("a periodic axis shorter than two supports is refused", "[neighbours]",
                        test::Policies) {
  using Catch::Matchers::Contains;
  const auto cloud = cloud_at<2>({{0.1, 0.1}});
  const auto refusal = [&](double period, double skin, bool periodic) {
    const Reach reach{.support = 3, .skin = skin, .h_max = 0.125};
    const auto domain = test::cube<2>(period, periodic);
    const auto by_cells =
        test::refusal([&] { lists_of<CellList, TestType, double>(cloud, domain, reach); });
    CHECK(by_cells ==
          test::refusal([&] { lists_of<BruteForce, TestType, double>(cloud, domain, reach); }));
    return by_cells;
  };
  CHECK(refusal(0.75, 0, true).empty());
  CHECK(refusal(0.74, 0, false).empty());
  CHECK_THAT(refusal(0.74, 0, true), Contains("periodic length = 0.74"));
  CHECK(refusal(0.8, 0.1, true).empty());
}
