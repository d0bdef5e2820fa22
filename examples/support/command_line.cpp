// SPDX-License-Identifier: MIT
#include "support/command_line.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "support/suggestion.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

const std::vector<std::string> questions{"--help", "--version", "--list-params", "--set"};

// CLI11 stops at the first mistake, so that it writes the page of --help only, and the words are
// read here.
class Reader {
 public:
  Reader(std::vector<std::string> words, std::deque<Parameter>& parameters, Complaints& complaints)
      : words_(std::move(words)), parameters_(parameters), complaints_(complaints) {}

  Words read() {
    while (next_ < words_.size()) {
      const std::string word = words_[next_++];
      if (word.size() > 1 && word.starts_with('-')) {
        read_option(word);
      } else if (found_.file) {
        complain("E010", word + ": is not an option, and a parameter file was named before: " +
                             *found_.file);
      } else {
        found_.file = word;
      }
    }
    return std::move(found_);
  }

 private:
  void complain(std::string_view id, const std::string& text) {
    complaints_.add({"command line"}, id, text);
  }

  Parameter* with_option(std::string_view name) {
    const auto it = std::find_if(parameters_.begin(), parameters_.end(), [name](const auto& p) {
      return std::find(p.options.begin(), p.options.end(), name) != p.options.end();
    });
    return it == parameters_.end() ? nullptr : &*it;
  }

  /// Whether the next word can be a value: neither empty nor an option.
  bool value_follows() {
    if (next_ == words_.size() || words_[next_].empty()) return false;
    const std::string& word = words_[next_];
    return !word.starts_with("--") && with_option(word) == nullptr;
  }

  void read_option(const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    std::optional<std::string> value;
    if (equals != std::string::npos) value = word.substr(equals + 1);
    if (name == "--set") return read_set(take(value));
    Parameter* const p = with_option(name);
    if (p == nullptr) return refuse_unknown(name, value.has_value());
    const Place place{"command line"};
    if (p->placeholder.empty()) {
      if (value) return complain("E012", name + ": takes no value");
      return assign(*p, {p->implied, place}, name);
    }
    if (p->may_lack_value && !value && (!value_follows() || words_[next_].ends_with(".toml"))) {
      return assign(*p, {std::string(), place}, name);
    }
    value = take(value);
    if (!value) {
      return complain("E011", name + ": needs a value; it must be " + p->allowed);
    }
    assign(*p, {Given::Word{*value}, place}, name);
  }

  /// The value after "=", or else the next word; nothing where there is none.
  std::optional<std::string> take(std::optional<std::string> value) {
    if (value) return value->empty() ? std::nullopt : value;
    if (value_follows()) return words_[next_++];
    if (next_ < words_.size() && words_[next_].empty()) ++next_;
    return std::nullopt;
  }

  void read_set(const std::optional<std::string>& text) {
    const std::size_t equals = text ? text->find('=') : std::string::npos;
    if (equals == std::string::npos) {
      return complain("E011", "--set" + (text ? " " + *text : "") +
                                  ": needs a key and a value: --set run.until=0.1");
    }
    const std::string key = text->substr(0, equals);
    const auto it = std::find_if(parameters_.begin(), parameters_.end(),
                                 [&key](const auto& p) { return !p.key.empty() && p.key == key; });
    if (it != parameters_.end()) {
      return assign(*it, {Given::Word{text->substr(equals + 1)}, {"command line"}}, key);
    }
    std::vector<std::string> keys;
    for (const Parameter& p : parameters_)
      if (!p.key.empty()) keys.push_back(p.key);
    const std::string nearest = nearest_key(key, keys);
    complain("E021", key + (nearest.empty() ? ": unknown key; --list-params shows all"
                                            : ": unknown key; did you mean \"" + nearest + "\"?"));
  }

  void assign(Parameter& p, Given given, const std::string& name) {
    for (const Assignment& other : found_.assignments) {
      if (other.parameter != &p) continue;
      return complain("E013", name + (name == other.name ? ": is given more than once"
                                                         : ": is given by " + other.name + " too"));
    }
    found_.assignments.push_back({&p, std::move(given), name});
  }

  void refuse_unknown(const std::string& name, bool has_value) {
    std::vector<std::string> names = questions;
    for (const Parameter& p : parameters_)
      names.insert(names.end(), p.options.begin(), p.options.end());
    std::erase_if(names, [](const std::string& option) { return !option.starts_with("--"); });
    const std::string nearest = name == "--" ? "" : nearest_name(name, names);
    complain("E010",
             name + (nearest.empty() ? ": is not an option; --help lists all"
                                     : ": is not an option; did you mean " + nearest + "?"));
    // What follows is likely its value.
    if (!has_value && value_follows() && !words_[next_].ends_with(".toml")) ++next_;
  }

  std::vector<std::string> words_;
  std::deque<Parameter>& parameters_;
  Complaints& complaints_;
  Words found_{};
  std::size_t next_ = 0;
};

}  // namespace

Words read_words(int argc, const char* const* argv, std::deque<Parameter>& parameters,
                 Complaints& complaints) {
  return Reader({argv + std::min(argc, 1), argv + argc}, parameters, complaints).read();
}

std::string named(const std::string& name, const std::string& value) {
  if (value.empty()) return name + ": ";
  return name + (name.starts_with('-') ? " " : " = ") + value + ": ";
}

std::string help_page(const Program& program, const std::deque<Parameter>& parameters,
                      std::size_t common) {
  CLI::App app(program.name + ": " + program.title, program.name);
  const std::string everywhere = "Options of every case";
  std::string unused;
  app.add_option("FILE", unused, "parameter file, see --list-params; options win over it")
      ->option_text("[FILE.toml]");
  app.set_help_flag("-h,--help", "show this help and exit")->group(everywhere);
  const auto add_question = [&](const std::string& name, const std::string& meaning) {
    app.add_flag(name, meaning)->group(everywhere);
  };
  add_question("--version", "show versions, compiler and flags, and exit");
  add_question("--list-params",
               "show key, type, unit, default, range and meaning of all parameters");
  app.add_option("--set", unused, "set any parameter by its key, repeatable")
      ->option_text("KEY=VALUE")
      ->group(everywhere);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    if (p.options.empty()) continue;
    const std::string group = i < common ? everywhere : "Options of this case";
    const std::string names = joined(p.options, ",");
    if (p.placeholder.empty()) {
      app.add_flag(names, p.meaning)->group(group);
      continue;
    }
    const std::string text = p.default_text.starts_with('"')
                                 ? p.default_text.substr(1, p.default_text.size() - 2)
                                 : p.default_text;
    app.add_option(names, unused,
                   p.meaning + ": " + p.allowed + (text.empty() ? "" : " (default " + text + ")"))
        ->option_text(p.placeholder)
        ->group(group);
  }
  std::string footer = "Examples:\n";
  for (const UsageExample& example : program.usage_examples)
    footer += "  " + padded(program.name + " " + example.options, 52) + example.meaning + '\n';
  footer +=
      "\nExit codes: 0 done, 1 internal error, 2 bad input, 3 numerical failure, 4 refused\n"
      "checkpoint, 5 output failed, 6 out of memory, 130 and 143 stopped by a signal.\n";
  app.footer(footer);
  app.get_formatter()->column_width(28);
  return app.help();
}

}  // namespace sphmbs::examples
