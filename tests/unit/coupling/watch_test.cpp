// SPDX-License-Identifier: MIT
// What happens to bodies that the equations do not know of is said.
#include <cmath>
#include <string>
#include <vector>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/sphmbs.hpp>

#include <sphmbs/coupling/staggered.hpp>

#include "support/ball_in_gas.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

namespace coupling = sphmbs::coupling;
namespace geometry = sphmbs::geometry;
namespace mbs = sphmbs::mbs;
namespace sph = sphmbs::sph;
using sphmbs::Vec;
using Gas = sph::SmoothScheme<2>;
using Policy = sphmbs::execution::Serial;

/// Two heavy disks in a periodic box of gas with a wall at its right end.
class TwoDisks {
 public:
  static constexpr double dx = 0.1, radius = 0.4;
  using Surface = coupling::WettedSurface<2, Policy>;
  using Fluid = sph::Fluid<Gas, Policy, coupling::Riding<2>>;
  using Bodies =
      mbs::Dynamics<mbs::Structure<mbs::ncf::PlanarBody>, mbs::solvers::SparseLU, Policy>;

  TwoDisks(const Vec<2>& first, const Vec<2>& second, const Vec<2>& speed, bool gas_inside = false)
      : domain_{.box = {.lower = {0, 0}, .upper = {4, 3}}, .periodic = {true, true}} {
    const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};
    const geometry::Ball<2> one{.centre = first, .radius = radius}, two{second, radius};
    const geometry::Box<2> wall{.lower = {3.4, -100}, .upper = {4, 100}};
    const sphmbs::particles::State<2> still{.rho = 1, .p = 1};
    if (gas_inside)
      cloud_.add_gas(lattice.points(domain_.box - wall, domain_), still, {dx});
    else
      cloud_.add_gas(lattice.points(domain_.box - wall - one - two, domain_), still, {dx});
    cloud_.add_virtual(lattice.inner_points(wall, domain_), still, {dx},
                       geometry::Box<2>{.lower = {3.4, -100}, .upper = {5, 100}});
    for (const auto& ball : {one, two}) {
      const int set = cloud_.add_virtual(lattice.inner_points(ball, domain_), still, {dx}, ball);
      const auto body = structure_.add(mbs::ncf::PlanarBody{
          .inertia = {.mass = 100, .polar = 8},
          .position = {ball.centre[0], ball.centre[1]},
          .velocity = set == 2 ? mbs::Vector<2>{speed[0], speed[1]} : mbs::Vector<2>{0, 0}});
      sets_.push_back({set, body});
    }
    for (const auto& [set, body] : sets_)
      surface_.tie(cloud_, set, coupling::points_of(body, structure_.q(), cloud_, set),
                   structure_.q());
  }

  /// The incidents of a run.
  std::vector<coupling::Incident> run(double until) {
    Fluid fluid(Gas{.eos = {.gamma = 1.4}, .background = 1}, domain_, cloud_, surface_.motion());
    Bodies bodies(structure_);
    coupling::Immersed system(fluid, bodies, surface_);
    sphmbs::run(system, coupling::Staggered<>{}, {.until = until}, sphmbs::no_report);
    return system.incidents();
  }

  /// How near the gas is at the start.
  coupling::NearestGas nearest() {
    Fluid fluid(Gas{.eos = {.gamma = 1.4}, .background = 1}, domain_, cloud_, surface_.motion());
    const mbs::VectorXd still = mbs::VectorXd::Zero(structure_.coordinates());
    surface_.depart(0, structure_.q(), still, still);
    return nearest_gas(fluid, surface_);
  }

 private:
  geometry::Domain<2> domain_;
  sphmbs::particles::Cloud<2> cloud_;
  mbs::Structure<mbs::ncf::PlanarBody> structure_;
  Surface surface_;
  std::vector<std::pair<int, mbs::Placed<mbs::ncf::PlanarBody>>> sets_;
};

}  // namespace

TEST_CASE("bodies with room around them meet with nothing", "[coupling]") {
  CHECK(TwoDisks({1, 1.5}, {2.4, 1.5}, {0.1, 0}).run(0.2).empty());
}

TEST_CASE("a body that comes near a wall is an incident, and at the wall the run ends",
          "[coupling][fault]") {
  TwoDisks near({2.6, 1.5}, {1, 0.7}, {1, 0});
  const auto incidents = near.run(0.36);
  REQUIRE(incidents.size() == 1);
  CHECK(incidents[0].kind == "narrow gap between sets 2 and 1");
  CHECK(test::mentions(incidents[0].text, {"of set 2", "of set 1", "two spacings"}));
  CHECK(incidents[0].time == Approx(0.2).margin(0.03));
  try {
    TwoDisks({2.6, 1.5}, {1, 0.7}, {1, 0}).run(0.6);
    FAIL("went through the wall");
  } catch (const sphmbs::NumericalFailure& e) {
    CHECK(test::mentions(e.what(), {"of set 2", "of set 1", "bodies that touch", "t = 0.4"}));
  }
}

TEST_CASE("a narrow gap between two bodies is one incident", "[coupling]") {
  const auto incidents = TwoDisks({1, 1.5}, {2.1, 1.55}, {0.5, 0}).run(0.4);
  REQUIRE(incidents.size() == 1);
  CHECK(incidents[0].kind == "narrow gap between sets 2 and 3");
}

TEST_CASE("bodies that start side by side and meet elsewhere are noticed", "[coupling]") {
  // Two spacings apart: those that face each other may touch, the wall may not be touched.
  CHECK_THROWS_WITH(TwoDisks({2.7, 1.5}, {2.7, 0.6}, {1, 0}).run(0.6),
                    Catch::Contains("of set 2") && Catch::Contains("of set 1"));
}

TEST_CASE("a body that runs into another one ends the run", "[coupling][fault]") {
  CHECK_THROWS_WITH(TwoDisks({1, 1.5}, {2, 1.5}, {1, 0}).run(0.6),
                    Catch::Contains("of set 2") && Catch::Contains("of set 3") &&
                        Catch::Contains("bodies that touch"));
}

TEST_CASE("bodies that overlap or have gas in them are refused", "[coupling][fault]") {
  CHECK(test::mentions(test::refusal([] {
                         TwoDisks({1, 1.5}, {1.63, 1.55}, {0, 0}).run(0.1);
                       }),
                       {"at the start", "of set 2", "of set 3", "half a spacing"}));
  CHECK(test::mentions(test::refusal([] {
                         TwoDisks({1, 1.5}, {2.4, 1.5}, {0, 0}, true).run(0.1);
                       }),
                       {"gas particle #", "at the start", "virtual particle", "not in the body"}));
}

TEST_CASE("a body that leaves through a periodic side says so each time", "[coupling]") {
  test::BallInGas<sph::PaperScheme<2>> ball(
      {.spacing = 0.2, .side = 4, .mass_ratio = 1e4, .velocity = {0, -0.5}});
  sphmbs::run(ball.system, coupling::Staggered<>{}, {.until = 15}, sphmbs::no_report);
  const auto& all = ball.system.incidents();
  REQUIRE(all.size() == 2);                      // from 2 m to -5.5 m
  CHECK(all[1].time == Approx(12).margin(1.3));  // by its first particle
  CHECK(all[0].kind == "set 1 through a periodic side");
  CHECK(test::mentions(all[0].text, {"set 1", "lower side along y"}));
}

TEST_CASE("gas in bodies is counted", "[coupling][fault]") {
  const auto outside = TwoDisks({1, 1.5}, {2.4, 1.5}, {0, 0}).nearest();
  CHECK(outside.inside == 0);
  CHECK(outside.distance == Approx(1).epsilon(1e-9));
  // Of a lattice all over, on which the disks' particles lie: those below the surface, more or less
  // as deep as a quarter of a spacing.
  const auto within = TwoDisks({1, 1.5}, {2.4, 1.5}, {0, 0}, true).nearest();
  CHECK(within.distance == Approx(0).margin(1e-9));
  const auto below = [](double depth) {
    int count = 0;
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 30; ++j)
        for (const double x : {1.0, 2.4})
          count += std::hypot(0.05 + 0.1 * i - x, 0.05 + 0.1 * j - 1.5) < 0.4 - depth ? 1 : 0;
    return count;
  };
  CHECK(within.inside >= below(0.05));
  CHECK(within.inside <= below(0));
}
