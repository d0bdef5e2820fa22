// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/io/structure_mesh.hpp>
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/joints/reaction.hpp>

#include "support/backends.hpp"
#include "support/integrators.hpp"
#include "support/session.hpp"

namespace sphmbs::examples {

/// Parts of a structure, drawn, at a time [s].
struct Frame {
  double time = 0;
  io::Mesh mesh{};

  template <Archive A>
  void visit_state(A& archive) {
    archive("time", time);
    archive("mesh", mesh);
  }
};

/// What a session shows of a structure in motion: energies, its parts drawn curved, what the
/// integrator did.
template <class Structure, class Solver, class Policy>
class Display<mbs::Dynamics<Structure, Solver, Policy>> {
 public:
  using System = mbs::Dynamics<Structure, Solver, Policy>;
  static constexpr std::string_view collection = "bodies";

  explicit Display(System& system) : system_(system), start_(system.energies()) {}

  std::vector<io::CsvWriter::Column> columns() const {
    return {{"kinetic", "J"},    {"strain", "J"}, {"potential", "J"}, {"springs", "J"},
            {"dissipated", "J"}, {"work", "J"},   {"total", "J"}};
  }
  void sample(std::vector<double>& row) {
    const mbs::Energies e = system_.energies();
    row.insert(row.end(),
               {e.kinetic, e.strain, e.potential, e.springs, e.dissipated, e.work, e.total()});
    largest_kinetic_ = std::max(largest_kinetic_, e.kinetic);
  }

  void prepare() {}

  std::vector<BannerLine> banner(const Settings& settings) {
    std::vector<BannerLine> lines{parts()};
    for (const std::string& note : system_.start().notes) lines.push_back({"start", note, ""});
    lines.push_back({"run", "until " + format_exact(settings.until) + " s", threads_of(settings)});
    const std::string step = settings.step
                                 ? "fixed at " + format_number(*settings.step, 6) + " s"
                                 : "for an accuracy of " + format_exact(*settings.accuracy) + " m";
    lines.push_back(
        {"step", step,
         "generalized-alpha, spectral radius " + format_exact(settings.spectral_radius)});
    return lines;
  }

  /// What there is.
  BannerLine parts() {
    const auto& equations = system_.equations();
    return {"structure", parts_text(),
            format_count(equations.coordinates()) + " coordinates, " +
                format_count(equations.conditions()) + " conditions"};
  }

  void heed(const Settings&, Report&) const {}

  void progress(Progress& state) const {
    const mbs::DynamicsStatistics done = system_.statistics();
    state.step = done.steps;
    state.iterations = done.iterations;
  }

  std::vector<std::string> write(const std::filesystem::path& folder, const std::string&,
                                 const std::string& number, bool) {
    const std::string name = std::string(collection) + "_" + number + ".vtp";
    frames_.push_back({system_.time(), io::structure_mesh(system_.structure(), system_.state())});
    io::write_vtp(folder / name, frames_.back().mesh, system_.time());
    return {name};
  }

  std::vector<Phase> phases() const { return {}; }

  void summarise(Summary& s) {
    const mbs::DynamicsStatistics done = system_.statistics();
    auto& equations = system_.equations();
    equations.evaluate(system_.state());
    const mbs::VectorXd phi = equations.conditions_residual();
    s.structure = StructureCounts{
        .coordinates = equations.coordinates(),
        .conditions = equations.conditions(),
        .redundant = static_cast<std::int64_t>(system_.start().redundant.size()),
        .iterations = done.iterations,
        .factorisations = done.factorisations,
        .halvings = done.halvings,
        .rejected = done.rejected,
        .violation = phi.size() > 0 ? phi.cwiseAbs().maxCoeff() / system_.size() : 0};
    s.steps = done.steps;
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    s.conservation = {.mass = nothing,
                      .momentum = nothing,
                      .energy = (system_.energies().total() - start_.total()) / largest_kinetic_};
  }

  template <Archive A>
  void visit_state(A& archive) {
    archive("largest_kinetic", largest_kinetic_);
    archive("frames", frames_);
  }

  /// All that was written, for pictures.
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  // "24 cables, 2 bars, 3 joints".
  std::string parts_text() const {
    std::string text;
    int joints = 0, forces = 0;
    const auto add = [&text](std::size_t count, const std::string& what) {
      if (count == 0) return;
      text += (text.empty() ? "" : ", ") + format_count(static_cast<std::int64_t>(count)) + " ";
      const bool y = count > 1 && what.ends_with('y');
      text += y ? what.substr(0, what.size() - 1) + "ies" : what + (count > 1 ? "s" : "");
    };
    system_.structure().for_each_type([&]<class T>(const auto& components) {
      if constexpr (mbs::Part<T>)
        add(components.size(), std::string(T::label));
      else if constexpr (mbs::Constraint<T>)
        joints += static_cast<int>(components.size());
      else
        forces += static_cast<int>(components.size());
    });
    add(static_cast<std::size_t>(joints), "joint");
    add(static_cast<std::size_t>(forces), "force");
    return text;
  }

  System& system_;
  mbs::Energies start_;
  double largest_kinetic_ = 0;
  std::vector<Frame> frames_;
};

/// Coordinates of a point along the axes that are named, in trajectories.csv: columns <name>_x ...
template <class System, int Dim>
void trace_point(Session<System>& session, const std::string& name, const mbs::Marker<Dim>& point,
                 std::string_view axes) {
  for (const char axis : axes)
    session.trace(name + "_" + axis, "m", [&system = session.system(), point, k = axis - 'x'] {
      return point.at(system.state().q)[k];
    });
}

/// The same of its velocity: columns <name>_vx ...
template <class System, int Dim>
void trace_velocity(Session<System>& session, const std::string& name,
                    const mbs::Marker<Dim>& point, std::string_view axes) {
  for (const char axis : axes)
    session.trace(name + "_v" + axis, "m/s", [&system = session.system(), point, k = axis - 'x'] {
      return point.rate(system.state().v)[k];
    });
}

/// Records the force of a joint on its first part, or of a sliding joint on its slider, in
/// history.csv: columns <name>_x ...
/// @param number  what Structure::add returned for the joint
template <class Joint, class System>
void record_reaction(Session<System>& session, int number, const std::string& name) {
  for (int k = 0; k < System::dim; ++k)
    session.record(name + "_" + "xyz"[k], "N", [&system = session.system(), number, k] {
      const Joint& joint =
          system.structure().template all<Joint>()[static_cast<std::size_t>(number)];
      const mbs::VectorXd lambda = system.template multipliers<Joint>(number);
      if constexpr (requires { reaction(joint, system.state().q, 0.0, lambda); })
        return reaction(joint, system.state().q, system.time(), lambda).force[k];
      else
        return -lambda[k];
    });
}

}  // namespace sphmbs::examples
