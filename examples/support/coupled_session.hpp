// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/coupling/immersed.hpp>

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

  void prepare() { system_.evaluate(); }

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
                                 const std::string& number) {
    std::vector<std::string> names = gas_.write(folder, title, number);
    for (std::string& name : bodies_.write(folder, title, number)) names.push_back(std::move(name));
    return names;
  }

  std::vector<Phase> phases() const { return gas_.phases(); }

  /// Conservation is the gas's, whose accounts have what the bodies do.
  void summarise(Summary& s) {
    bodies_.summarise(s);
    gas_.summarise(s);
  }

  const std::vector<Frame>& frames() const { return bodies_.frames(); }

 private:
  System& system_;
  std::size_t noticed_ = 0;  // incidents
  Display<Fluid> gas_;
  Display<Bodies> bodies_;
};

/// Result for what the power of the gas on the bodies differs by from what they get.
template <class System>
void report_interface(Session<System>& session) {
  const auto& passed = session.system().exchanged();
  session.result("work_lost_between_gas_and_bodies", (passed.work_of_gas - passed.work_on_bodies),
                 std::nullopt, "J");
}

}  // namespace sphmbs::examples
