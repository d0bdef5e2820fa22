// SPDX-License-Identifier: MIT
// What docs/bad_inputs.md says of the library alone is what it throws.
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <sphmbs/coupling.hpp>
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/sphmbs.hpp>

#include "support/bad_inputs.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

using namespace sphmbs;
using Gas = sph::SmoothScheme<2>;
using Bars = mbs::Structure<mbs::ncf::Bar, mbs::joints::Joint<2>>;
using Cables = mbs::Structure<mbs::ancf::Cable<2>>;

constexpr double dx = 0.1;
const particles::State<2> still{.rho = 1, .p = 1};
const geometry::Box<2> room{.lower = {0, 0}, .upper = {1, 1}};
const geometry::Lattice<2> lattice{.spacing = dx, .origin = {dx / 2, dx / 2}};

mbs::ncf::Bar bar(const mbs::Vector<2>& from, const mbs::Vector<2>& to) {
  return {.from = from, .to = to, .density = 1, .area = 1};
}

/// Gas in a box.
void fill(const geometry::Domain<2>& domain, const Gas& gas = {}) {
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(room, domain), still, {dx});
  sph::Fluid<Gas, execution::Serial> fluid(gas, domain, std::move(cloud));
}

/// Gas behind an opening in whose zone a wall stands.
void put_wall_into_inlet() {
  const geometry::Domain<2> domain{.box = {.lower = {-0.5, 0}, .upper = {1, 1}},
                                   .periodic = {false, true}};
  const geometry::Box<2> zone{.lower = {-0.5, 0}, .upper = {0, 1}};
  const geometry::Ball<2> wall{.centre = {0, 0.5}, .radius = 0.2};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(room, domain), still, {dx});
  cloud.add_virtual(lattice.inner_points(wall, domain), still, {dx}, wall);
  cloud.add_opening(
      {.lower = zone.lower, .upper = zone.upper, .axis = 0, .side = 1, .far = still, .distance = 1},
      lattice.points(zone, domain), {dx});
  sph::Fluid<Gas, execution::Serial> fluid({}, domain, std::move(cloud));
}

/// Two disks in gas, the second one over the first.
void overlap() {
  const geometry::Domain<2> domain{.box = {.lower = {0, 0}, .upper = {4, 3}},
                                   .periodic = {true, true}};
  const geometry::Ball<2> disks[] = {{.centre = {1, 1.5}, .radius = 0.4},
                                     {.centre = {1.63, 1.55}, .radius = 0.4}};
  particles::Cloud<2> cloud;
  cloud.add_gas(lattice.points(domain.box - disks[0] - disks[1], domain), still, {dx});
  mbs::Structure<mbs::ncf::PlanarBody> bodies;
  coupling::WettedSurface<2, execution::Serial> surface;
  for (const auto& disk : disks) {
    const int set = cloud.add_virtual(lattice.inner_points(disk, domain), still, {dx}, disk);
    const auto body = bodies.add(mbs::ncf::PlanarBody{
        .inertia = {.mass = 1, .polar = 0.1}, .position = {disk.centre[0], disk.centre[1]}});
    surface.tie(cloud, set, coupling::points_of(body, bodies.q(), cloud, set), bodies.q());
  }
  sph::Fluid<Gas, execution::Serial, coupling::Riding<2>> fluid({}, domain, std::move(cloud),
                                                                surface.motion());
  mbs::Dynamics<decltype(bodies), mbs::solvers::SparseLU, execution::Serial> dynamics(bodies);
  coupling::Immersed system(fluid, dynamics, surface);
}

/// A joint of a part of another structure.
void join_stranger() {
  Bars other, bars;
  bars.add(bar({0, 0}, {1, 0}));
  other.add(bar({0, 0}, {1, 0}));
  const auto stranger = other.add(bar({1, 0}, {2, 0}));
  bars.add(mbs::joints::pinned(stranger.end(), other.q(), "hook"));
}

/// A joint of two points that are apart.
void join_apart() {
  Bars bars;
  const auto first = bars.add(bar({0, 0}, {1, 0})), second = bars.add(bar({1.001, 0}, {2, 0}));
  bars.add(mbs::joints::pinned(first.start(), bars.q(), "hook"));
  bars.add(mbs::joints::revolute(first.end(), second.start(), "knee"));
  mbs::Dynamics<Bars> dynamics(bars);
}

geometry::Domain<2> square(double width, bool periodic) {
  return {.box = {.lower = {0, 0}, .upper = {width, 1}}, .periodic = {periodic, false}};
}

/// What is done in each row, by the number and the text of its first two cells.
const std::map<std::string, std::function<void()>> actions{
    {"17 | smoothing length / spacing outside [0.8, 4]",
     [] {
       particles::Cloud<2>{}.add_gas({{0, 0}}, still, {dx, 0.5});
     }},
    {"18 | molar mass ≤ 0", [] { fill(square(1, false), {.eos = {.molar_mass = 0}}); }},
    {"19 | viscosity < 0", [] { sph::Newtonian{.viscosity = -1}.check(); }},
    {"19 | conductivity < 0", [] { sph::Newtonian{.viscosity = 1, .conductivity = -1}.check(); }},
    {"26 | domain min ≥ max", [] { fill(square(-1, false)); }},
    {"27 | period shorter than two supports", [] { fill(square(0.5, true)); }},
    {"30 | wall in the zone of an opening", put_wall_into_inlet},
    {"35 | two bodies overlap", overlap},
    {"36 | joint of a body that is not in the structure", join_stranger},
    {"37 | markers of a joint apart", join_apart},
    {"38 | no elements",
     [] {
       Cables cables;
       mbs::ancf::line(cables, {.from = {0, 0},
                                .to = {1, 0},
                                .elements = 0,
                                .radius = 0.01,
                                .density = 1000,
                                .youngs_modulus = 1e6});
     }},
};

std::string trimmed(const std::string& cell) {
  const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
  return from == std::string::npos ? "" : cell.substr(from, to - from + 1);
}

}  // namespace

TEST_CASE("the library refuses what its page says, in these words", "[programs][fault]") {
  std::set<std::string> seen;
  test::for_each_row([&](const std::vector<std::string>& cells) {
    if (cells.size() != 3) return;
    const std::vector<std::string> message = test::quoted(cells[2]);
    if (message.empty()) return;
    const std::string row = trimmed(cells[0]) + " | " + trimmed(cells[1]);
    CAPTURE(row);
    REQUIRE(actions.count(row) == 1);
    seen.insert(row);
    const std::string said = test::refusal(actions.at(row));
    CHECK(said == message.front());
  });
  CHECK(seen.size() == actions.size());
}
