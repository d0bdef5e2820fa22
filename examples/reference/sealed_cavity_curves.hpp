// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include <sphmbs/boundary/motion.hpp>

#include "reference/sealed_cavity.hpp"
#include "support/gas_session.hpp"

namespace sphmbs::examples {

/// Isentropic energy increase of the cavity's gas at side length l, per metre of depth [J/m]: p0 =
/// 1e4 Pa and 1 m^2 at first. The walls are so slow, Mach 0.005, that it holds to 1e-4.
inline double isentropic_increase(double l) { return 25000 * (std::pow(1 / (l * l), 0.4) - 1); }

/// Energies over time: the work of the walls on the gas (`work`), that of the force which drives
/// the walls, their own compression included (`work_driving`), and the increase of the energy of
/// gas and of virtual particles. work_driving = energy_gas + energy_virtual up to the integrator;
/// work exceeds energy_gas by the heat that the paper's virtual particles, which lag behind the
/// gas, take from it, or, with walls of known surface, by the work on the layers' own contraction;
/// for these work_driving is what passes to the gas at the surface.
template <class Fluid>
void record_energies(Session<Fluid>& session, Fluid& fluid) {
  const auto start = fluid.totals();
  session.record("work", "J/m", [&fluid] { return fluid.exchange().wall_work(); });
  session.record("work_driving", "J/m", [&fluid] { return fluid.exchange().driving_work(); });
  session.record("energy_gas", "J/m",
                 [&fluid, start] { return fluid.totals().energy() - start.energy(); });
  session.record("energy_virtual", "J/m", [&fluid, start] {
    return fluid.totals().virtual_internal - start.virtual_internal;
  });
  session.record("rho_mean", "kg/m3", [&fluid] {
    const auto now = fluid.totals();
    return now.mass / now.volume;
  });
}

/// Results and pictures of sealed_cavity against the exact values and the paper's.
template <class Fluid>
void compare_with_reference(Session<Fluid>& session, const boundary::Contraction& walls) {
  const History& history = session.history();
  Curve paper_work{.label = "paper, work"}, paper_energy{.label = "paper, energy"};
  for (const CavityReference& row : cavity_paper) {
    if (row.t > session.settings().until + 1e-9) continue;
    const std::string at = "_" + format_exact(row.t) + "s";
    const double l = walls.length_at(row.t);
    session.result("energy_gas" + at, history.at("energy_gas", row.t), isentropic_increase(l),
                   "J/m");
    session.result("work" + at, history.at("work", row.t), isentropic_increase(l), "J/m");
    session.result("work_driving" + at, history.at("work_driving", row.t),
                   history.at("energy_gas", row.t) + history.at("energy_virtual", row.t), "J/m");
    session.result("rho" + at, history.at("rho_mean", row.t), 1.293 / (l * l), "kg/m3");
    paper_work.x.push_back(row.t);
    paper_work.y.push_back(row.work / isentropic_increase(l) - 1);
    paper_energy.x.push_back(row.t);
    paper_energy.y.push_back(row.energy / isentropic_increase(l) - 1);
  }
  Curve exact{.label = "isentropic", .x = history.time()};
  Curve density{.label = "exact", .x = history.time()};
  Curve work{.label = "work"}, energy{.label = "energy of the gas"};
  for (const double t : history.time()) {
    const double l = walls.length_at(t);
    exact.y.push_back(isentropic_increase(l));
    density.y.push_back(1.293 / (l * l));
    if (t < 0.05) continue;
    work.x.push_back(t);
    work.y.push_back(history.at("work", t) / isentropic_increase(l) - 1);
    energy.x.push_back(t);
    energy.y.push_back(history.at("energy_gas", t) / isentropic_increase(l) - 1);
  }
  exact.reference = density.reference = true;
  for (Curve* paper : {&paper_work, &paper_energy})
    paper->style = {.line = Line::none, .marker = Marker::circle};
  std::vector<Panel> panels(3);
  panels[0] = {.title = "energy",
               .x_label = "t [s]",
               .y_label = "[J/m]",
               .curves = {history.curve("energy_gas", "energy of the gas"),
                          history.curve("work", "work of the walls"), exact}};
  panels[1] = {.title = "mean density",
               .x_label = "t [s]",
               .y_label = "density [kg/m³]",
               .curves = {history.curve("rho_mean", "sphmbs"), density}};
  panels[2] = {.title = "against the isentropic value",
               .x_label = "t [s]",
               .y_label = "relative difference",
               .curves = {energy, work, paper_energy, paper_work}};
  session.curves("history",
                 "sealed_cavity, spacing " + format_exact(session.settings().spacing) + " m",
                 panels, 3);
}

}  // namespace sphmbs::examples
