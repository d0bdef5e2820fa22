// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <sphmbs/core/vec.hpp>
#include <sphmbs/io/pvd.hpp>
#include <sphmbs/run.hpp>
#include <sphmbs/version.hpp>

#include "support/bus_sent.hpp"
#include "support/crash_report.hpp"
#include "support/display.hpp"
#include "support/output_folder.hpp"
#include "support/probes.hpp"
#include "support/recorder.hpp"
#include "support/report.hpp"
#include "support/run_control.hpp"
#include "support/session_checkpoints.hpp"
#include "support/text.hpp"
#include "support/type_identity.hpp"
#include "support/view_script.hpp"

namespace sphmbs::examples {

/// What an example does around its system: banner, progress, history, trajectories, files of
/// fields, pictures, summary.
template <class System>
class Session {
 public:
  using Place = Vec<System::dim>;
  /// Interval of trajectories.csv [s].
  static constexpr double trace_interval = Recorder::trace_interval;

  Session(const Settings& settings, std::string name, std::string title, System& system)
      : settings_(settings),
        name_(std::move(name)),
        title_(std::move(title)),
        system_(system),
        display_(system),
        probes_(probes_of(settings.probes, system)),
        control_(settings_),
        report_(settings.quiet) {
    recorder_.record(display_.columns(),
                     [this](std::vector<double>& row) { display_.sample(row); });
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// A line of the banner.
  void note(std::string key, std::string value) {
    notes_.push_back({std::move(key), std::move(value), ""});
  }

  /// Tells the user of something doubtful, also where the run is quiet.
  /// @param message  with the id that docs/messages.md explains
  void warn(std::string_view kind, std::string_view message) { report_.warn(kind, message); }

  /// Samples the gas at a place: columns speed_<name> and p_<name>.
  void probe(const std::string& name, const Place& place) requires requires(System& gas) {
    gas.sample(place);
  }
  {
    recorder_.record({{"speed_" + name, "m/s"}, {"p_" + name, "Pa"}},
                     [this, place](std::vector<double>& row) {
                       const auto s = system_.sample(place);
                       row.push_back(std::sqrt(norm2(s.v)));
                       row.push_back(s.p);
                     });
  }

  /// Records any quantity in history.csv.
  void record(const std::string& name, const std::string& unit, std::function<double()> value) {
    recorder_.record(name, unit, std::move(value));
  }

  /// Records any quantity in trajectories.csv.
  void trace(const std::string& name, const std::string& unit, std::function<double()> value) {
    recorder_.trace(name, unit, std::move(value));
  }

  /// Writes fields and pictures `fields` times and samples the history `samples` times until the
  /// end, trajectories at every multiple of trace_interval, and steps the system; saves the state
  /// now and then, and first restores it where the settings say so.
  /// @throws what sphmbs::run throws, and OutputError: everything sampled until then is on disk;
  ///         Stopped where the run was asked to end before its time, or to be checked only.
  template <class Integrator>
  void run(const Integrator& integrator, int samples, int fields) {
    const bool is_new = prepare_output(settings_);
    const Clock::time_point begin = Clock::now();
    SessionCheckpoints checkpoints(settings_, name_, identity_of_types(system_));
    const auto from = settings_.resume ? checkpoints.open(report_) : nullptr;
    if constexpr (requires { display_.guard(settings_.guards); }) display_.guard(settings_.guards);
    display_.prepare();

    Every sampling(
        settings_.until / samples, [&](System&) { timed([&] { sample(); }); }, Timing::next_step);
    Every tracing(recorder_.has_traces() ? trace_interval : settings_.until,
                  [&](System&) { timed([&] { recorder_.trace(system_.time()); }); });
    const std::string list = std::string(Display<System>::collection) + ".pvd";
    std::optional<io::PvdCollection> collection;
    Every writing(settings_.until / fields,
                  [&](System&) { timed([&] { try_fields(*collection); }); });
    written_ = {list, "view.py"};
    for (std::string& name : recorder_.names()) written_.push_back(std::move(name));
    if (settings_.check) check(is_new, seconds_since(begin));
    std::vector<ProbeProgress> probed;
    sph::Pace pace;
    const auto show = [&](auto& archive) {
      if constexpr (!std::remove_cvref_t<decltype(archive)>::restores) probed = probes_.progress();
      archive("system", system_);
      archive("pace", pace);
      if constexpr (requires { display_.visit_state(archive); }) archive("display", display_);
      archive("sampling", sampling);
      archive("tracing", tracing);
      archive("writing", writing);
      archive("recorder", recorder_);
      archive("probes", probed);
      archive("written", written_);
      archive("frames", frames_);
      archive("output_seconds", output_seconds_);
      archive("wall_seconds", wall_seconds_);
      archive("collection", *collection);  // writes the list: nothing is refused behind it
    };
    if (from) {
      collection.emplace(file(list), io::PvdCollection::Restored{});
      io::StateReader reader(*from);
      show(reader);
      checkpoints.go_on_from(*from);
    } else {
      checkpoints.forget_earlier();
      collection.emplace(file(list));
    }
    write_used(settings_);
    control_.begin();
    std::filesystem::remove(file("summary.json"));  // of an earlier run, should this one fail
    const double earlier = wall_seconds_;
    banner(is_new, from ? from->path().string() : "");
    const std::string comment = name_ + ", sphmbs " + std::string(version);
    recorder_.begin(settings_.output, comment);
    if (!from)
      write_view_script(settings_.output, view_of(system_, title_, list, settings_.spacing));
    probes_.begin(settings_.output, comment, settings_.until / samples, probed);
    const auto save = [&] {
      for (const std::string& name : tables()) fresh_.insert(file(name));
      auto path = checkpoints.save(steps(), report_, control_, fresh_, show);
      if (!path.empty()) fresh_.clear();
      return path;
    };

    RunControl::Decision decision;
    std::filesystem::path saved;
    BetweenSteps boundary([&](System&) {
      decision = control_.decide(steps());
      wall_seconds_ = earlier + seconds_since(begin);
      if (decision.save) timed([&] { saved = save(); });
      return decision.stop.empty();
    });
    steps_sent_ -= sent();
    const Schedule schedule{settings_.until, settings_.cfl, recorder_.step(settings_.step)};
    bool ended = false;
    try {
      ended = sphmbs::run(
          system_, integrator, schedule, pace,
          [&](System&, const sph::StepLimit& limit) { progress(limit); }, boundary, sampling,
          AtProbes{*this}, tracing, writing);
    } catch (const NumericalFailure& failure) {
      report_failure(failure, checkpoints, show);
    }
    for (const std::string& name : probes_.names()) written_.push_back(name);
    wall_seconds_ = earlier + seconds_since(begin);
    steps_sent_ += sent();
    if (!ended) stop(decision, saved);
  }

  /// A number the run was made for.
  void result(std::string name, double value, std::optional<double> reference, std::string unit) {
    results_.push_back({std::move(name), value, reference, std::move(unit)});
  }

  /// Draws panels into <name>.svg and <name>.png.
  void curves(const std::string& name, const std::string& title, const std::vector<Panel>& panels,
              int columns) {
    if (!settings_.plots) return;
    for (const char* type : {".svg", ".png"}) {
      draw_panels(file(name + type), title, panels, columns);
      written_.push_back(name + type);
    }
  }

  /// Lets draw(path) make the picture <name>, and lists it.
  template <class Draw>
  void picture(const std::string& name, Draw&& draw) {
    if (!settings_.plots) return;
    draw(file(name));
    written_.push_back(name);
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

  History& history() { return recorder_.history; }
  /// What trajectories.csv holds.
  History& traces() { return recorder_.traces; }
  const Settings& settings() const { return settings_; }
  const std::string& title() const { return title_; }
  System& system() { return system_; }
  Display<System>& display() { return display_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path file(const std::string& name) const { return settings_.output / name; }

  static double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  BusSent sent() const { return BusSent::until_now(display_); }

  /// Samples probes that are due; holds up no step.
  struct AtProbes {
    Session& session;
    double barrier() const { return std::numeric_limits<double>::infinity(); }
    void observe(System&, bool last) {
      if (session.probes_.due(last))
        session.timed([&] { session.probes_.observe(session.report_, last); });
    }
  };

  template <class Output>
  void timed(Output&& output) {
    const Clock::time_point begin = Clock::now();
    const BusSent before = sent();
    output();
    output_seconds_ += seconds_since(begin);
    steps_sent_ -= sent() - before;
  }

  // Those that grow.
  std::vector<std::string> tables() const {
    std::vector<std::string> names = recorder_.names();
    for (std::string& name : probes_.names()) names.push_back(std::move(name));
    return names;
  }

  std::int64_t steps() const {
    Progress state;
    display_.progress(state);
    return state.step;
  }

  // Ends a run that is only looked at.
  [[noreturn]] void check(bool is_new, double seconds) {
    banner(is_new, "");
    const auto names = display_.write(settings_.output, title_, "preview", settings_.plots);
    std::string files;
    for (const std::string& name : names) files += "  " + file(name).string();
    const double dt = settings_.step ? *settings_.step : step_limit_of(system_, settings_.cfl).dt;
    std::string steps = "as many steps as the accuracy needs";
    if (std::isfinite(dt))
      steps = "about " + format_count(static_cast<std::int64_t>(settings_.until / dt)) + " steps";
    throw Stopped(0, "checked   " + steps + "; set up and evaluated once in " +
                         format_duration(seconds) + "; preview" + files);
  }

  // Leaves in the folder `crash` what is around the failure, and the state before the step.
  template <class Show>
  [[noreturn]] void report_failure(const NumericalFailure& failure, SessionCheckpoints& checkpoints,
                                   const Show& show) {
    std::string text = failure.what();
    try {
      auto files = write_crash_report(file("crash"), system_, failure);
      files.push_back(checkpoints.save_in(file("crash"), steps(), show));
      text += "\n  wrote";
      for (const auto& path : files) text += " " + path.string();
    } catch (const std::exception& error) {
      text += std::string("\n  no report of it: ") + error.what();
    }
    throw NumericalFailure(text, failure.id, failure.particles);
  }

  // Ends a run that was asked to end.
  [[noreturn]] void stop(const RunControl::Decision& decision, const std::filesystem::path& saved) {
    finish();
    const std::string where = "stopped   by " + decision.stop + " at step " +
                              format_count(steps()) + ", t = " + format_number(system_.time(), 6) +
                              " s; ";
    if (saved.empty())
      throw OutputError(where + "the checkpoint could not be written, see the warning", "E501");
    throw Stopped(decision.exit_code, where + "checkpoint " + saved.string() + "; go on with " +
                                          file("used.toml").string() + " --resume --output " +
                                          settings_.output.string() +
                                          (settings_.steps ? " and more --steps" : ""));
  }

  void banner(bool is_new, const std::string& resumed) {
    std::vector<BannerLine> lines{
        {"case", name_, settings_.output.string() + (is_new ? " (new)" : "")}};
    if (!resumed.empty())
      lines.push_back(
          {"resumed",
           "step " + format_count(steps()) + ", t = " + format_number(system_.time(), 6) + " s",
           resumed});
    lines.insert(lines.end(), notes_.begin(), notes_.end());
    Settings shown = settings_;
    shown.step = recorder_.step(settings_.step);
    const auto own = display_.banner(shown);
    lines.insert(lines.end(), own.begin(), own.end());
    report_.banner(title_, lines);
    if (settings_.step && std::abs(*shown.step - *settings_.step) > 1e-9 * *settings_.step)
      report_.warn("step", "shortened from " + format_exact(*settings_.step) + " to " +
                               format_number(*shown.step, 6) + " s, a whole fraction of the " +
                               format_exact(trace_interval) +
                               " s between rows of trajectories.csv");
    for (const ProbeSpec& probe : settings_.probes)
      if (probe.interval > settings_.until)
        report_.warn("probe " + probe.name,
                     "W031 its interval of " + format_exact(probe.interval) +
                         " s is longer than the run, " + format_exact(settings_.until) +
                         " s: it has a row of the beginning and one of the end");
    display_.heed(shown, report_);
    if (settings_.lock && !settings_.lock->fault().empty())
      report_.warn("no lock",
                   "W033 " + settings_.lock->fault() + "; start no second run in this directory");
  }

  void progress(const sph::StepLimit& limit) {
    std::string why(limit.reason);
    if (limit.reason != "fixed" && limit.reason != "accuracy")
      why += " #" + std::to_string(limit.id);
    Progress state{
        .time = system_.time(), .time_step = limit.dt, .until = settings_.until, .limited_by = why};
    display_.progress(state);
    if constexpr (requires { display_.notice(report_); }) display_.notice(report_);
    report_.progress(state);
  }

  void sample() {
    recorder_.sample(system_.time());
    if constexpr (requires { display_.watch(report_); }) display_.watch(report_);
  }

  void write_fields(io::PvdCollection& collection) {
    const std::string number = std::to_string(10000 + frames_++).substr(1);
    int part = 0;
    for (const std::string& name :
         display_.write(settings_.output, title_, number, settings_.plots)) {
      collection.add(system_.time(), name, part++);
      fresh_.insert(file(name));
    }
  }

  // A failure is a warning, and the next fields are tried; the third in a row ends the run.
  void try_fields(io::PvdCollection& collection) {
    try {
      write_fields(collection);
      failed_fields_ = 0;
    } catch (const OutputError& error) {
      if (++failed_fields_ >= 3) throw;
      report_.warn("fields not written", std::string("W500 ") + error.what());
    }
  }

  Summary summarise() {
    Summary s;
    s.case_name = name_;
    s.backend = settings_.backend;
    s.threads = settings_.threads;
    s.time_end = system_.time();
    s.wall_seconds = wall_seconds_;
    s.phases = display_.phases();
    double accounted = output_seconds_;
    for (const Phase& phase : s.phases) accounted += phase.seconds;
    const double left = std::max(0.0, wall_seconds_ - accounted);
    if (s.phases.empty()) s.phases.push_back({"steps", left});
    const bool split = s.phases.size() > 1;
    s.phases.push_back({"output", output_seconds_});
    if (split) s.phases.push_back({"other", left});
    s.peak_memory_bytes = peak_memory();
    s.results = results_;
    display_.summarise(s);
    probes_.summarise(s);
    s.bus = steps_sent_.per_step(s.steps, s.particles);
    return s;
  }

  Settings settings_;
  std::string name_;
  std::string title_;
  System& system_;
  Display<System> display_;
  decltype(probes_of({}, std::declval<System&>())) probes_;
  RunControl control_;
  Report report_;
  std::vector<BannerLine> notes_;
  Recorder recorder_;
  std::vector<Result> results_;
  std::vector<std::string> written_;
  std::set<std::filesystem::path> fresh_;  // written since the last checkpoint
  int frames_ = 0;
  int failed_fields_ = 0;  // in a row
  double output_seconds_ = 0;
  BusSent steps_sent_;
  double wall_seconds_ = 0;
};

}  // namespace sphmbs::examples
