// SPDX-License-Identifier: MIT
// Stiff and large structures of cables run to their end.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using test::advance, test::violation;

namespace {

using Cable = ancf::Cable<2>;
using Model = Structure<Cable, ncf::PlanarBody, joints::Joint<2>>;
using System = test::SingleThreaded<Model>;

struct SteelPendulum {
  Model model;
  Marker<2> tip;

  /// A wire of 4.02 m and 3 mm, as stiff as steel, hinged at the origin along +x, with 2 kg at its
  /// end.
  SteelPendulum() {
    model.gravity = {0, -9.81};
    const auto line = ancf::line(model, {.to = {4.02, 0},
                                         .elements = 24,
                                         .radius = 0.0015,
                                         .density = 5208.39,
                                         .youngs_modulus = 2e11});
    model.add(joints::pinned(line.start(), model.q(), "hinge"));
    const auto weight =
        model.add(ncf::PlanarBody{.inertia = {.mass = 2, .polar = 1e-3}, .position = {4.02, 0}});
    model.add(joints::revolute(line.end(), weight.point({0, 0}), "hook"));
    tip = line.end();
  }
};

/// Largest memory that this process has held [kB].
long memory() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

}  // namespace

TEST_CASE(
    "a cable as stiff as steel with steps of a millisecond runs to the end and gains no energy",
    "[mbs]") {
  SteelPendulum reference_model;
  System reference(reference_model.model);
  advance(reference, {}, 1.2, 1e-4);
  const Vector<2> place = reference_model.tip.at(reference.state().q);
  const double turnover = 2 * 9.81 * 4.02;
  for (const double rho : {0.8, 0.0}) {
    SteelPendulum pendulum;
    System system(pendulum.model);
    const double start = system.energies().total();
    double gain = 0, loss = 0, worst = 0;
    advance(system, {.spectral_radius = rho}, 1.2, 1e-3, [&](System& s) {
      const double change = s.energies().total() - start;
      gain = std::max(gain, change);
      loss = std::max(loss, -change);
      worst = std::max(worst, violation(s));
    });
    const double apart = (pendulum.tip.at(system.state().q) - place).norm();
    CAPTURE(rho, gain, loss, worst, apart);
    CHECK(system.time() == Approx(1.2));
    CHECK(system.statistics().halvings == 0);
    CHECK(gain < 1e-8 * turnover);
    CHECK(loss < 1e-4 * turnover);
    CHECK(worst < 1e-9 * system.size());
    CHECK(apart < 1.5e-4);
  }
}

TEST_CASE(
    "a chain of 10 000 cable elements falls as one of 1000, in memory that grows in proportion",
    "[mbs]") {
  const auto fall = [](int elements) {
    const double length = 100, until = 0.1, step = 2e-3;
    Model chain;
    chain.gravity = {0, -9.81};
    const auto line = ancf::line(
        chain, {.to = {length, 0},
                .elements = elements,
                .prototype = Cable{
                    .axial_stiffness = 1e5, .bending_stiffness = 1e-2, .mass_per_length = 0.1}});
    chain.add(joints::pinned(line.start(), chain.q(), "first end"));
    chain.add(joints::pinned(line.end(), chain.q(), "last end"));
    System system(chain);
    const double start = system.energies().total();
    advance(system, {}, until, step);
    const Energies e = system.energies();
    CAPTURE(elements, memory(), e.total() - start, e.kinetic);
    CHECK(memory() < 500 * 1024);
    CHECK(std::abs(e.total() - start) < 1e-5 * e.kinetic);
    return std::array{line.point(length / 2).at(system.state().q)[1],
                      line.point(length / 200).at(system.state().q)[1]};
  };
  const auto [middle, near_end] = fall(10000);
  const auto [few_middle, few_near_end] = fall(1000);
  // Free fall but for the ends.
  CHECK(middle == Approx(-0.5 * 9.81 * 0.1 * 0.1).epsilon(1e-2));
  CHECK(std::abs(middle - few_middle) < 1e-6);
  CHECK(std::abs(near_end - few_near_end) < 2e-5);
}

TEST_CASE("a chain of 10 000 bars with as many joints swings, its joints held", "[mbs]") {
  constexpr int bars = 10000;
  Structure<ncf::Bar, joints::Joint<2>> chain;
  chain.gravity = {0, -9.81};
  std::vector<Placed<ncf::Bar>> all;
  for (int k = 0; k < bars; ++k) {
    all.push_back(chain.add(test::thin_bar({0.01 * k, 0}, {0.01 * (k + 1), 0})));
    const std::string name = "pin " + std::to_string(k);
    chain.add(k == 0 ? joints::pinned(all[0].start(), chain.q(), name)
                     : joints::revolute(all[static_cast<std::size_t>(k) - 1].end(),
                                        all.back().start(), name));
  }
  test::SingleThreaded<decltype(chain)> system(chain);
  CHECK(system.start().redundant.empty());
  const double start = system.energies().total();
  advance(system, {}, 0.02, 1e-3);
  const Energies e = system.energies();
  CAPTURE(memory(), e.total() - start, e.kinetic);
  CHECK(violation(system) < 1e-9 * system.size());
  CHECK(std::abs(e.total() - start) < 1e-4 * e.kinetic);
  CHECK(all.back().end().at(system.state().q)[1] ==
        Approx(-0.5 * 9.81 * 0.02 * 0.02).epsilon(1e-2));
  CHECK(memory() < 500 * 1024);
}
