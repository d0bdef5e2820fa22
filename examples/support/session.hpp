// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/history.hpp"
#include "support/output_folder.hpp"
#include "support/report.hpp"
#include "support/snapshot.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {

/// What an example does around its fluid: banner, progress, probes, fields, pictures, summary.
template <class Fluid>
class Session {
 public:
  static constexpr int dim = Fluid::dim;
  using Place = Vec<dim>;

  Session(const Settings& settings, std::string name, std::string title, Fluid& fluid)
      : settings_(settings),
        name_(std::move(name)),
        title_(std::move(title)),
        fluid_(fluid),
        report_(settings.quiet),
        start_(fluid.totals()) {}

  /// A line of the banner.
  void note(std::string key, std::string value) {
    notes_.push_back({std::move(key), std::move(value), ""});
  }

  /// Samples the gas at a place: columns speed_<name> and p_<name>.
  void probe(const std::string& name, const Place& place) {
    history_.add("speed_" + name, "m/s");
    history_.add("p_" + name, "Pa");
    sampled_.push_back([this, place](std::vector<double>& row) {
      const auto s = fluid_.sample(place);
      row.push_back(std::sqrt(norm2(s.v)));
      row.push_back(s.p);
    });
  }

  /// Records any quantity.
  void record(const std::string& name, const std::string& unit, std::function<double()> value) {
    history_.add(name, unit);
    sampled_.push_back(
        [value = std::move(value)](std::vector<double>& row) { row.push_back(value()); });
  }

  /// Writes fields and pictures `fields` times and samples the history `samples` times until the
  /// end, and steps the fluid.
  /// @throws what sphmbs::run throws, and OutputError; everything sampled until then is on disk.
  template <class Integrator>
  void run(const Integrator& integrator, int samples, int fields) {
    const bool is_new = prepare_output(settings_);
    std::filesystem::remove(file("summary.json"));  // of an earlier run, should this one fail
    const Clock::time_point begin = Clock::now();
    fluid_.stage(0, 0);
    fluid_.rates(0);
    banner(is_new);
    history_.begin(file("history.csv"), name_ + ", sphmbs " + std::string(version));
    const double interval = settings_.until / samples;
    io::PvdCollection collection(file("fields.pvd"));
    const Schedule schedule{settings_.until, settings_.cfl, settings_.step};
    sphmbs::run(
        fluid_, integrator, schedule, [&](Fluid&, const sph::StepLimit& limit) { progress(limit); },
        Every(
            interval, [&](Fluid&) { sample(); }, Timing::next_step),
        Every(settings_.until / fields, [&](Fluid&) { write_fields(collection); }));
    wall_seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
  }

  /// A number the run was made for.
  void result(std::string name, double value, std::optional<double> reference, std::string unit) {
    results_.push_back({std::move(name), value, reference, std::move(unit)});
  }

  /// Draws panels into <name>.svg and <name>.png.
  void curves(const std::string& name, const std::string& title, const std::vector<Panel>& panels,
              int columns) {
    for (const char* type : {".svg", ".png"}) {
      draw_panels(file(name + type), title, panels, columns);
      written_.push_back(name + type);
    }
  }

  /// Writes summary.json and prints the closing block.
  void finish() {
    const Summary summary = summarise();
    write_summary(file("summary.json"), summary);
    written_.push_back("summary.json");
    std::vector<std::string> paths;
    for (const std::string& w : written_) paths.push_back(file(w).string());
    report_.finish(summary, paths);
  }

  History& history() { return history_; }
  const Settings& settings() const { return settings_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path file(const std::string& name) const { return settings_.output / name; }

  void banner(bool is_new) {
    std::vector<BannerLine> lines{
        {"case", name_, settings_.output.string() + (is_new ? " (new)" : "")}};
    lines.insert(lines.end(), notes_.begin(), notes_.end());
    lines.push_back({"particles",
                     format_count(static_cast<std::int64_t>(fluid_.gas_count())) + " gas + " +
                         format_count(static_cast<std::int64_t>(fluid_.virtual_count())) +
                         " virtual",
                     "memory " + format_bytes(fluid_.bytes()) + ", " +
                         std::to_string(fluid_.bytes() / fluid_.size()) + " B/particle"});
    lines.push_back({"run", "until " + format_exact(settings_.until) + " s",
                     settings_.backend + ", " + std::to_string(settings_.threads) +
                         (settings_.threads == 1 ? " thread" : " threads")});
    const sph::StepLimit limit = sph::step_limit(fluid_.survey(), settings_.cfl);
    const std::string fixed =
        settings_.step ? "fixed at " + format_exact(*settings_.step) + " s; " : "";
    lines.push_back({"step", fixed + limit_text(limit), ""});
    report_.banner(title_, lines);
    if (settings_.step && *settings_.step > 2 * limit.dt)
      report_.warn("long step",
                   "the fixed step is more than twice what the stability limits allow");
  }

  // What the stability limits allow at the start, and where the particle is that sets it.
  std::string limit_text(const sph::StepLimit& limit) {
    using Policy = typename Fluid::PolicyType;
    const auto fields = fluid_.particles().fields();
    const auto id = download<Policy>(fields.id, fluid_.size());
    const auto at =
        static_cast<std::size_t>(std::find(id.begin(), id.end(), limit.id) - id.begin());
    std::string text = "at most " + format_number(limit.dt, 3) + " s at cfl " +
                       format_exact(settings_.cfl) + " (" + std::string(limit.reason) + " at (";
    for (int k = 0; k < dim; ++k) {
      const auto x = download<Policy>(fields.r[k] + at, 1);
      text += (k > 0 ? ", " : "") + format_number(static_cast<double>(x[0]));
    }
    return text + ") m)";
  }

  void progress(const sph::StepLimit& limit) {
    std::string why(limit.reason);
    if (limit.reason != "fixed") why += " #" + std::to_string(limit.id);
    const sph::Statistics& done = fluid_.statistics();
    report_.progress({.step = static_cast<std::int64_t>(done.steps),
                      .time = fluid_.time(),
                      .time_step = limit.dt,
                      .until = settings_.until,
                      .limited_by = why,
                      .pair_interactions = static_cast<std::int64_t>(done.pair_interactions)});
  }

  void sample() {
    const Clock::time_point begin = Clock::now();
    std::vector<double> row;
    for (const auto& add : sampled_) add(row);
    history_.row(fluid_.time(), row);
    output_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void write_fields(io::PvdCollection& collection) {
    const Clock::time_point begin = Clock::now();
    const std::string number = std::to_string(10000 + frames_++).substr(1);
    write_snapshot(file("fields_" + number + ".vtp"), fluid_);
    collection.add(fluid_.time(), "fields_" + number + ".vtp");
    if constexpr (dim == 2) draw_snapshot(settings_.output, fluid_, title_, number);
    output_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  Summary summarise() {
    const sph::Statistics& done = fluid_.statistics();
    const auto end = fluid_.totals();
    const auto& received = fluid_.exchange();
    Summary s;
    s.case_name = name_;
    s.backend = settings_.backend;
    s.threads = settings_.threads;
    s.particles = {static_cast<std::int64_t>(fluid_.gas_count()),
                   static_cast<std::int64_t>(fluid_.virtual_count())};
    s.steps = static_cast<std::int64_t>(done.steps);
    s.time_end = fluid_.time();
    s.wall_seconds = wall_seconds_;
    double accounted = output_seconds_;
    for (std::size_t k = 0; k < done.seconds.size(); ++k) {
      s.phases.push_back({std::string(sph::phase_names[k]), done.seconds[k]});
      accounted += done.seconds[k];
    }
    s.phases.push_back({"output", output_seconds_});
    s.phases.push_back({"other", std::max(0.0, wall_seconds_ - accounted)});
    s.pair_interactions = static_cast<std::int64_t>(done.pair_interactions);
    s.peak_memory_bytes = peak_memory();
    s.conservation.mass = (end.mass - start_.mass) / start_.mass;
    const Vec<dim> gained = end.momentum - start_.momentum - received.impulse();
    s.conservation.momentum =
        std::sqrt(norm2(gained)) / std::sqrt(2 * end.mass * (end.kinetic + end.internal));
    const double energy = end.energy() + end.virtual_internal - start_.energy() -
                          start_.virtual_internal - received.body_work() - received.driving_work();
    s.conservation.energy = energy / (start_.energy() + start_.virtual_internal);
    s.results = results_;
    return s;
  }

  Settings settings_;
  std::string name_;
  std::string title_;
  Fluid& fluid_;
  Report report_;
  sph::Totals<dim> start_;
  std::vector<BannerLine> notes_;
  History history_;
  std::vector<std::function<void(std::vector<double>&)>> sampled_;
  std::vector<Result> results_;
  std::vector<std::string> written_{"fields.pvd", "history.csv"};
  int frames_ = 0;
  double output_seconds_ = 0;
  double wall_seconds_ = 0;
};

}  // namespace sphmbs::examples
