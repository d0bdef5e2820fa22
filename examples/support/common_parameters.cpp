// SPDX-License-Identifier: MIT
// The parameters and options of every example program.
#include <algorithm>
#include <limits>
#include <stdexcept>

#include <omp.h>

#include "support/output_folder.hpp"
#include "support/parameters_parts.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

const Bounds positive{.above = 0.0};
const Bounds courant{.above = 0.0, .at_most = 1.0};
const Bounds share{.at_least = 0.0, .at_most = 1.0};
const Bounds count{.at_least = 1.0, .at_most = 1e6};

/// Fills in what a program leaves open. Throws std::invalid_argument for what no user could give.
void complete(Program& program) {
  if (program.name.empty() || program.backends.empty()) {
    throw std::invalid_argument("Parameters: the program has no name or no back end");
  }
  Settings& defaults = program.defaults;
  if (defaults.threads == 0) defaults.threads = omp_get_max_threads();
  if (defaults.backend.empty()) defaults.backend = program.backends.front();
  if (defaults.output.empty()) defaults.output = std::filesystem::path("results") / program.name;
  const auto& backends = program.backends;
  const bool has_step = program.gas || defaults.step || defaults.accuracy;
  if (!positive.contain(program.gas ? defaults.spacing : 1.0) ||
      !positive.contain(defaults.until) || !positive.contain(defaults.step.value_or(1.0)) ||
      !courant.contain(defaults.cfl) || !has_step ||
      !positive.contain(defaults.accuracy.value_or(1.0)) ||
      !share.contain(defaults.spectral_radius) || !count.contain(defaults.fields.value_or(1)) ||
      !count.contain(defaults.samples.value_or(1)) ||
      std::find(backends.begin(), backends.end(), defaults.backend) == backends.end()) {
    throw std::invalid_argument("Parameters: " + program.name + " has a default that is not valid");
  }
  if (!program.usage_examples.empty()) return;
  program.usage_examples = {
      program.gas ? UsageExample{"--spacing " + format_exact(defaults.spacing / 2.0) +
                                     " --output results/finer",
                                 "twice the resolution"}
                  : UsageExample{"--accuracy 1e-6 --output results/accurate",
                                 "steps that follow the motion"},
      {"--threads 1 --quiet --overwrite", "one thread, silent, over the results of an earlier run"},
  };
}

}  // namespace

void Parameters::Parts::add_common() {
  complete(program);
  settings = program.defaults;
  Settings& s = settings;
  const auto add_action = [this](const char* option, bool& value, const char* meaning) {
    add(flag_parameter({"", meaning, {option}}, value, true));
  };
  if (program.gas) {
    add(number_parameter(
        {"run.spacing", "distance of neighbouring particles", {"--spacing"}}, positive, "m",
        [&s] { return s.spacing; }, [&s](double x) { s.spacing = x; }));
  }
  add(number_parameter(
      {"run.until", "physical time at which the run ends", {"--until"}}, positive, "s",
      [&s] { return s.until; }, [&s](double x) { s.until = x; }));
  add(number_parameter(
      {"run.step", "fixed time step", {"--step"}}, positive, "s", [&s] { return s.step; },
      [&s](double x) { s.step = x; }));
  if (!s.step) all.back().default_text = program.gas ? "from --cfl" : "from --accuracy";
  if (program.gas) {
    add(number_parameter(
        {"run.cfl", "Courant number of the time step, excludes --step", {"--cfl"}}, courant, "",
        [&s] { return s.step ? std::nullopt : std::optional(s.cfl); },
        [&s](double x) {
          s.cfl = x;
          s.step.reset();
        }));
  } else {
    add(number_parameter(
        {"run.accuracy",
         "steps as long as this error of a position allows, excludes --step",
         {"--accuracy"}},
        positive, "m", [&s] { return s.step ? std::nullopt : s.accuracy; },
        [&s](double x) {
          s.accuracy = x;
          s.step.reset();
        }));
  }
  if (program.structure) {
    add(number_parameter(
        {"run.spectral_radius",
         "of generalized-alpha, 1 damps no vibration, 0 the fastest ones at once",
         {"--spectral-radius"}},
        share, "", [&s] { return s.spectral_radius; }, [&s](double x) { s.spectral_radius = x; }));
    add(number_parameter(
        {"run.newton_tolerance",
         "error of a coordinate in a step of the bodies, over their size",
         {}},
        {.above = 0.0, .below = 1e-3}, "", [&s] { return s.newton_tolerance; },
        [&s](double x) { s.newton_tolerance = x; }));
    add(whole_parameter(
        {"run.newton_iterations",
         "iterations after which a step of the bodies is tried in halves",
         {}},
        {.at_least = 1.0, .at_most = 1000.0}, "", [&s] { return s.newton_iterations; },
        [&s](std::int64_t n) { s.newton_iterations = static_cast<int>(n); }));
  }
  add(whole_parameter(
      {"run.fields", "how often fields are written until the end", {}}, count, "",
      [&s] { return s.fields; }, [&s](std::int64_t n) { s.fields = static_cast<int>(n); }));
  add(whole_parameter(
      {"run.samples", "how often the history is sampled until the end", {}}, count, "",
      [&s] { return s.samples; }, [&s](std::int64_t n) { s.samples = static_cast<int>(n); }));
  add(whole_parameter(
      {"run.steps", "number of steps after which the run ends", {"--steps"}}, {.at_least = 1.0}, "",
      [&s] { return s.steps; }, [&s](std::int64_t n) { s.steps = n; }));
  add(whole_parameter(
      {"run.threads", "number of threads", {"--threads", "-t"}},
      {.at_least = 1.0, .at_most = 4096.0}, "", [&s] { return s.threads; },
      [&s](std::int64_t n) { s.threads = static_cast<int>(n); }));
  add(choice_parameter({"run.backend", "execution policy", {"--backend"}}, s.backend,
                       program.backends,
                       "compiled into this program: " + joined(program.backends, ", ") +
                           "; SPHMBS_OFFLOAD adds openacc, omp_target or cuda (docs/gpu.md)"));
  if (program.precisions.size() > 1) {
    add(choice_parameter({"run.precision", "number type of the gas's fields", {"--precision"}},
                         s.precision, program.precisions,
                         "one of " + joined(program.precisions, ", ")));
  }
  add(duration_parameter(
      {"run.walltime",
       "time on the clock after which the run ends with a checkpoint",
       {"--walltime"}},
      positive, [&s] { return s.walltime; }, [&s](double x) { s.walltime = x; }));
  add(duration_parameter(
      {"run.checkpoint_every", "time on the clock between checkpoints", {"--checkpoint-every"}},
      positive, [&s] { return s.checkpoint_every; }, [&s](double x) { s.checkpoint_every = x; }));
  if (program.gas) {
    Guards& g = s.guards;
    add(choice_parameter(
        {"guards.balance", "what is done where mass, momentum or energy of the gas get lost", {}},
        g.balance, {"stop", "warn", "off"}, "one of stop, warn, off"));
    add(number_parameter(
        {"guards.energy", "share of the gas's energy that may get lost before the run stops", {}},
        positive, "", [&g] { return g.energy; }, [&g](double x) { g.energy = x; }));
    if (program.structure) {
      add(whole_parameter(
          {"guards.leaks",
           "gas particles that may go through thin bodies before the run stops",
           {}},
          {.at_least = 0.0}, "", [&g] { return g.leaks; }, [&g](std::int64_t n) { g.leaks = n; }));
      if (!g.leaks) all.back().default_text = "any number";
    }
  }
  add(flag_parameter(
      {"run.plots", "whether pictures are drawn; --no-plots draws none", {"--no-plots"}}, s.plots,
      false));
  add(text_parameter(
      {"", "results", {"--output", "--out", "-o"}}, "DIR", "a directory",
      [&s] { return s.output.string(); }, [&s](const std::string& text) { s.output = text; }));
  add_action("--overwrite", s.overwrite, "replace files of the same names in the directory");
  Parameter& resume = add(text_parameter(
      {"", "go on from a checkpoint", {"--resume"}}, "[FILE]",
      "a checkpoint, or left out for the newest one in the directory", [] { return std::string(); },
      [&s](const std::string& text) { s.resume = text; }));
  resume.may_lack_value = true;
  add_action("--check", s.check, "read, validate and prepare, but do not run");
  add_action("--quiet", s.quiet, "print nothing but warnings and errors");
  add_action("--dump-params", dump, "show all parameters as a parameter file, and exit");
  common = all.size();
}

void Parameters::Parts::check_common(Complaints& complaints) {
  if (settings.backend == "serial") {
    const Parameter& threads = *find("run.threads");
    if (threads.origin && settings.threads != 1) {
      complaints.add(threads.origin->place, "E023",
                     named(threads.origin->name, std::to_string(settings.threads)) +
                         "must be 1 with --backend serial");
    }
    settings.threads = 1;
  }
  if (dump) return;
  const bool may_be_full = settings.overwrite || settings.resume.has_value();
  if (const auto fault = fault_of_output(settings.output, may_be_full)) {
    const Parameter& output = *find("--output");
    const Place place = output.origin ? output.origin->place : Place{"default"};
    const std::string name = output.origin ? output.origin->name : "--output";
    complaints.add(place, "E030", named(name, settings.output.string()) + *fault);
  }
}

}  // namespace sphmbs::examples
