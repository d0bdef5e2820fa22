// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/coupling/immersed.hpp>
#include <sphmbs/coupling/leaks.hpp>

#include "support/body_loads.hpp"
#include "support/couplings.hpp"
#include "support/gas_session.hpp"
#include "support/structure_session.hpp"

namespace sphmbs::examples {

/// What a session shows of gas and bodies together: what it shows of each, and what passes between
/// them. Both are listed in one collection, at the same times.
template <class Fluid, class Bodies, class Surface>
class Display<coupling::Immersed<Fluid, Bodies, Surface>> {
 public:
  using System = coupling::Immersed<Fluid, Bodies, Surface>;
  static constexpr std::string_view collection = "scene";

  explicit Display(System& system)
      : system_(system), gas_(system.fluid()), bodies_(system.bodies()) {}

  std::vector<io::CsvWriter::Column> columns() const {
    std::vector<io::CsvWriter::Column> all = bodies_.columns();
    for (auto& column : all) column.name = "bodies_" + column.name;
    all.push_back({"gas_energy", "J"});
    for (int k = 0; k < System::dim; ++k)
      all.push_back({std::string("impulse_on_bodies_") + "xyz"[k], "N s"});
    all.push_back({"work_of_gas", "J"});
    all.push_back({"work_on_bodies", "J"});
    return all;
  }
  void sample(std::vector<double>& row) {
    bodies_.sample(row);
    row.push_back(system_.fluid().totals().energy());
    const auto& passed = system_.exchanged();
    for (int k = 0; k < System::dim; ++k) row.push_back(passed.impulse[k]);
    row.push_back(passed.work_of_gas);
    row.push_back(passed.work_on_bodies);
  }

  void prepare() {
    system_.evaluate();
    if (has_sheets()) leaks_.emplace(system_, most_leaks_);
  }

  void guard(const Guards& guards) {
    gas_.guard(guards);
    if (guards.leaks) most_leaks_ = static_cast<std::size_t>(*guards.leaks);
  }
  void watch(Report& report) {
    gas_.watch(report);
    if (!leaks_) return;
    leaks_->look();
    const auto& crossed = leaks_->crossed();
    for (; told_leaks_ < crossed.size(); ++told_leaks_)
      report.warn("gas through a thin body",
                  "W321 gas particle #" + std::to_string(crossed[told_leaks_]) +
                      " at t = " + format_number(system_.time(), 4) + " s");
  }

  std::vector<BannerLine> banner(const Settings& settings) {
    std::vector<BannerLine> lines = gas_.banner(settings);
    lines.insert(lines.begin(), bodies_.parts());
    lines.insert(lines.begin() + 1,
                 {"coupling", std::to_string(system_.surface().size()) + " wetted particles",
                  "generalized-alpha, spectral radius " + format_exact(settings.spectral_radius)});
    return lines;
  }

  void heed(const Settings& settings, Report& report) { gas_.heed(settings, report); }
  void progress(Progress& state) const { gas_.progress(state); }
  void notice(Report& report) {
    const auto& all = system_.incidents();
    for (; noticed_ < all.size(); ++noticed_) report.warn(all[noticed_].kind, all[noticed_].text);
  }

  std::vector<std::string> write(const std::filesystem::path& folder, const std::string& title,
                                 const std::string& number, bool pictures) {
    const coupling::NearestGas nearest = nearest_gas(system_.fluid(), system_.surface());
    nearest_.distance = std::min(nearest_.distance, nearest.distance);
    nearest_.inside = std::max(nearest_.inside, nearest.inside);
    std::vector<std::string> names = gas_.write(folder, title, number, pictures);
    for (std::string& name : bodies_.write(folder, title, number, pictures))
      names.push_back(std::move(name));
    return names;
  }

  execution::BusTraffic bus() const { return gas_.bus(); }
  std::vector<Phase> phases() const { return gas_.phases(); }

  /// Conservation is the gas's, whose accounts have what the bodies do.
  void summarise(Summary& s) {
    bodies_.summarise(s);
    gas_.summarise(s);
    if (leaks_) s.incidents.leaked = static_cast<std::int64_t>(leaks_->crossed().size());
    s.results.push_back({"gas_in_bodies", static_cast<double>(nearest_.inside), 0, "particles"});
    s.results.push_back({"nearest_gas", nearest_.distance, std::nullopt, "spacings"});
  }

  template <Archive A>
  void visit_state(A& archive) {
    archive("noticed", noticed_);
    archive("gas", gas_);
    archive("bodies", bodies_);
    if (leaks_) archive("leaks", *leaks_);
    archive("nearest_distance", nearest_.distance);
    archive("nearest_inside", nearest_.inside);
  }

  const std::vector<Frame>& frames() const { return bodies_.frames(); }

 private:
  bool has_sheets() {
    const auto* sheet = system_.fluid().particles().fields().sheet;
    if (sheet == nullptr) return false;
    const auto all = download<typename Fluid::PolicyType>(sheet, system_.fluid().size());
    return std::any_of(all.begin(), all.end(),
                       [](auto what) { return what != particles::no_sheet; });
  }

  System& system_;
  std::optional<coupling::Leaks<System>> leaks_;  // through thin bodies
  std::size_t most_leaks_ = std::numeric_limits<std::size_t>::max();
  std::size_t told_leaks_ = 0;
  std::size_t noticed_ = 0;  // incidents
  Display<Fluid> gas_;
  Display<Bodies> bodies_;
  coupling::NearestGas nearest_;  // of all that was written
};

/// Records in history.csv the gas's force on a body, and its moment about a point of the body:
/// columns gas_force_<name>_x ... and gas_moment_<name>, in space gas_moment_<name>_x ...
/// @param sets  of virtual particles that ride on it
template <class System, int Space>
void record_gas_load(Session<System>& session, const std::string& name,
                     const std::vector<int>& sets, const mbs::Marker<Space>& about) {
  constexpr int dim = System::dim;
  for (int k = 0; k < dim; ++k)
    session.record("gas_force_" + name + "_" + "xyz"[k], "N",
                   [&surface = session.system().surface(), sets, k] {
                     double force = 0;
                     for (const int set : sets) force += surface.force_on(set)[k];
                     return force;
                   });
  for (int k = 0; k < (dim == 3 ? 3 : 1); ++k)
    session.record("gas_moment_" + name + (dim == 3 ? std::string("_") + "xyz"[k] : ""), "N m",
                   [&system = session.system(), sets, about, k] {
                     double moment = 0;
                     for (const int set : sets)
                       moment += system.surface().moment_on(set, about.at(system.state().q))[k];
                     return moment;
                   });
}

/// Records all that acts on a body in gas but its weight: the columns of record_gas_load, and those
/// of record_body_loads without gas.
/// @param parts  that the body is made of: all that share nodes
/// @param sets   of virtual particles that ride on it
/// @param about  the point of the moment
template <class System, class Part>
void record_body_loads(Session<System>& session, const std::string& name,
                       const std::vector<mbs::Placed<Part>>& parts, const std::vector<int>& sets,
                       const mbs::Marker<Part::dim>& about) {
  record_gas_load(session, name, sets, about);
  record_body_loads(session, name, parts);
}

/// Result for the noise of the gas's force on a body: the standard deviation over the last tenth of
/// the run about parabolas through each of its components, of the mean's magnitude.
template <class System>
void report_noise(Session<System>& session, const std::string& name) {
  const double until = session.settings().until;
  double mean = 0, variance = 0;
  for (int k = 0; k < System::dim; ++k) {
    const Spread spread =
        spread_of(session.history(), "gas_force_" + name + "_" + "xyz"[k], 0.9 * until, until);
    mean += spread.mean * spread.mean;
    variance += spread.deviation * spread.deviation;
  }
  session.result("noise_of_gas_force_" + name, std::sqrt(variance / mean), std::nullopt, "-");
}

/// Result for what the power of the gas on the bodies differs by from what they get.
template <class System>
void report_interface(Session<System>& session) {
  const auto& passed = session.system().exchanged();
  session.result("work_lost_between_gas_and_bodies", (passed.work_of_gas - passed.work_on_bodies),
                 std::nullopt, "J");
}

}  // namespace sphmbs::examples
