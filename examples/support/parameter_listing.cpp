// SPDX-License-Identifier: MIT
// Parameters as lists for people, and as a parameter file.
#include <algorithm>

#include "support/parameters_parts.hpp"
#include "support/probe_parameters.hpp"
#include "support/text.hpp"

#include "sphmbs/version.hpp"

namespace sphmbs::examples {
namespace {

std::string table_of(const Parameter& p) { return p.key.substr(0, p.key.rfind('.')); }

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

}  // namespace

std::string Parameters::list() const {
  std::vector<std::vector<std::string>> rows{
      {"key", "type", "unit", "default", "range", "option", "meaning"}};
  for (const Parameter& p : parts_->all) {
    if (p.key.empty()) continue;
    rows.push_back({p.key, p.type, or_dash(p.unit), or_dash(p.default_text), or_dash(p.range),
                    p.options.empty() ? "-" : p.options.front(), p.meaning});
  }
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k)
      widths[k] = std::max(widths[k], text_width(row[k]) + 2);
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k + 1 < row.size(); ++k) text += padded(row[k], widths[k]);
    text += row.back() + '\n';
  }
  if (parts_->program.gas) {
    text +=
        "\nEach [[probes]] table samples the gas: name, kind (point, line, plane, volume), at or "
        "from and to [m],\npoints, fields (p, rho, e, v, speed, c, T, mach), interval [s]; see "
        "docs/parameters.md.\n";
  }
  return text;
}

std::string Parameters::dump() const {
  const Program& program = parts_->program;
  std::vector<std::string> tables;
  for (const Parameter& p : parts_->all)
    if (!p.key.empty() && std::find(tables.begin(), tables.end(), table_of(p)) == tables.end()) {
      tables.push_back(table_of(p));
    }
  std::string text =
      "# " + program.name + ": " + program.title + " (sphmbs " + std::string(version) + ")\n";
  for (const std::string& table : tables) {
    text += "\n[" + table + "]\n";
    for (const Parameter& p : parts_->all) {
      if (p.key.empty() || table_of(p) != table) continue;
      const std::string value = p.show();
      const std::string name = p.key.substr(table.size() + 1);
      const std::string line = value.empty() ? "# " + name + " is not set" : name + " = " + value;
      text += padded(line, 32) + "# " + (p.unit.empty() ? "" : "[" + p.unit + "] ") + p.meaning +
              (p.range.empty() ? "" : "; " + p.range) + '\n';
    }
  }
  return text + dump_probes(parts_->settings.probes);
}

}  // namespace sphmbs::examples
