// SPDX-License-Identifier: MIT
#include "support/given.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <type_traits>

#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

/// Reads the whole text as a number, whatever the locale. An overflow counts as infinite.
template <class Number>
std::optional<Number> read(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    if constexpr (std::numeric_limits<Number>::has_infinity) {
      return std::numeric_limits<Number>::infinity();
    }
    return std::nullopt;
  }
  return value;
}

const std::string* word_of(const Given& given) {
  const auto* word = std::get_if<Given::Word>(&given.value);
  return word ? &word->text : nullptr;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// "a", "b" in "[a, b]" or "a,b".
std::vector<std::string_view> parts_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  std::vector<std::string_view> parts;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
  return parts;
}

std::optional<double> read_duration(std::string_view text) {
  if (const auto seconds = read<double>(text)) return seconds;
  double sum = 0;
  while (!text.empty()) {
    const std::size_t end = text.find_first_not_of("0123456789.");
    if (end == std::string_view::npos) return std::nullopt;
    const auto count = read<double>(text.substr(0, end));
    const double unit = text[end] == 'd'   ? 86400
                        : text[end] == 'h' ? 3600
                        : text[end] == 'm' ? 60
                        : text[end] == 's' ? 1
                                           : 0;
    if (!count || unit == 0) return std::nullopt;
    sum += *count * unit;
    text.remove_prefix(end + 1);
  }
  return sum;
}

constexpr std::size_t longest_shown = 60;

}  // namespace

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result.append("\\").append(1, c);
    } else if (code < 0x20 || code == 0x7f) {
      constexpr std::string_view digits = "0123456789ABCDEF";
      result.append("\\u00").append(1, digits[code / 16]).append(1, digits[code % 16]);
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string Given::shown() const {
  const auto show = [](const auto& data) -> std::string {
    using T = std::decay_t<decltype(data)>;
    if constexpr (std::is_same_v<T, Word>) {
      return data.text;
    } else if constexpr (std::is_same_v<T, bool>) {
      return data ? "true" : "false";
    } else if constexpr (std::is_same_v<T, double>) {
      return format_exact(data);
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      return std::to_string(data);
    } else if constexpr (std::is_same_v<T, std::string>) {
      return quoted(data);
    } else if constexpr (std::is_same_v<T, List>) {
      std::string text;
      for (const Given& item : data) {
        if (text.size() > longest_shown) break;
        text += (text.empty() ? "" : ", ") + item.shown();
      }
      return "[" + text + "]";
    } else if constexpr (std::is_same_v<T, Table>) {
      return "{...}";
    } else {
      return "(date or time)";
    }
  };
  std::string text = std::visit(show, value);
  if (text.size() <= longest_shown) return text;
  std::size_t end = longest_shown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::optional<double> as_number(const Given& given) {
  if (const std::string* word = word_of(given)) return read<double>(*word);
  if (const auto* number = std::get_if<double>(&given.value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&given.value)) {
    return static_cast<double>(*whole);
  }
  return std::nullopt;
}

std::optional<std::int64_t> as_whole_number(const Given& given) {
  if (const std::string* word = word_of(given)) return read<std::int64_t>(*word);
  if (const auto* whole = std::get_if<std::int64_t>(&given.value)) return *whole;
  return std::nullopt;
}

std::optional<bool> as_flag(const Given& given) {
  if (const std::string* word = word_of(given)) {
    if (*word == "true") return true;
    if (*word == "false") return false;
  }
  if (const auto* flag = std::get_if<bool>(&given.value)) return *flag;
  return std::nullopt;
}

std::optional<std::string> as_text(const Given& given) {
  if (const std::string* word = word_of(given)) {
    const bool in_quotes = word->size() > 1 && word->starts_with('"') && word->ends_with('"');
    return in_quotes ? word->substr(1, word->size() - 2) : *word;
  }
  if (const auto* text = std::get_if<std::string>(&given.value)) return *text;
  return std::nullopt;
}

std::optional<std::vector<double>> as_numbers(const Given& given) {
  std::vector<double> numbers;
  const auto add = [&numbers](std::optional<double> number) {
    if (number) numbers.push_back(*number);
    return number.has_value();
  };
  if (const std::string* word = word_of(given)) {
    for (const std::string_view part : parts_of(*word))
      if (!add(read<double>(part))) return std::nullopt;
    return numbers;
  }
  const auto* list = std::get_if<Given::List>(&given.value);
  if (!list) return std::nullopt;
  for (const Given& item : *list)
    if (!add(as_number(item))) return std::nullopt;
  return numbers;
}

std::optional<double> as_duration(const Given& given) {
  if (const auto number = as_number(given)) return number;
  const auto text = as_text(given);
  return text ? read_duration(*text) : std::nullopt;
}

}  // namespace sphmbs::examples
