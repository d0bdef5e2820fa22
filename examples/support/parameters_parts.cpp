// SPDX-License-Identifier: MIT
#include "support/parameters_parts.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "support/parameter_file.hpp"
#include "support/probe_parameters.hpp"
#include "support/suggestion.hpp"

namespace sphmbs::examples {

Parameter& Parameters::Parts::add(Parameter parameter) {
  for (const std::string& option : parameter.options)
    if (find(option)) throw std::invalid_argument("Parameters: " + option + " is taken");
  if (!parameter.key.empty() && find(parameter.key)) {
    throw std::invalid_argument("Parameters: " + parameter.key + " is taken");
  }
  Parameter& added = all.emplace_back(std::move(parameter));
  if (added.show) added.default_text = added.show();
  return added;
}

Parameter* Parameters::Parts::find(std::string_view name) {
  for (Parameter& p : all) {
    const bool is_option = std::find(p.options.begin(), p.options.end(), name) != p.options.end();
    if (is_option || (!name.empty() && p.key == name)) return &p;
  }
  return nullptr;
}

void Parameters::Parts::read_table(const Given::Table& table, const std::string& prefix,
                                   std::vector<Assignment>& assignments, Complaints& complaints) {
  std::vector<std::string> keys, tables;
  for (const Parameter& p : all) {
    if (p.key.empty()) continue;
    keys.push_back(p.key);
    for (std::size_t dot = p.key.find('.'); dot != std::string::npos;
         dot = p.key.find('.', dot + 1))
      tables.push_back(p.key.substr(0, dot));
  }
  if (program.gas) tables.push_back("probes");
  for (const Given::Member& member : table) {
    const std::string key = prefix + member.key;
    const bool plain = member.key.find('.') == std::string::npos;
    const bool is_table = std::holds_alternative<Given::Table>(member.value.value);
    if (Parameter* const p = plain ? find(key) : nullptr; p && p->key == key) {
      assignments.push_back({p, member.value, key});
    } else if (plain && program.gas && key == "probes") {
      settings.probes = read_probes(member.value, program.dim, complaints);
    } else if (plain && std::find(tables.begin(), tables.end(), key) != tables.end()) {
      if (is_table) {
        read_table(std::get<Given::Table>(member.value.value), key + ".", assignments, complaints);
      } else {
        complaints.add(member.value.place, "E024",
                       named(key, member.value.shown()) + "must be a table, [" + key + "]");
      }
    } else {
      const std::string nearest = is_table ? nearest_name(key, tables) : nearest_key(key, keys);
      complaints.add(member.place, is_table ? "E020" : "E021",
                     key + (is_table ? ": unknown table" : ": unknown key") +
                         (nearest.empty() ? "; --list-params shows all"
                                          : "; did you mean \"" + nearest + "\"?"));
    }
  }
}

void Parameters::Parts::read_file(std::string_view text, const std::string& name,
                                  std::vector<Assignment>& assignments, Complaints& complaints) {
  if (const auto root = parse_toml(text, name, complaints)) {
    read_table(std::get<Given::Table>(root->value), "", assignments, complaints);
  }
}

void Parameters::Parts::refuse_both_steps(const std::vector<Assignment>& assignments,
                                          Complaints& complaints) const {
  const auto given = [&](const std::string& key) {
    return std::find_if(assignments.begin(), assignments.end(),
                        [&key](const Assignment& a) { return a.parameter->key == key; });
  };
  const auto step = given("run.step"), variable = given(variable_step());
  if (step == assignments.end() || variable == assignments.end()) return;
  complaints.add(
      step->given.place, "E014",
      named(step->name, step->given.shown()) + "excludes " + variable->name + "; give one of them");
}

void Parameters::Parts::accept(const std::vector<Assignment>& from_file,
                               const std::vector<Assignment>& from_words, Complaints& complaints) {
  refuse_both_steps(from_file, complaints);
  refuse_both_steps(from_words, complaints);
  for (Parameter& p : all) p.origin.reset();
  const auto is_common = [this](const Parameter* p) {
    return std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(common),
                       [p](const Parameter& other) { return &other == p; });
  };
  std::vector<std::function<void()>> stores_of_case;
  for (const auto* assignments : {&from_file, &from_words}) {
    for (const Assignment& a : *assignments) {
      const Parameter::Verdict verdict = a.parameter->judge(a.given);
      if (!verdict.store) {
        complaints.add(a.given.place, verdict.id,
                       named(a.name, a.given.shown()) + "must be " + verdict.must_be);
        continue;
      }
      a.parameter->origin = {a.given.place, a.name};
      if (is_common(a.parameter)) {
        verdict.store();
      } else {
        stores_of_case.push_back(verdict.store);
      }
    }
  }
  check_common(complaints);
  complaints.raise();
  for (const auto& store : stores_of_case) store();
}

}  // namespace sphmbs::examples
