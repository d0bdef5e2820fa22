// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "support/summary.hpp"

namespace sphmbs::examples {

/// What went over the bus of a device: bytes, loops that were started, and their arguments.
struct BusSent {
  double bytes = 0;
  double loops = 0;
  double arguments = 0;

  /// So far; nothing where loops run on the host.
  template <class Display>
  static BusSent until_now([[maybe_unused]] const Display& display) {
    if constexpr (requires { display.bus(); }) {
      const auto bus = display.bus();
      return {static_cast<double>(bus.bytes()), static_cast<double>(bus.launches),
              static_cast<double>(bus.arguments)};
    } else {
      return {};
    }
  }

  BusSent& operator+=(const BusSent& o) {
    bytes += o.bytes;
    loops += o.loops;
    arguments += o.arguments;
    return *this;
  }
  BusSent& operator-=(const BusSent& o) { return *this += {-o.bytes, -o.loops, -o.arguments}; }
  friend BusSent operator-(BusSent a, const BusSent& b) { return a -= b; }

  /// For each step, of a run on a device.
  std::optional<BusCounts> per_step(std::int64_t taken, const ParticleCounts& particles) const {
    if (!(loops > 0)) return std::nullopt;
    const double steps = static_cast<double>(std::max<std::int64_t>(1, taken));
    const double all = static_cast<double>(particles.gas + particles.virtual_particles);
    return BusCounts{bytes / steps, bytes / steps / all, loops / steps, arguments / steps};
  }
};

}  // namespace sphmbs::examples
