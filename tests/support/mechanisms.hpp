// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>

/// Small mechanisms that several tests share.
namespace test {

using PlanarMechanism =
    sphmbs::mbs::Structure<sphmbs::mbs::ncf::Bar, sphmbs::mbs::joints::Joint<2>>;

/// A thin bar of 1 kg and the length between two points.
inline sphmbs::mbs::ncf::Bar thin_bar(const sphmbs::mbs::Vector<2>& from,
                                      const sphmbs::mbs::Vector<2>& to) {
  return {.from = from, .to = to, .density = 1 / (to - from).norm(), .area = 1};
}

/// Double pendulum of two thin bars of 1 m and 1 kg: the first one lies along +x, the second hangs.
inline PlanarMechanism double_pendulum() {
  PlanarMechanism mechanism;
  mechanism.gravity = {0, -9.81};
  const auto first = mechanism.add(thin_bar({0, 0}, {1, 0}));
  const auto second = mechanism.add(thin_bar({1, 0}, {1, -1}));
  mechanism.add(sphmbs::mbs::joints::pinned(first.start(), mechanism.q(), "root"));
  mechanism.add(sphmbs::mbs::joints::revolute(first.end(), second.start(), "knee"));
  return mechanism;
}

/// Steps a system over a time.
template <class System>
void advance(System& system, const sphmbs::mbs::GeneralizedAlpha& integrator, double until,
             double step) {
  sphmbs::run(system, integrator, {.until = until, .step = step},
              [](const auto&, const sphmbs::sph::StepLimit&) {});
}

}  // namespace test
