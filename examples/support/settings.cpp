// SPDX-License-Identifier: MIT
#include "support/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <omp.h>

#include <CLI/CLI.hpp>

#include "sphmbs/core/error.hpp"
#include "sphmbs/execution/host_memory.hpp"
#include "sphmbs/version.hpp"
#include "support/build_info.hpp"
#include "support/output_folder.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view value, std::string_view why) {
  std::string line(option);
  if (!value.empty()) line.append(" ").append(value);
  throw InvalidInput(one_line(line.append(": ").append(why)));
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

bool inside(const Bounds& bounds, double value) {
  return std::isfinite(value) && (!bounds.above || value > *bounds.above) &&
         (!bounds.at_least || value >= *bounds.at_least) &&
         (!bounds.below || value < *bounds.below) && (!bounds.at_most || value <= *bounds.at_most);
}

/// "a positive number of metres, at most 1" for "must be ...".
std::string allowed_numbers(const Bounds& bounds, std::string_view unit, bool whole) {
  const bool positive = bounds.above == 0.0;
  std::string text = positive ? "a positive " : "a ";
  text += whole ? "whole number" : "number";
  if (unit == "m") {
    text += " of metres";
  } else if (unit == "s") {
    text += " of seconds";
  } else if (!unit.empty()) {
    text.append(" in ").append(unit);
  }
  if (bounds.at_least && bounds.at_most) {
    return text + " from " + format_exact(*bounds.at_least) + " to " +
           format_exact(*bounds.at_most);
  }
  std::vector<std::string> limits;
  if (bounds.above && !positive) limits.push_back("above " + format_exact(*bounds.above));
  if (bounds.at_least) limits.push_back("at least " + format_exact(*bounds.at_least));
  if (bounds.below) limits.push_back("below " + format_exact(*bounds.below));
  if (bounds.at_most) limits.push_back("at most " + format_exact(*bounds.at_most));
  return limits.empty() ? text : text + ", " + joined(limits, " and ");
}

/// Reads the whole text as a number, whatever the locale. An overflow counts as infinite.
template <class Number>
std::optional<Number> read(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    if constexpr (std::numeric_limits<Number>::has_infinity) {
      return std::numeric_limits<Number>::infinity();
    }
    return std::nullopt;
  }
  return value;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// What to do with a value once the whole command line is accepted; empty for a bad value.
using Store = std::function<void()>;
using Check = std::function<Store(const std::string& text)>;

struct Option {
  CLI::Option* handle = nullptr;
  std::string name{};
  bool takes_value = true;
  /// The value as it was typed.
  std::string text{};
  /// Completes "must be ...".
  std::string allowed{};
  Check check{};

  bool given() const { return handle->count() > 0; }
};

[[noreturn]] void refuse_missing_value(const Option& option) {
  refuse(option.name, "", "needs a value; it must be " + option.allowed);
}

}  // namespace

struct CommandLine::Parts {
  Program program;
  Settings settings;
  CLI::App app;
  // CLI11 keeps pointers to the texts, hence a container that never moves its elements.
  std::deque<Option> options;
  std::size_t common_options = 0;
  std::string group;

  void add_value(const std::string& name, const std::string& placeholder, const std::string& help,
                 const std::string& allowed, const std::string& default_text, Check check);
  template <class Number, class StoreNumber>
  void add_numeric(const std::string& name, const Bounds& bounds, const std::string& unit,
                   const std::string& help, const std::string& default_text, StoreNumber store);
  void add_one_of(const std::string& name, std::string& value,
                  const std::vector<std::string>& choices, const std::string& help,
                  const std::string& allowed);
  void add_switch(const std::string& name, bool& value, const std::string& help);
  void add_common_options();
  /// The option that lets the step vary.
  std::string variable_step() const { return program.gas ? "--cfl" : "--accuracy"; }

  void split(int argc, const char* const* argv);
  void refuse_misuse(const std::vector<std::string>& words_reversed) const;
  [[noreturn]] void refuse_unknown(std::string word) const;
  const Option& find(std::string_view name) const;
  std::vector<Store> checked_stores() const;
};

void CommandLine::Parts::add_value(const std::string& name, const std::string& placeholder,
                                   const std::string& help, const std::string& allowed,
                                   const std::string& default_text, Check check) {
  std::string line = help + ": " + allowed;
  if (!default_text.empty()) line += " (default " + default_text + ")";
  Option& option = options.emplace_back();
  option.name = name;
  option.allowed = allowed;
  option.check = std::move(check);
  option.handle = app.add_option(name, option.text, line)->option_text(placeholder)->group(group);
}

template <class Number, class StoreNumber>
void CommandLine::Parts::add_numeric(const std::string& name, const Bounds& bounds,
                                     const std::string& unit, const std::string& help,
                                     const std::string& default_text, StoreNumber store) {
  const std::string allowed = allowed_numbers(bounds, unit, std::is_integral_v<Number>);
  const auto check = [bounds, store](const std::string& text) -> Store {
    const auto number = read<Number>(text);
    if (!number || !inside(bounds, static_cast<double>(*number))) return {};
    return [store, number] { store(*number); };
  };
  add_value(name, unit.empty() ? "NUMBER" : "NUMBER [" + unit + "]", help, allowed, default_text,
            check);
}

void CommandLine::Parts::add_one_of(const std::string& name, std::string& value,
                                    const std::vector<std::string>& choices,
                                    const std::string& help, const std::string& allowed) {
  const auto check = [&value, choices](const std::string& text) -> Store {
    if (std::find(choices.begin(), choices.end(), text) == choices.end()) return {};
    return [&value, text] { value = text; };
  };
  add_value(name, "NAME", help, allowed, value, check);
}

void CommandLine::Parts::add_switch(const std::string& name, bool& value, const std::string& help) {
  Option& option = options.emplace_back();
  option.name = name;
  option.takes_value = false;
  option.check = [&value](const std::string&) -> Store { return [&value] { value = true; }; };
  option.handle = app.add_flag(name, help)->disable_flag_override()->group(group);
}

void CommandLine::Parts::add_common_options() {
  const Settings& defaults = program.defaults;
  const Bounds positive{.above = 0.0};
  group = "Options of every case";
  app.set_help_flag("-h,--help", "show this help and exit")->group(group);
  app.set_version_flag("--version", "", "show versions, compiler and flags, and exit")
      ->group(group);
  if (program.gas) {
    add_numeric<double>("--spacing", positive, "m", "distance of neighbouring particles",
                        format_exact(defaults.spacing),
                        [this](double value) { settings.spacing = value; });
  }
  add_numeric<double>("--until", positive, "s", "physical time at which the run ends",
                      format_exact(defaults.until),
                      [this](double value) { settings.until = value; });
  add_numeric<double>("--step", positive, "s", "fixed time step",
                      defaults.step ? format_exact(*defaults.step) : "from " + variable_step(),
                      [this](double value) { settings.step = value; });
  if (program.gas) {
    add_numeric<double>("--cfl", {.above = 0.0, .at_most = 1.0}, "",
                        "Courant number of the time step, excludes --step",
                        defaults.step ? "" : format_exact(defaults.cfl), [this](double value) {
                          settings.cfl = value;
                          settings.step.reset();
                        });
  } else {
    add_numeric<double>("--accuracy", positive, "m",
                        "steps as long as this error of a position allows, excludes --step",
                        defaults.accuracy ? format_exact(*defaults.accuracy) : "",
                        [this](double value) {
                          settings.accuracy = value;
                          settings.step.reset();
                        });
  }
  if (program.structure) {
    add_numeric<double>("--spectral-radius", {.at_least = 0.0, .at_most = 1.0}, "",
                        "of generalized-alpha, 1 damps no vibration, 0 the fastest ones at once",
                        format_exact(defaults.spectral_radius),
                        [this](double value) { settings.spectral_radius = value; });
  }
  add_numeric<int>("--threads", {.at_least = 1.0, .at_most = 4096.0}, "", "number of threads",
                   std::to_string(defaults.threads),
                   [this](int value) { settings.threads = value; });
  add_one_of("--backend", settings.backend, program.backends, "execution policy",
             "compiled into this program: " + joined(program.backends, ", ") +
                 "; SPHMBS_OFFLOAD adds openacc, omp_target or cuda (docs/gpu.md)");
  if (program.precisions.size() > 1)
    add_one_of("--precision", settings.precision, program.precisions,
               "number type of the gas's fields", "one of " + joined(program.precisions, ", "));
  add_value("--output", "DIR", "results", "a directory", defaults.output.string(),
            [this](const std::string& text) -> Store {
              return [this, text] { settings.output = text; };
            });
  add_switch("--overwrite", settings.overwrite, "replace files of the same names in the directory");
  add_switch("--quiet", settings.quiet, "print nothing but warnings and errors");
  common_options = options.size();
  group = "Options of this case";
}

void CommandLine::Parts::split(int argc, const char* const* argv) {
  // CLI11 takes the words last first.
  const std::vector<std::string> words(std::make_reverse_iterator(argv + argc),
                                       std::make_reverse_iterator(argv + std::min(argc, 1)));
  try {
    app.parse(std::vector<std::string>(words));
  } catch (const CLI::ParseError& error) {
    refuse_misuse(words);
    throw InvalidInput(one_line(error.what()));
  }
}

/// Says what is wrong with the words that CLI11 could not take. Its own messages differ from
/// version to version and name types of C++.
void CommandLine::Parts::refuse_misuse(const std::vector<std::string>& words_reversed) const {
  for (const Option& option : options) {
    const std::string assigned = option.name + "=";
    const auto is_assigned = [&](const std::string& word) { return word.starts_with(assigned); };
    const auto names_it = [&](const std::string& word) {
      return word == option.name || is_assigned(word);
    };
    if (!option.takes_value && std::ranges::any_of(words_reversed, is_assigned)) {
      refuse(option.name, "", "takes no value");
    }
    if (std::ranges::count_if(words_reversed, names_it) > 1) {
      refuse(option.name, "", "is given more than once");
    }
    if (option.takes_value && names_it(words_reversed.front())) refuse_missing_value(option);
  }
}

void CommandLine::Parts::refuse_unknown(std::string word) const {
  if (!word.starts_with('-')) {
    refuse(word, "", "is not an option; each value follows the name of its option, see --help");
  }
  word = word.substr(0, word.find('='));
  const auto bare = [](std::string_view text) {
    return text.substr(std::min(text.find_first_not_of('-'), text.size()));
  };
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, bare(word).size() / 3) + 1;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = "--" + option->get_lnames().front();
    const bool starts = !bare(word).empty() && bare(name).starts_with(bare(word));
    const std::size_t distance = starts ? 0 : edit_distance(bare(word), bare(name));
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  refuse(word, "",
         nearest.empty() ? "is not an option; --help lists all"
                         : "is not an option; did you mean " + nearest + "?");
}

const Option& CommandLine::Parts::find(std::string_view name) const {
  return *std::find_if(options.begin(), options.end(),
                       [name](const Option& option) { return option.name == name; });
}

/// What to do for each option that is given; nothing for the others.
std::vector<Store> CommandLine::Parts::checked_stores() const {
  std::vector<Store> stores;
  for (const Option& option : options) {
    Store& store = stores.emplace_back();
    if (!option.given()) {
      store = [] {};
      continue;
    }
    if (option.takes_value && (option.text.empty() || option.text.starts_with("--"))) {
      refuse_missing_value(option);
    }
    store = option.check(option.text);
    if (!store) refuse(option.name, option.text, "must be " + option.allowed);
  }
  return stores;
}

CommandLine::CommandLine(Program program) : parts_(std::make_unique<Parts>()) {
  if (program.name.empty() || program.backends.empty()) {
    throw std::invalid_argument("CommandLine: the program has no name or no back end");
  }
  Settings& defaults = program.defaults;
  if (defaults.threads == 0) defaults.threads = omp_get_max_threads();
  if (defaults.backend.empty()) defaults.backend = program.backends.front();
  if (defaults.output.empty()) defaults.output = std::filesystem::path("results") / program.name;
  const Bounds positive{.above = 0.0};
  const auto& backends = program.backends;
  const bool has_step = program.gas || defaults.step || defaults.accuracy;
  if (!inside(positive, program.gas ? defaults.spacing : 1.0) ||
      !inside(positive, defaults.until) || !inside(positive, defaults.step.value_or(1.0)) ||
      !inside({.above = 0.0, .at_most = 1.0}, defaults.cfl) || !has_step ||
      !inside(positive, defaults.accuracy.value_or(1.0)) ||
      !inside({.at_least = 0.0, .at_most = 1.0}, defaults.spectral_radius) ||
      std::find(backends.begin(), backends.end(), defaults.backend) == backends.end()) {
    throw std::invalid_argument("CommandLine: " + program.name +
                                " has a default that is not valid");
  }
  if (program.usage_examples.empty()) {
    program.usage_examples = {
        program.gas ? UsageExample{"--spacing " + format_exact(defaults.spacing / 2.0) +
                                       " --output results/finer",
                                   "twice the resolution"}
                    : UsageExample{"--accuracy 1e-6 --output results/accurate",
                                   "steps that follow the motion"},
        {"--threads 1 --quiet --overwrite",
         "one thread, silent, over the results of an earlier run"},
    };
  }
  parts_->program = std::move(program);
  parts_->settings = parts_->program.defaults;
  parts_->app.allow_extras();
  parts_->add_common_options();
}

CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;
CommandLine& CommandLine::operator=(CommandLine&&) noexcept = default;

void CommandLine::add_number(const std::string& name, double& value, const Bounds& bounds,
                             const std::string& unit, const std::string& help) {
  parts_->add_numeric<double>(name, bounds, unit, help, format_exact(value),
                              [&value](double given) { value = given; });
}

void CommandLine::add_whole_number(const std::string& name, int& value, const Bounds& bounds,
                                   const std::string& unit, const std::string& help) {
  parts_->add_numeric<int>(name, bounds, unit, help, std::to_string(value),
                           [&value](int given) { value = given; });
}

void CommandLine::add_choice(const std::string& name, std::string& value,
                             const std::vector<std::string>& choices, const std::string& help) {
  parts_->add_one_of(name, value, choices, help, "one of " + joined(choices, ", "));
}

void CommandLine::add_flag(const std::string& name, bool& value, const std::string& help) {
  parts_->add_switch(name, value, help);
}

std::optional<Settings> CommandLine::parse(int argc, const char* const* argv, std::ostream& out) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "-h" || word == "--help") {
      out << help();
      return std::nullopt;
    }
    if (word == "--version") {
      out << version_line() << '\n';
      return std::nullopt;
    }
  }

  Parts& parts = *parts_;
  Settings& settings = parts.settings;
  settings = parts.program.defaults;
  parts.split(argc, argv);
  if (const auto unknown = parts.app.remaining(); !unknown.empty()) {
    parts.refuse_unknown(unknown.front());
  }
  const Option& step = parts.find("--step");
  const std::string variable = parts.variable_step();
  if (step.given() && parts.find(variable).given()) {
    refuse(step.name, step.text, "excludes " + variable + "; give one of them");
  }

  const std::vector<Store> stores = parts.checked_stores();
  const auto first_of_case = stores.begin() + static_cast<std::ptrdiff_t>(parts.common_options);
  std::for_each(stores.begin(), first_of_case, [](const Store& store) { store(); });
  if (settings.backend == "serial") {
    if (parts.find("--threads").given()) {
      require(settings.threads == 1, "--threads", settings.threads, "1 with --backend serial");
    }
    settings.threads = 1;
  }
  if (const auto fault = fault_of_output(settings.output, settings.overwrite)) {
    refuse("--output", settings.output.string(), *fault);
  }
  std::for_each(first_of_case, stores.end(), [](const Store& store) { store(); });
  return settings;
}

std::string CommandLine::help() const {
  Parts& parts = *parts_;
  const Program& program = parts.program;
  std::string footer = "Examples:\n";
  for (const UsageExample& example : program.usage_examples) {
    footer += "  " + padded(program.name + " " + example.options, 52) + example.meaning + '\n';
  }
  footer +=
      "\nExit codes: 0 done, 1 internal error, 2 bad input, 3 numerical failure, 5 output failed,\n"
      "6 out of memory.\n";
  parts.app.name(program.name);
  parts.app.description(program.name + ": " + program.title);
  parts.app.footer(footer);
  parts.app.get_formatter()->column_width(28);
  return parts.app.help();
}

std::string CommandLine::version_line() const {
  const Program& program = parts_->program;
  return program.name + " (sphmbs " + std::string(version) + ") | " + build_info() +
         " | back ends " + joined(program.backends, ", ");
}

std::string CommandLine::memory_advice() const {
  return parts_->program.gas ? "a larger --spacing means fewer particles"
                             : "fewer elements need less of it";
}

void require(bool condition, std::string_view option, double value, std::string_view allowed) {
  require(condition, option, format_exact(value), allowed);
}

void require(bool condition, std::string_view option, std::string_view value,
             std::string_view allowed) {
  if (!condition) refuse(option, value, "must be " + std::string(allowed));
}

void require_memory(double particles, double spacing) {
  constexpr double bytes_per_particle = 600;
  const double most =
      static_cast<double>(execution::HostMemory::device().memory) / bytes_per_particle;
  require(particles < most, "--spacing", spacing,
          "wide enough for the memory of this computer, about " + format_number(most, 2) +
              " particles");
}

}  // namespace sphmbs::examples
