// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include <sphmbs/core/vec.hpp>
#include <sphmbs/io/pvd.hpp>
#include <sphmbs/run.hpp>
#include <sphmbs/version.hpp>

#include "support/crash_report.hpp"
#include "support/display.hpp"
#include "support/history.hpp"
#include "support/output_folder.hpp"
#include "support/probes.hpp"
#include "support/report.hpp"
#include "support/run_control.hpp"
#include "support/session_checkpoints.hpp"
#include "support/text.hpp"
#include "support/view_script.hpp"

namespace sphmbs::examples {

/// What an example does around its system: banner, progress, history, trajectories, files of
/// fields, pictures, summary.
template <class System>
class Session {
 public:
  using Place = Vec<System::dim>;
  /// Interval of trajectories.csv [s].
  static constexpr double trace_interval = 5e-3;

  Session(const Settings& settings, std::string name, std::string title, System& system)
      : settings_(settings),
        name_(std::move(name)),
        title_(std::move(title)),
        system_(system),
        display_(system),
        probes_(probes_of(settings.probes, system)),
        control_(settings_),
        report_(settings.quiet) {
    for (const auto& column : display_.columns()) history_.add(column.name, column.unit);
    sampled_.push_back([this](std::vector<double>& row) { display_.sample(row); });
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// A line of the banner.
  void note(std::string key, std::string value) {
    notes_.push_back({std::move(key), std::move(value), ""});
  }

  /// Samples the gas at a place: columns speed_<name> and p_<name>.
  void probe(const std::string& name, const Place& place) requires requires(System& gas) {
    gas.sample(place);
  }
  {
    history_.add("speed_" + name, "m/s");
    history_.add("p_" + name, "Pa");
    sampled_.push_back([this, place](std::vector<double>& row) {
      const auto s = system_.sample(place);
      row.push_back(std::sqrt(norm2(s.v)));
      row.push_back(s.p);
    });
  }

  /// Records any quantity in history.csv.
  void record(const std::string& name, const std::string& unit, std::function<double()> value) {
    history_.add(name, unit);
    sampled_.push_back(
        [value = std::move(value)](std::vector<double>& row) { row.push_back(value()); });
  }

  /// Records any quantity in trajectories.csv.
  void trace(const std::string& name, const std::string& unit, std::function<double()> value) {
    traces_.add(name, unit);
    traced_.push_back(std::move(value));
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
    SessionCheckpoints checkpoints(settings_, name_, identity());
    const auto from = settings_.resume ? checkpoints.open(report_) : nullptr;
    display_.prepare();

    Every sampling(
        settings_.until / samples, [&](System&) { timed([&] { sample(); }); }, Timing::next_step);
    Every tracing(traced_.empty() ? settings_.until : trace_interval,
                  [&](System&) { timed([&] { trace_row(); }); });
    const std::string list = std::string(Display<System>::collection) + ".pvd";
    std::optional<io::PvdCollection> collection;
    Every writing(settings_.until / fields,
                  [&](System&) { timed([&] { write_fields(*collection); }); });
    written_ = {list, "history.csv", "view.py"};
    if (!traced_.empty()) written_.push_back("trajectories.csv");
    if (settings_.check) check(is_new, seconds_since(begin));
    write_used(settings_);
    control_.begin();
    std::filesystem::remove(file("summary.json"));  // of an earlier run, should this one fail
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
      archive("collection", *collection);
      archive("history", history_);
      archive("traces", traces_);
      archive("probes", probed);
      archive("written", written_);
      archive("frames", frames_);
      archive("output_seconds", output_seconds_);
      archive("wall_seconds", wall_seconds_);
    };
    collection.emplace(file(list));
    if (from) {
      io::StateReader reader(*from);
      show(reader);
    } else {
      checkpoints.forget_earlier();
    }
    const double earlier = wall_seconds_;
    banner(is_new, from ? from->path().string() : "");
    const std::string comment = name_ + ", sphmbs " + std::string(version);
    history_.begin(file("history.csv"), comment);
    if (!traced_.empty()) traces_.begin(file("trajectories.csv"), comment);

    if (!from)
      write_view_script(settings_.output, view_of(system_, title_, list, settings_.spacing));
    probes_.begin(settings_.output, comment, settings_.until / samples, probed);

    RunControl::Decision decision;
    std::filesystem::path saved;
    BetweenSteps boundary([&](System&) {
      decision = control_.decide(steps());
      wall_seconds_ = earlier + seconds_since(begin);
      if (decision.save) timed([&] { saved = checkpoints.save(steps(), report_, control_, show); });
      return decision.stop.empty();
    });
    steps_sent_ -= sent();
    const Schedule schedule{settings_.until, settings_.cfl, step()};
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

  History& history() { return history_; }
  /// What trajectories.csv holds.
  History& traces() { return traces_; }
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

  /// Over the bus of a device: bytes, and loops that were started.
  struct Sent {
    double bytes = 0;
    double loops = 0;
    double arguments = 0;
    Sent& operator+=(const Sent& o) {
      bytes += o.bytes;
      loops += o.loops;
      arguments += o.arguments;
      return *this;
    }
    Sent& operator-=(const Sent& o) { return *this += {-o.bytes, -o.loops, -o.arguments}; }
    friend Sent operator-(Sent a, const Sent& b) { return a -= b; }
  };
  Sent sent() const {
    if constexpr (requires { display_.bus(); }) {
      const auto bus = display_.bus();
      return {static_cast<double>(bus.bytes()), static_cast<double>(bus.launches),
              static_cast<double>(bus.arguments)};
    }
    return {};
  }

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
    const Sent before = sent();
    output();
    output_seconds_ += seconds_since(begin);
    steps_sent_ -= sent() - before;
  }

  // A fixed step, shortened so that trajectories meet their times.
  std::optional<double> step() const {
    if (!settings_.step || traced_.empty()) return settings_.step;
    return trace_interval / std::ceil(trace_interval / *settings_.step - 1e-9);
  }

  std::int64_t steps() const {
    Progress state;
    display_.progress(state);
    return state.step;
  }

  // The types that the state is of.
  io::Identity identity() const {
    io::Identity types{{"dimension", std::to_string(System::dim)}};
    const auto add_gas = [&]<class Scheme>(std::type_identity<Scheme>) {
      types["kernel"] = readable_type(typeid(typename Scheme::Kernel));
      types["Riemann solver"] = readable_type(typeid(typename Scheme::Riemann));
      types["equation of state"] = readable_type(typeid(decltype(Scheme::eos)));
      types["scheme"] = readable_type(typeid(Scheme));
    };
    if constexpr (requires { typename System::SchemeType; })
      add_gas(std::type_identity<typename System::SchemeType>());
    else if constexpr (requires { system_.fluid(); })
      add_gas(std::type_identity<
              typename std::remove_cvref_t<decltype(system_.fluid())>::SchemeType>());
    if constexpr (requires { system_.structure(); })
      types["structure"] = readable_type(typeid(system_.structure()));
    return types;
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
    throw Stopped(decision.exit_code, where + "checkpoint " + saved.string() +
                                          "; go on with --resume --output " +
                                          settings_.output.string());
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
    shown.step = step();
    const auto own = display_.banner(shown);
    lines.insert(lines.end(), own.begin(), own.end());
    report_.banner(title_, lines);
    if (settings_.step && std::abs(*shown.step - *settings_.step) > 1e-9 * *settings_.step)
      report_.warn("step", "shortened from " + format_exact(*settings_.step) + " to " +
                               format_number(*shown.step, 6) + " s, a whole fraction of the " +
                               format_exact(trace_interval) +
                               " s between rows of trajectories.csv");
    display_.heed(shown, report_);
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
    std::vector<double> row;
    for (const auto& add : sampled_) add(row);
    history_.row(system_.time(), row);
  }

  void trace_row() {
    if (traced_.empty()) return;
    std::vector<double> row;
    for (const auto& value : traced_) row.push_back(value());
    const double t = system_.time(), due = trace_interval * std::round(t / trace_interval);
    traces_.row(std::abs(t - due) < 1e-9 * trace_interval ? due : t, row);
  }

  void write_fields(io::PvdCollection& collection) {
    const std::string number = std::to_string(10000 + frames_++).substr(1);
    int part = 0;
    for (const std::string& name :
         display_.write(settings_.output, title_, number, settings_.plots))
      collection.add(system_.time(), name, part++);
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
    if (steps_sent_.loops > 0) {
      const double steps = static_cast<double>(std::max<std::int64_t>(1, s.steps));
      const double particles = static_cast<double>(s.particles.gas + s.particles.virtual_particles);
      s.bus = BusCounts{steps_sent_.bytes / steps, steps_sent_.bytes / steps / particles,
                        steps_sent_.loops / steps, steps_sent_.arguments / steps};
    }
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
  History history_;
  History traces_;
  std::vector<std::function<void(std::vector<double>&)>> sampled_;
  std::vector<std::function<double()>> traced_;
  std::vector<Result> results_;
  std::vector<std::string> written_;
  int frames_ = 0;
  double output_seconds_ = 0;
  Sent steps_sent_;
  double wall_seconds_ = 0;
};

}  // namespace sphmbs::examples
