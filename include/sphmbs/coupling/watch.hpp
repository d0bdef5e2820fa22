// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/coupling/surroundings.hpp>

namespace sphmbs::coupling {

/// Something that happened to a body and that the equations go on through.
struct Incident {
  double time;       ///< [s]
  std::string kind;  ///< "narrow gap" or "through a periodic side", with the sets
  std::string text;  ///< one sentence, with time and sizes

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("time", time);
    archive("kind", kind);
    archive("text", text);
  }
};

/// Looks at the gaps between bodies and to walls, as often as these could have moved by a quarter
/// of a spacing. Contact is not modelled: where surfaces meet, the run ends. A gap below two
/// spacings, too narrow for the gas in it to be resolved, is an incident, and so is a body that
/// leaves through a periodic side. Particles within three spacings of another set at the start, as
/// at a hinge or on the two sides of a sheet, may touch that set. Not seen are a body that touches
/// itself and what touches across a periodic border.
template <int Dim>
class Watch {
 public:
  /// The first look. @throws InvalidInput for sets that overlap, and for gas in a body.
  template <class Fluid, class Surface>
  void begin(Fluid& fluid, const Surface& surface) {
    const Surroundings<Dim> bodies(fluid, surface, true);
    bodies.for_gas([&](const Seen<Dim>& p, const Seen<Dim>& gas) {
      expects(!p.holds(gas.r),
              "distance at the start of gas particle #" + std::to_string(gas.id) +
                  " from virtual particle " + p.name(),
              said(std::sqrt(norm2(p.r - gas.r))), "such that it is not in the body [m]");
    });
    bodies.for_pairs([&](const Seen<Dim>& p, const Seen<Dim>& o) {
      const double distance = std::sqrt(norm2(p.r - o.r)), spacing = 0.5 * (p.spacing + o.spacing);
      const bool one_sheet = p.sheet && o.sheet && distance < 1e-6 * spacing;
      expects(one_sheet || distance > 0.499 * spacing,
              "distance at the start of virtual particles " + p.name() + " and " + o.name(),
              said(distance), "at least half a spacing, " + said(0.5 * spacing) + " m");
      if (distance < 3 * spacing) rooted_[{p.set, o.set}].insert(p.id);
    });
    cells_ = bodies.periods();
    moved_ = bodies.fastest_other();
    time_ = fluid.time();
  }

  /// After a step. @throws BeyondModel where a body touches a wall or another body.
  template <class Fluid, class Surface>
  void look(Fluid& fluid, const Surface& surface) {
    way_ += (2 * surface.fastest() + moved_) * (fluid.time() - time_);
    time_ = fluid.time();
    if (way_ < 0.25 * 0.8 * surface.smoothing_length()) return;
    way_ = 0;
    const Surroundings<Dim> bodies(fluid, surface, false);
    moved_ = bodies.fastest_other();
    for (const auto& [set, cell] : bodies.periods()) pass(set, cell);
    std::map<Sets, Narrowest> gaps;
    bodies.for_pairs([&](const Seen<Dim>& p, const Seen<Dim>& o) {
      const Sets sets{p.set, o.set};
      const auto rooted = rooted_.find(sets);
      if (rooted != rooted_.end() && rooted->second.contains(p.id)) return;
      const double spacing = 0.5 * (p.spacing + o.spacing);
      const double gap = p.gap_to(o) / spacing;
      Narrowest& narrowest = gaps[sets];
      if (gap < narrowest.gap) narrowest = {gap, spacing, p.name() + " and " + o.name()};
    });
    for (const auto& [sets, narrowest] : gaps) judge(sets, narrowest);
    std::erase_if(narrow_, [&](const Sets& sets) {
      const auto gap = gaps.find(sets);
      return gap == gaps.end() || gap->second.gap > 2.5;
    });
  }

  /// All so far, in order of time.
  const std::vector<Incident>& incidents() const { return incidents_; }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("time", time_);
    archive("way", way_);
    archive("moved", moved_);
    archive("rooted", rooted_);
    archive("narrow", narrow_);
    archive("cells", cells_);
    archive("incidents", incidents_);
  }

 private:
  using Sets = std::pair<int, int>;  // of a body, and of another one or a wall

  struct Narrowest {
    double gap = std::numeric_limits<double>::infinity();  // in spacings
    double spacing = 0;                                    // [m]
    std::string pair = {};
  };

  static std::string said(double x) {
    std::ostringstream text;
    text.precision(4);
    text << x;
    return text.str();
  }

  void judge(const Sets& sets, const Narrowest& n) {
    const std::string gap =
        "the gap between virtual particles " + n.pair + " is " + said(n.gap * n.spacing) + " m";
    if (n.gap < 0)
      throw BeyondModel("t = " + said(time_) + " s: " + gap +
                            ": bodies that touch are not modelled; end the run before, give them "
                            "more room, or join them",
                        "E342");
    if (n.gap < 2 && !narrow_.contains(sets)) {
      narrow_.insert(sets);
      note("narrow gap between sets " + std::to_string(sets.first) + " and " +
               std::to_string(sets.second),
           gap + ", less than two spacings: gas in it is not resolved");
    }
  }

  void pass(int set, const typename Surroundings<Dim>::Cell& cell) {
    auto& last = cells_[set];
    for (std::size_t k = 0; k < cell.size(); ++k)
      if (cell[k] != last[k])
        note("set " + std::to_string(set) + " through a periodic side",
             "set " + std::to_string(set) + " leaves by the " +
                 (cell[k] > last[k] ? "upper" : "lower") + " side along " + "xyz"[k] +
                 " and comes in at the other one");
    last = cell;
  }

  void note(const std::string& kind, const std::string& text) {
    incidents_.push_back({time_, kind, "t = " + said(time_) + " s: " + text});
  }

  double time_ = 0;   // of the last look [s]
  double way_ = 0;    // by which gaps may have closed since the last gathering [m]
  double moved_ = 0;  // speed of walls [m/s]
  std::map<Sets, std::set<std::uint32_t>> rooted_;  // particles that may touch a set
  std::set<Sets> narrow_;
  std::map<int, typename Surroundings<Dim>::Cell> cells_;
  std::vector<Incident> incidents_;
};

}  // namespace sphmbs::coupling
