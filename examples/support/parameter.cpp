// SPDX-License-Identifier: MIT
#include "support/parameter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

/// "a positive number of metres", "a number [Pa], at least 1".
std::string allowed_numbers(const Bounds& bounds, const std::string& unit,
                            const std::string& kind) {
  const bool positive = bounds.above == 0.0;
  std::string text = (positive ? "a positive " : "a ") + kind;
  if (unit == "m" || unit == "s") {
    text += unit == "m" ? " of metres" : " of seconds";
  } else if (!unit.empty()) {
    text.append(" [").append(unit).append("]");
  }
  Bounds rest = bounds;
  if (positive) rest.above.reset();
  const std::string limits = rest.text();
  if (limits.empty()) return text;
  return text + (limits.starts_with("from ") ? " " : ", ") + limits;
}

Parameter described(About about, std::string type) {
  Parameter p;
  p.key = std::move(about.key);
  p.meaning = std::move(about.meaning);
  p.options = std::move(about.options);
  p.type = std::move(type);
  return p;
}

Parameter::Verdict wrong_type(const std::string& allowed) {
  return {.store = {}, .id = "E024", .must_be = allowed};
}

/// Why a number of the right type is refused, or nothing.
std::optional<Parameter::Verdict> outside(const Bounds& bounds, double value,
                                          const std::string& allowed, const std::string& meaning) {
  if (!std::isfinite(value)) {
    return Parameter::Verdict{.store = {}, .id = "E025", .must_be = allowed + ", finite"};
  }
  if (bounds.contain(value)) return std::nullopt;
  std::string must_be = allowed;
  for (const char* prefix : {"a number, ", "a number "})
    if (must_be.starts_with(prefix)) must_be = must_be.substr(std::string_view(prefix).size());
  return Parameter::Verdict{.store = {}, .id = "E022", .must_be = must_be + " (" + meaning + ")"};
}

std::string format(double value) { return format_exact(value); }
std::string format(std::int64_t value) { return std::to_string(value); }

template <class Number, class Read>
Parameter numeric(Parameter p, const Bounds& bounds, const Read& read,
                  std::function<std::optional<Number>()> show, std::function<void(Number)> store) {
  p.range = bounds.text();
  p.judge = [=, allowed = p.allowed, meaning = p.meaning](const Given& given) {
    const auto number = read(given);
    if (!number) return wrong_type(allowed);
    if (auto fault = outside(bounds, static_cast<double>(*number), allowed, meaning)) return *fault;
    return Parameter::Verdict{.store = [=] { store(*number); }};
  };
  p.show = [show = std::move(show)] {
    const auto number = show();
    return number ? format(*number) : std::string();
  };
  return p;
}

std::string placeholder_of(const std::string& unit) {
  return unit.empty() ? "NUMBER" : "NUMBER [" + unit + "]";
}

}  // namespace

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

bool Bounds::contain(double value) const {
  return std::isfinite(value) && (!above || value > *above) && (!at_least || value >= *at_least) &&
         (!below || value < *below) && (!at_most || value <= *at_most);
}

std::string Bounds::text() const {
  if (at_least && at_most) {
    return "from " + format_exact(*at_least) + " to " + format_exact(*at_most);
  }
  std::vector<std::string> limits;
  if (above) limits.push_back("above " + format_exact(*above));
  if (at_least) limits.push_back("at least " + format_exact(*at_least));
  if (below) limits.push_back("below " + format_exact(*below));
  if (at_most) limits.push_back("at most " + format_exact(*at_most));
  return joined(limits, " and ");
}

Parameter number_parameter(About about, const Bounds& bounds, const std::string& unit,
                           std::function<std::optional<double>()> show,
                           std::function<void(double)> store) {
  Parameter p = described(std::move(about), "number");
  p.unit = unit;
  p.placeholder = placeholder_of(unit);
  p.allowed = allowed_numbers(bounds, unit, "number");
  return numeric<double>(std::move(p), bounds, as_number, std::move(show), std::move(store));
}

Parameter duration_parameter(About about, const Bounds& bounds,
                             std::function<std::optional<double>()> show,
                             std::function<void(double)> store) {
  Parameter p = described(std::move(about), "duration");
  p.unit = "s";
  p.placeholder = "TIME";
  p.allowed = allowed_numbers(bounds, "s", "number") + ", or a text such as 1h30m";
  return numeric<double>(std::move(p), bounds, as_duration, std::move(show), std::move(store));
}

Parameter whole_parameter(About about, const Bounds& bounds, const std::string& unit,
                          std::function<std::optional<std::int64_t>()> show,
                          std::function<void(std::int64_t)> store) {
  Parameter p = described(std::move(about), "whole number");
  p.unit = unit;
  p.placeholder = placeholder_of(unit);
  p.allowed = allowed_numbers(bounds, unit, "whole number");
  return numeric<std::int64_t>(std::move(p), bounds, as_whole_number, std::move(show),
                               std::move(store));
}

Parameter choice_parameter(About about, std::string& value, std::vector<std::string> choices,
                           const std::string& allowed) {
  Parameter p = described(std::move(about), "choice");
  p.placeholder = "NAME";
  p.allowed = allowed;
  p.range = joined(choices, ", ");
  p.judge = [&value, allowed, choices = std::move(choices)](const Given& given) {
    const auto text = as_text(given);
    if (!text) return wrong_type(allowed);
    if (std::find(choices.begin(), choices.end(), *text) == choices.end()) {
      return Parameter::Verdict{.store = {}, .id = "E022", .must_be = allowed};
    }
    return Parameter::Verdict{.store = [&value, text] { value = *text; }};
  };
  p.show = [&value] { return quoted(value); };
  return p;
}

Parameter flag_parameter(About about, bool& value, bool implied) {
  Parameter p = described(std::move(about), "flag");
  p.allowed = "true or false";
  p.range = "true, false";
  p.implied = implied;
  p.judge = [&value, allowed = p.allowed](const Given& given) {
    const auto flag = as_flag(given);
    if (!flag) return wrong_type(allowed);
    return Parameter::Verdict{.store = [&value, flag] { value = *flag; }};
  };
  p.show = [&value] { return std::string(value ? "true" : "false"); };
  return p;
}

Parameter vector_parameter(About about, std::span<double> value, const Bounds& bounds,
                           const std::string& unit) {
  const std::string count = std::to_string(value.size());
  Parameter p = described(std::move(about), count + " numbers");
  p.unit = unit;
  p.placeholder = "LIST" + (unit.empty() ? "" : " [" + unit + "]");
  const std::string limits = bounds.text();
  p.range = limits.empty() ? "" : "each " + limits;
  p.allowed = "a list of " + count + (value.size() == 1 ? " number" : " numbers") +
              (unit.empty() ? "" : " [" + unit + "]") + (limits.empty() ? "" : ", " + p.range);
  p.judge = [=, allowed = p.allowed, meaning = p.meaning](const Given& given) {
    const auto numbers = as_numbers(given);
    if (!numbers || numbers->size() != value.size()) return wrong_type(allowed);
    for (const double number : *numbers)
      if (auto fault = outside(bounds, number, allowed, meaning)) return *fault;
    return Parameter::Verdict{
        .store = [=] { std::copy(numbers->begin(), numbers->end(), value.begin()); }};
  };
  p.show = [value] {
    std::vector<std::string> numbers;
    for (const double number : value) numbers.push_back(format_exact(number));
    return "[" + joined(numbers, ", ") + "]";
  };
  return p;
}

Parameter text_parameter(About about, const std::string& placeholder, const std::string& allowed,
                         std::function<std::string()> show,
                         std::function<void(const std::string&)> store) {
  Parameter p = described(std::move(about), "text");
  p.placeholder = placeholder;
  p.allowed = allowed;
  p.judge = [allowed, store = std::move(store)](const Given& given) {
    const auto text = as_text(given);
    if (!text) return wrong_type(allowed);
    return Parameter::Verdict{.store = [=] { store(*text); }};
  };
  p.show = [show = std::move(show)] { return quoted(show()); };
  return p;
}

}  // namespace sphmbs::examples
