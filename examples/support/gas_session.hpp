// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/execution/device_memory.hpp>
#include <sphmbs/sphmbs.hpp>

#include "support/backends.hpp"
#include "support/gas_watch.hpp"
#include "support/session.hpp"
#include "support/snapshot.hpp"

namespace sphmbs::examples {

/// What a session shows of a gas: fields, pictures of plane gas, time of the phases, conservation.
template <class Scheme, class Policy, class Motion, class T>
class Display<sph::Fluid<Scheme, Policy, Motion, T>> {
 public:
  using Fluid = sph::Fluid<Scheme, Policy, Motion, T>;
  static constexpr int dim = Fluid::dim;
  static constexpr std::string_view collection = "fields";

  explicit Display(Fluid& fluid) : fluid_(fluid), watch_(fluid) {}

  std::vector<io::CsvWriter::Column> columns() const { return {}; }
  void sample(std::vector<double>&) const {}

  void prepare() {
    fluid_.stage(0, 0);
    fluid_.rates(0);
  }

  std::vector<BannerLine> banner(const Settings& settings) {
    const std::string fixed =
        settings.step ? "fixed at " + format_exact(*settings.step) + " s; " : "";
    const double memory = static_cast<double>(Policy::device().free);
    // Neighbours that come closer make lists longer, and new lists are made beside old fields.
    const double most = memory / (1.25 * static_cast<double>(fluid_.bytes() / fluid_.size()));
    const std::string place =
        place_of_loops<Policy>(settings) + (sizeof(T) < sizeof(double) ? ", float" : "") +
        (memory > 0 ? ", room for about " + format_number(most, 2) + " particles"
                    : ", which does not tell how much memory it has");
    return {{"particles",
             format_count(static_cast<std::int64_t>(fluid_.gas_count())) + " gas + " +
                 format_count(static_cast<std::int64_t>(fluid_.virtual_count())) + " virtual" +
                 (fluid_.opening_count() > 0
                      ? " + " + format_count(static_cast<std::int64_t>(fluid_.opening_count())) +
                            " in openings"
                      : ""),
             "memory " + format_bytes(fluid_.bytes()) + ", " +
                 std::to_string(fluid_.bytes() / fluid_.size()) + " B/particle"},
            {"run", "until " + format_exact(settings.until) + " s", place},
            {"step", fixed + limit_text(limit(settings), settings), ""}};
  }

  void heed(const Settings& settings, Report& report) {
    if (settings.step && *settings.step > 2 * limit(settings).dt)
      report.warn("long step", "the fixed step is more than twice what the stability limits allow");
  }

  void progress(Progress& state) const {
    const sph::Statistics& done = fluid_.statistics();
    state.step = static_cast<std::int64_t>(done.steps);
    state.pair_interactions = static_cast<std::int64_t>(done.pair_interactions);
  }

  /// What crossed the bus of the policy's device; nothing where loops run on the host.
  execution::BusTraffic bus() const {
    if constexpr (execution::on_host<Policy>)
      return {};
    else
      return Policy::bus();
  }

  std::vector<std::string> write(const std::filesystem::path& folder, const std::string& title,
                                 const std::string& number, bool pictures) {
    const std::string name = std::string(collection) + "_" + number + ".vtp";
    write_snapshot(folder / name, fluid_);
    if constexpr (dim == 2)
      if (pictures) draw_snapshot(folder, fluid_, title, number);
    return {name};
  }

  std::vector<Phase> phases() const {
    std::vector<Phase> phases;
    const sph::Statistics& done = fluid_.statistics();
    for (std::size_t k = 0; k < done.seconds.size(); ++k)
      phases.push_back({std::string(sph::phase_names[k]), done.seconds[k]});
    return phases;
  }

  void summarise(Summary& s) const {
    const sph::Statistics& done = fluid_.statistics();
    s.particles = {static_cast<std::int64_t>(fluid_.gas_count()),
                   static_cast<std::int64_t>(fluid_.virtual_count())};
    s.steps = static_cast<std::int64_t>(done.steps);
    s.pair_interactions = static_cast<std::int64_t>(done.pair_interactions);
    watch_.summarise(s);
  }

  void guard(const Guards& guards) { watch_.guard(guards); }
  void watch(Report& report) { watch_.look(report); }

  template <Archive A>
  void visit_state(A& archive) {
    archive("watch", watch_);
  }

 private:
  sph::StepLimit limit(const Settings& settings) {
    return sph::step_limit(fluid_.survey(), settings.cfl);
  }

  // What the stability limits allow at the start, and where the particle is that sets it.
  std::string limit_text(const sph::StepLimit& limit, const Settings& settings) {
    const auto fields = fluid_.particles().fields();
    const auto id = download<Policy>(fields.id, fluid_.size());
    const auto at =
        static_cast<std::size_t>(std::find(id.begin(), id.end(), limit.id) - id.begin());
    std::string text = "at most " + format_number(limit.dt, 3) + " s at cfl " +
                       format_exact(settings.cfl) + " (" + std::string(limit.reason) + " at (";
    for (int k = 0; k < dim; ++k) {
      const auto x = download<Policy>(fields.r[k] + at, 1);
      text += (k > 0 ? ", " : "") + format_number(static_cast<double>(x[0]));
    }
    return text + ") m)";
  }

  Fluid& fluid_;
  GasWatch<Fluid> watch_;
};

}  // namespace sphmbs::examples
