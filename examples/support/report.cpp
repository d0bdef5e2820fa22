// SPDX-License-Identifier: MIT
#include "support/report.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numeric>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

#include "sphmbs/version.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

constexpr std::size_t key_width = 10;
constexpr std::size_t value_width = 54;
constexpr double terminal_interval = 0.1;
constexpr double log_interval = 5.0;
constexpr int rows_per_heading = 40;
constexpr std::size_t bar_width = 24;
constexpr auto erase_line = "\r\x1b[K";

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string aligned_right(std::string_view text, std::size_t width) {
  const std::size_t used = text_width(text);
  return std::string(used < width ? width - used : 0, ' ') + std::string(text);
}

double fraction_done(const Progress& state) {
  const double fraction = state.until > 0.0 ? state.time / state.until : 0.0;
  return std::clamp(fraction, 0.0, 1.0);
}

void print_line(std::ostream& out, std::string_view key, std::string_view value,
                std::string_view aside = {}) {
  out << padded(key, key_width);
  if (aside.empty()) {
    out << value << '\n';
  } else {
    out << padded(value, value_width) << aside << '\n';
  }
}

std::string percent(double part, double whole) {
  return whole > 0.0 ? std::to_string(std::lround(100.0 * part / whole)) + " %" : "-";
}

std::string phases_text(const Summary& summary) {
  const double known =
      std::accumulate(summary.phases.begin(), summary.phases.end(), 0.0,
                      [](double sum, const Phase& phase) { return sum + phase.seconds; });
  std::string text;
  const auto add = [&](const std::string& name, double seconds) {
    if (!text.empty()) text += " | ";
    text +=
        name + " " + format_duration(seconds) + " (" + percent(seconds, summary.wall_seconds) + ")";
  };
  for (const Phase& phase : summary.phases) add(phase.name, phase.seconds);
  const double other = summary.wall_seconds - known;
  if (other >= 0.005 * summary.wall_seconds) add("other", other);
  return text;
}

std::string difference_text(const Result& result) {
  if (!result.reference) return "-";
  const double difference = result.value - *result.reference;
  const bool relative = *result.reference != 0.0;
  char text[64];
  std::snprintf(text, sizeof text, relative ? "%+.2f %%" : "%+.3g",
                relative ? 100.0 * difference / std::abs(*result.reference) : difference);
  return text;
}

void print_structure(std::ostream& out, const Summary& summary, const std::string& aside) {
  const StructureCounts& structure = *summary.structure;
  const double steps = std::max(1.0, static_cast<double>(summary.steps));
  const std::string text = format_number(static_cast<double>(structure.iterations) / steps, 3) +
                           " iterations a step, " + format_count(structure.factorisations) +
                           " factorisations";
  print_line(out, "newton", text, aside);
  if (has_gas(summary)) return;
  print_line(out, "conserved", "energy " + format_number(summary.conservation.energy, 2),
             "(over the largest kinetic energy)");
  print_line(out, "joints", "hold to " + format_number(structure.violation, 2),
             "(over the structure's size)");
}

std::string incidents_text(const Summary& summary) {
  std::string text;
  const auto add = [&text](std::int64_t count, const char* what) {
    text += (text.empty() ? "" : ", ") + format_count(count) + " " + what;
  };
  if (has_gas(summary)) {
    const Incidents& met = summary.incidents;
    add(met.lost, "particles lost");
    if (met.leaked) add(*met.leaked, "leaked");
    add(met.retries, "steps tried again");
    add(met.refused, "reconstructions refused");
  }
  if (summary.structure) {
    add(summary.structure->halvings, "halvings");
    add(summary.structure->rejected, "steps of bodies rejected");
  }
  return text;
}

void print_results(std::ostream& out, const std::vector<Result>& results) {
  std::size_t name_width = 4;
  std::size_t unit_width = 4;
  for (const Result& result : results) {
    name_width = std::max(name_width, text_width(result.name));
    unit_width = std::max(unit_width, text_width(result.unit));
  }
  const auto row = [&](std::string_view key, std::string_view name, std::string_view value,
                       std::string_view reference, std::string_view unit,
                       std::string_view difference) {
    out << padded(key, key_width) << padded(name, name_width + 1) << aligned_right(value, 13)
        << aligned_right(reference, 14) << "  " << padded(unit, unit_width + 1)
        << aligned_right(difference, 12) << '\n';
  };
  row("results", "", "computed", "reference", "unit", "difference");
  for (const Result& result : results) {
    row("", result.name, format_number(result.value, 6),
        result.reference ? format_number(*result.reference, 6) : "-", result.unit,
        difference_text(result));
  }
}

}  // namespace

ReportStyle console_style(bool quiet) {
  ReportStyle style{.quiet = quiet, .terminal = ::isatty(STDOUT_FILENO) == 1};
  winsize size{};
  if (style.terminal && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.width = size.ws_col;
  }
  return style;
}

Report::Report(std::ostream& out, std::ostream& err, ReportStyle style)
    : out_(&out), err_(&err), style_(std::move(style)) {
  if (!style_.clock) style_.clock = steady_seconds;
}

Report::Report(bool quiet) : Report(std::cout, std::cerr, console_style(quiet)) {}

void Report::banner(std::string_view title, const std::vector<BannerLine>& lines) {
  if (style_.quiet) return;
  *out_ << "sphmbs " << version << "  " << title << '\n';
  for (const BannerLine& line : lines) print_line(*out_, line.key, line.value, line.aside);
  *out_ << std::endl;
}

void Report::progress(const Progress& state) {
  if (style_.quiet) return;
  const double now = style_.clock();
  const int tenth = static_cast<int>(10.0 * fraction_done(state));
  const bool first = !std::exchange(started_, true);
  if (first) {
    start_clock_ = now;
    start_time_ = state.time;
  }
  const double interval = style_.terminal ? terminal_interval : log_interval;
  if (!first && tenth <= last_tenth_ && now - last_clock_ < interval) return;
  if (style_.terminal) {
    print_bar(state, now);
  } else {
    print_row(state, now);
  }
  last_tenth_ = std::max(last_tenth_, tenth);
  last_clock_ = now;
  last_pairs_ = state.pair_interactions.value_or(0);
  last_iterations_ = state.iterations.value_or(0);
  last_step_ = state.step;
}

double Report::seconds_left(const Progress& state, double now) const {
  return (state.until - state.time) * (now - start_clock_) / (state.time - start_time_);
}

void Report::print_bar(const Progress& state, double now) {
  const double fraction = fraction_done(state);
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(bar_width));
  std::string line = "[" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "]" +
                     aligned_right(percent(fraction, 1.0), 6) + "  step " +
                     format_count(state.step) + "  t " + format_number(state.time) + " s  dt " +
                     format_number(state.time_step, 3) + " s";
  if (!state.limited_by.empty()) line.append(" (").append(state.limited_by).append(")");
  line += "  ETA " + format_clock(seconds_left(state, now));
  // A line that wraps could not be erased. Its text is ASCII but for `limited_by`.
  if (line.size() >= style_.width) line.resize(style_.width - 1);
  *out_ << erase_line << line << std::flush;
  bar_shown_ = true;
}

void Report::print_row(const Progress& state, double now) {
  if (rows_++ % rows_per_heading == 0) {
    *out_ << "    step       t [s]      dt [s]  limited by          "
          << (state.pair_interactions ? "  Mpair/s" : "") << (state.iterations ? "  it/step" : "")
          << "     ETA\n";
  }
  const auto ratio = [&](std::int64_t part, double whole, double scale) {
    const bool known = rows_ > 1 && whole > 0.0;
    return aligned_right(
        known ? format_number(scale * static_cast<double>(part) / whole) : std::string("-"), 9);
  };
  *out_ << aligned_right(format_count(state.step), 8)
        << aligned_right(format_number(state.time), 12)
        << aligned_right(format_number(state.time_step), 12) << "  "
        << padded(state.limited_by, 20);
  if (state.pair_interactions)
    *out_ << ratio(*state.pair_interactions - last_pairs_, now - last_clock_, 1e-6);
  if (state.iterations)
    *out_ << ratio(*state.iterations - last_iterations_,
                   static_cast<double>(state.step - last_step_), 1.0);
  *out_ << aligned_right(format_clock(seconds_left(state, now)), 8) << std::endl;
}

void Report::clear_bar() {
  if (std::exchange(bar_shown_, false)) *out_ << erase_line << std::flush;
}

void Report::warn(std::string_view kind, std::string_view message) {
  const auto known = std::find_if(warnings_.begin(), warnings_.end(),
                                  [kind](const Warning& warning) { return warning.kind == kind; });
  if (known != warnings_.end()) {
    ++known->count;
    return;
  }
  warnings_.push_back({std::string(kind), 1});
  clear_bar();
  *err_ << "warning: " << kind << ": " << message << std::endl;
}

void Report::finish(const Summary& summary, const std::vector<std::string>& written) {
  if (style_.quiet) return;
  clear_bar();
  std::ostream& out = *out_;
  out << '\n';
  print_line(out, "done",
             format_count(summary.steps) + " steps, t = " + format_number(summary.time_end) +
                 " s in " + format_duration(summary.wall_seconds));
  if (!summary.phases.empty()) print_line(out, "phases", phases_text(summary));
  const std::string memory = "peak memory " + format_bytes(summary.peak_memory_bytes);
  if (summary.structure) print_structure(out, summary, has_gas(summary) ? "" : memory);
  if (has_gas(summary)) {
    print_line(out, "pairs",
               format_number(static_cast<double>(summary.pair_interactions)) + " interactions, " +
                   format_number(1e-6 * pair_interactions_per_second(summary)) + " million/s",
               memory);
    if (summary.bus)
      print_line(
          out, "bus",
          format_number(summary.bus->bytes_per_step, 3) + " bytes a step, " +
              format_number(summary.bus->bytes_per_particle_and_step, 2) + " a particle and step",
          format_number(summary.bus->loops_per_step, 3) + " loops a step with " +
              format_number(summary.bus->argument_bytes_per_step, 3) + " bytes of arguments");
    const Conservation& conservation = summary.conservation;
    print_line(out, "conserved",
               "mass " + format_number(conservation.mass, 2) + " | momentum " +
                   format_number(conservation.momentum, 2) + " | energy " +
                   format_number(conservation.energy, 2),
               "(relative change)");
  }
  print_line(out, "incidents", incidents_text(summary));
  if (!summary.results.empty()) print_results(out, summary.results);
  for (const Warning& warning : warnings_) {
    print_line(out, "warning",
               warning.kind + ": " + format_count(warning.count) +
                   (warning.count == 1 ? " time" : " times"));
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    print_line(out, i == 0 ? "wrote" : "", written[i]);
  }
  out.flush();
}

}  // namespace sphmbs::examples
