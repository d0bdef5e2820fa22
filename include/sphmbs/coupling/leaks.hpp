// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/coupling/surroundings.hpp>

namespace sphmbs::coupling {

/// Counts gas that goes into bodies or through thin ones, at every look. Gas that goes around the
/// edge of a thin body is not counted, if looks are frequent: it passes places in front of none of
/// its particles.
///
///   coupling::Leaks leaks(system, 0);
///   run(system, coupling::Staggered{}, schedule, report,
///       Every(interval, [&](auto&) { leaks.look(); }));
template <class System>
class Leaks {
 public:
  static constexpr int dim = System::dim;  ///< dimension of space

  /// @param most  gas particles that may have gone through the surface of bodies
  explicit Leaks(System& system, std::size_t most = std::numeric_limits<std::size_t>::max())
      : system_(system), most_(most) {
    look();
  }

  /// @throws BeyondModel where more gas than allowed has gone through surfaces of bodies.
  void look() {
    std::map<std::uint32_t, Place> now;
    const Surroundings<dim> bodies(system_.fluid(), system_.surface(), true);
    bodies.for_gas([&](const Seen<dim>& p, const Seen<dim>& gas) {
      const double distance = norm2(gas.r - p.r);
      Place& place = now[gas.id];
      if (p.holds(gas.r)) place.inside = true;
      if (!p.sheet || distance >= place.distance) return;
      const double gap = p.gap_to_point(gas.r);
      place.distance = distance;
      place.side = gap > 1e200 ? Vec<dim>{} : (gap < 0 ? -1.0 : 1.0) * p.normal;
    });
    for (const auto& [id, place] : now) {
      const auto before = last_.find(id);
      if (before == last_.end()) continue;
      const Place& b = before->second;
      // Beside a hinge the nearest body may be another one, whose normal is another too.
      const bool through = dot(place.side, b.side) < -0.7;
      if ((place.inside && !b.inside) || through) crossed_.push_back(id);
    }
    last_ = std::move(now);
    if (crossed_.size() > most_)
      throw BeyondModel(
          "t = " + std::to_string(system_.time()) + " s: gas particle #" +
              std::to_string(crossed_.back()) + " has gone through the surface of a body, as " +
              std::to_string(crossed_.size()) + " have altogether" +
              "\n  likely: a body thinner than the gas resolves, a gap between its particles, or "
              "steps too long\n  try: a finer gas, a body made as a sheet, a smaller --cfl",
          "E321", crossed_);
  }

  /// Ids of the gas that has gone through surfaces, once for each time.
  const std::vector<std::uint32_t>& crossed() const { return crossed_; }

  /// What a checkpoint keeps of it, see `Archive`: where gas was at the last look.
  template <Archive A>
  void visit_state(A& archive) {
    std::vector<std::uint32_t> id;
    std::vector<std::uint8_t> inside;
    std::vector<double> side;
    for (const auto& [number, place] : last_) {
      id.push_back(number);
      inside.push_back(place.inside);
      side.insert(side.end(), place.side.component, place.side.component + dim);
    }
    archive("id", id);
    archive("inside", inside);
    archive("side", side);
    archive("crossed", crossed_);
    if constexpr (A::restores) {
      last_.clear();
      for (std::size_t k = 0; k < std::min({id.size(), inside.size(), side.size() / dim}); ++k) {
        Place& place = last_[id[k]];
        place.inside = inside[k] != 0;
        std::copy_n(&side[k * dim], dim, place.side.component);
      }
    }
  }

 private:
  struct Place {
    bool inside = false;
    double distance = std::numeric_limits<double>::infinity();  // to a thin body, squared [m^2]
    Vec<dim> side = {};  // direction from the nearest thin body, zero where none is behind
  };

  System& system_;
  std::size_t most_;
  std::map<std::uint32_t, Place> last_;  // gas near bodies
  std::vector<std::uint32_t> crossed_;
};

}  // namespace sphmbs::coupling
