// SPDX-License-Identifier: MIT
#include "support/parameters.hpp"

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "support/build_info.hpp"
#include "support/output_folder.hpp"
#include "support/parameter_file.hpp"
#include "support/parameters_parts.hpp"
#include "support/probe_parameters.hpp"
#include "support/suggestion.hpp"
#include "support/text.hpp"

#include "sphmbs/version.hpp"

namespace sphmbs::examples {
namespace {

About about(const std::string& key, const std::string& meaning, const std::string& option) {
  return {key, meaning, option.empty() ? std::vector<std::string>{} : std::vector{option}};
}

}  // namespace

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

Parameters::Parameters(Program program) : parts_(std::make_unique<Parts>()) {
  parts_->program = std::move(program);
  parts_->add_common();
}

Parameters::~Parameters() = default;
Parameters::Parameters(Parameters&&) noexcept = default;
Parameters& Parameters::operator=(Parameters&&) noexcept = default;

void Parameters::add_number(const std::string& key, double& value, const Bounds& bounds,
                            const std::string& unit, const std::string& meaning,
                            const std::string& option) {
  parts_->add(number_parameter(
      about(key, meaning, option), bounds, unit, [&value] { return value; },
      [&value](double x) { value = x; }));
}

void Parameters::add_whole_number(const std::string& key, int& value, const Bounds& bounds,
                                  const std::string& unit, const std::string& meaning,
                                  const std::string& option) {
  parts_->add(whole_parameter(
      about(key, meaning, option), bounds, unit, [&value] { return value; },
      [&value](std::int64_t n) { value = static_cast<int>(n); }));
}

void Parameters::add_choice(const std::string& key, std::string& value,
                            const std::vector<std::string>& choices, const std::string& meaning,
                            const std::string& option) {
  parts_->add(choice_parameter(about(key, meaning, option), value, choices,
                               "one of " + joined(choices, ", ")));
}

void Parameters::add_flag(const std::string& key, bool& value, const std::string& meaning,
                          const std::string& option) {
  parts_->add(flag_parameter(about(key, meaning, option), value, true));
}

void Parameters::add_vector(const std::string& key, std::span<double> value, const Bounds& bounds,
                            const std::string& unit, const std::string& meaning,
                            const std::string& option) {
  parts_->add(vector_parameter(about(key, meaning, option), value, bounds, unit));
}

std::optional<Settings> Parameters::parse(int argc, const char* const* argv, std::ostream& out) {
  for (int i = 1; i < argc; ++i) {
    const auto asks = [word = std::string(argv[i])](const char* name) {
      return answers(word, name);
    };
    if (asks("--help")) out << help();
    if (asks("--version")) out << version_line() << '\n';
    if (asks("--list-params")) out << list();
    if (asks("--help") || asks("--version") || asks("--list-params")) return std::nullopt;
  }
  Parts& parts = *parts_;
  parts.settings = parts.program.defaults;
  parts.dump = false;
  Complaints complaints;
  const Words words = read_words(argc, argv, parts.all, complaints);
  std::vector<Assignment> from_file;
  if (words.file) {
    if (const auto text = read_parameter_file(*words.file, complaints)) {
      parts.read_file(*text, *words.file, from_file, complaints);
    }
  }
  parts.accept(from_file, words.assignments, complaints);
  if (parts.dump) {
    out << dump();
    return std::nullopt;
  }
  Settings accepted = parts.settings;
  accepted.used = dump();
  accepted.lock = std::make_shared<OutputLock>();
  return accepted;
}

Settings Parameters::parse_text(std::string_view text, const std::string& name) {
  parts_->settings = parts_->program.defaults;
  Complaints complaints;
  std::vector<Assignment> from_file;
  parts_->read_file(text, name, from_file, complaints);
  parts_->accept(from_file, {}, complaints);
  return parts_->settings;
}

std::string Parameters::help() const {
  return help_page(parts_->program, parts_->all, parts_->common);
}

std::string Parameters::version_line() const {
  const Program& program = parts_->program;
  return program.name + " (sphmbs " + std::string(version) + ") | " + build_info() +
         " | back ends " + joined(program.backends, ", ");
}

std::string Parameters::memory_advice() const {
  return parts_->program.gas ? "a larger --spacing means fewer particles"
                             : "fewer elements need less of it";
}

BadParameters Parameters::located(const RefusedValue& refused) const {
  const Parameter* const p = parts_->find(refused.name);
  std::string name = refused.name;
  Place place{"default"};
  if (p && p->origin) {
    place = p->origin->place;
    name = p->origin->name;
  } else if (p && !p->key.empty()) {
    name = p->key;
  }
  Complaints complaints;
  complaints.add(place, refused.id, named(name, refused.value) + refused.why);
  try {
    complaints.raise();
  } catch (const BadParameters& error) {
    return error;
  }
  throw std::logic_error("a complaint that is none");
}

}  // namespace sphmbs::examples
