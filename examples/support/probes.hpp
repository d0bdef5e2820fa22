// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/sph/probe.hpp>
#include <sphmbs/sph/probe_fields.hpp>

#include "support/probe_file.hpp"
#include "support/report.hpp"
#include "support/summary.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {

/// The probes of a run. All that are due at a time share the passes over the particles, and none
/// changes a step: a sample belongs to the first step at or after its time.
template <class Fluid>
class Probes {
 public:
  static constexpr int dim = Fluid::dim;
  using Field = sph::ProbeField<dim>;

  /// @throws InvalidInput: E050 for a place outside the domain, E051 for an unknown field, E052 for
  ///         other faults of a description or two probes of one name.
  Probes(const std::vector<ProbeSpec>& specs, Fluid& fluid) : fluid_(&fluid) {
    ProbeSpace space{.dim = dim};
    for (std::size_t k = 0; k < std::size_t{dim}; ++k) {
      space.lower[k] = fluid.domain().box.lower[static_cast<int>(k)];
      space.upper[k] = fluid.domain().box.upper[static_cast<int>(k)];
      space.periodic[k] = fluid.domain().periodic[k];
    }
    for (const ProbeSpec& spec : specs) {
      for (const Probe& other : probes_)
        if (other.file.spec().name == spec.name)
          throw InvalidInput("probe \"" + spec.name + "\": another probe has this name", "E052");
      probes_.push_back({ProbeFile(spec, space), fields_of(spec)});
    }
  }

  bool empty() const { return probes_.empty(); }

  /// Adds a quantity of the program's own to a probe, before begin().
  /// @throws InvalidInput (E052) for a probe that there is not.
  void add(const std::string& probe, Field field) {
    const auto it = std::find_if(probes_.begin(), probes_.end(),
                                 [&](const Probe& p) { return p.file.spec().name == probe; });
    if (it == probes_.end())
      throw InvalidInput("probe \"" + probe + "\": there is no probe of this name", "E052");
    it->fields.push_back(std::move(field));
  }

  /// Creates the files, or goes on with them.
  /// @param interval  of probes without one of their own [s]
  /// @param resume    what progress() was at the checkpoint; empty for a new run
  /// @throws OutputError with path and reason; InvalidInput (E052) if the progress is that of
  ///         another number of probes.
  void begin(const std::filesystem::path& folder, const std::string& comment, double interval,
             const std::vector<ProbeProgress>& resume = {}) {
    if (!resume.empty() && resume.size() != probes_.size())
      throw InvalidInput("probes: there are " + std::to_string(probes_.size()) + ", but " +
                             std::to_string(resume.size()) + " when the run was stopped",
                         "E052");
    for (std::size_t k = 0; k < probes_.size(); ++k) {
      Probe& probe = probes_[k];
      probe.interval = probe.file.spec().interval > 0 ? probe.file.spec().interval : interval;
      std::optional<ProbeProgress> from;
      if (!resume.empty()) {
        from = resume[k];  // perhaps with another interval
        from->intervals = from->sampled < 0 ? 0 : next_interval(from->sampled, probe.interval);
      }
      probe.file.begin(folder, comment, columns(probe), from);
    }
  }

  /// Whether a probe is to be sampled now; at the `last` time all are that have not been.
  bool due(bool last = false) const {
    return std::any_of(probes_.begin(), probes_.end(),
                       [&](const Probe& probe) { return is_due(probe, last); });
  }

  /// Samples the probes that are due and writes their rows.
  /// @throws OutputError with path and reason.
  void observe(Report& report, bool last = false) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const double time = fluid_->time();
    std::vector<Vec<dim>> points;
    std::vector<Probe*> now;
    for (Probe& probe : probes_)
      if (is_due(probe, last)) {
        now.push_back(&probe);
        if (!is_volume(probe))
          for (const auto& place : probe.file.places().points) points.push_back(vec(place));
      }
    std::vector<sph::LocalGas<dim>> gas;
    if (!points.empty()) gas = sph::gas_at(*fluid_, std::span<const Vec<dim>>(points));
    auto next = gas.begin();
    for (Probe* probe : now) {
      const auto& places = probe->file.places().points;
      std::vector<double> values;
      std::int64_t blind = 0;
      const auto add = [&](const sph::LocalGas<dim>& local) {
        blind += local.seen == 0;
        for (const Field& field : probe->fields)
          values.push_back(local.seen > 0 ? field.value(local) : nothing);
      };
      if (is_volume(*probe)) {
        const auto inside = sph::gas_inside(*fluid_, {vec(places[0]), vec(places[1])});
        append(values, inside);
        add(inside.mean);
      } else {
        for (std::size_t i = 0; i < places.size(); ++i, ++next) {
          add(*next);
          values.push_back(next->seen);
        }
      }
      tell_blind(*probe, blind, report);
      ProbeProgress& progress = probe->file.progress();
      progress.blind += blind;
      progress.intervals = next_interval(time, probe->interval);
      probe->file.write(time, values);
    }
  }

  /// What a checkpoint keeps.
  std::vector<ProbeProgress> progress() const {
    std::vector<ProbeProgress> all;
    for (const Probe& probe : probes_) all.push_back(probe.file.progress());
    return all;
  }

  /// Names of the files in the folder; of a plane the last picture.
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Probe& probe : probes_)
      for (std::string& name : probe.file.names()) all.push_back(std::move(name));
    return all;
  }

  /// A result for each probe that met places without gas: how many of its values are nan.
  void summarise(Summary& summary) const {
    for (const Probe& probe : probes_)
      if (probe.file.progress().blind > 0)
        summary.results.push_back({"probe_" + probe.file.spec().name + "_without_gas",
                                   static_cast<double>(probe.file.progress().blind), std::nullopt,
                                   "samples"});
  }

 private:
  static std::int64_t next_interval(double time, double interval) {
    return static_cast<std::int64_t>(std::floor(time / interval + 1e-9)) + 1;
  }

  struct Probe {
    ProbeFile file;
    std::vector<Field> fields;
    double interval = 0;  // [s]
  };

  static bool is_volume(const Probe& probe) { return probe.file.spec().kind == "volume"; }

  bool is_due(const Probe& probe, bool last) const {
    const ProbeProgress& done = probe.file.progress();
    const double from = static_cast<double>(done.intervals) * probe.interval;
    const double time = fluid_->time();
    return time >= from - 1e-9 * probe.interval || (last && time > done.sampled);
  }

  static Vec<dim> vec(const std::array<double, 3>& place) {
    Vec<dim> x;
    for (int k = 0; k < dim; ++k) x[k] = place[static_cast<std::size_t>(k)];
    return x;
  }

  std::vector<Field> fields_of(const ProbeSpec& spec) const {
    try {
      return sph::probe_fields(fluid_->scheme(), std::span<const std::string>(spec.fields));
    } catch (const InvalidInput& fault) {
      throw InvalidInput("probe \"" + spec.name + "\": " + fault.what(), fault.id);
    }
  }

  static std::vector<io::CsvWriter::Column> columns(const Probe& probe) {
    std::vector<io::CsvWriter::Column> all;
    if (is_volume(probe)) {
      // Planar gas is per metre of depth, gas on a line per square metre.
      const std::string per = dim == 3 ? "" : dim == 2 ? "/m" : "/m^2";
      const std::string volume = dim == 3 ? "m^3" : dim == 2 ? "m^2" : "m";
      all = {{"particles", "-"}, {"mass", "kg" + per}, {"volume", volume}};
      for (int k = 0; k < dim; ++k)
        all.push_back({std::string("momentum_") + "xyz"[k], "kg m/s" + per});
      all.push_back({"kinetic", "J" + per});
      all.push_back({"internal", "J" + per});
    }
    for (const Field& field : probe.fields) all.push_back({field.name, field.unit});
    if (!is_volume(probe)) all.push_back({"seen", "-"});
    return all;
  }

  static void append(std::vector<double>& row, const sph::GasInside<dim>& inside) {
    row.insert(row.end(), {static_cast<double>(inside.particles), inside.mass, inside.volume});
    for (int k = 0; k < dim; ++k) row.push_back(inside.momentum[k]);
    row.insert(row.end(), {inside.kinetic, inside.internal});
  }

  void tell_blind(const Probe& probe, std::int64_t blind, Report& report) const {
    if (blind == 0) return;
    const std::size_t all = is_volume(probe) ? 1 : probe.file.places().points.size();
    report.warn("probe " + probe.file.spec().name + " without gas",
                "W030 no gas is seen at " + format_count(blind) + " of " +
                    format_count(static_cast<std::int64_t>(all)) +
                    (all == 1 ? " place" : " places") +
                    " at t = " + format_number(fluid_->time(), 4) + " s; the values are nan");
  }

  Fluid* fluid_;
  std::vector<Probe> probes_;
};

/// Stands in for the probes of a structure without gas: there are none.
struct NoProbes {
  bool empty() const { return true; }
  void begin(const std::filesystem::path&, const std::string&, double,
             const std::vector<ProbeProgress>& = {}) {}
  bool due(bool = false) const { return false; }
  void observe(Report&, bool = false) {}
  std::vector<ProbeProgress> progress() const { return {}; }
  std::vector<std::string> names() const { return {}; }
  void summarise(Summary&) const {}
};

/// The probes of a gas, or of the gas that bodies are immersed in.
/// @throws InvalidInput as Probes does, and E052 for probes where there is no gas.
template <class System>
auto probes_of(const std::vector<ProbeSpec>& specs, System& system) {
  if constexpr (requires { system.fluid(); }) {
    return probes_of(specs, system.fluid());
  } else if constexpr (requires { system.particles(); }) {
    return Probes<System>(specs, system);
  } else {
    if (!specs.empty())
      throw InvalidInput("probe \"" + specs.front().name + "\": there is no gas to sample", "E052");
    return NoProbes{};
  }
}

}  // namespace sphmbs::examples
