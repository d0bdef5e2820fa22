// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/given.hpp"

namespace sphmbs::examples {

/// Limits of a number. Whatever they are, NaN and infinity are refused.
struct Bounds {
  std::optional<double> above{};
  std::optional<double> at_least{};
  std::optional<double> below{};
  std::optional<double> at_most{};

  bool contain(double value) const;
  /// "above 1 and at most 2"; empty without limits.
  std::string text() const;
};

/// One thing that the user of a program chooses.
struct Parameter {
  /// What becomes of a value: what to do once all values are accepted, or why it is refused.
  struct Verdict {
    std::function<void()> store{};
    std::string_view id{};
    std::string must_be{};
  };
  /// Where and how the present value was given; nothing for a default.
  struct Origin {
    Place place;
    std::string name;  // key, or option as it was typed
  };

  /// Dotted, for example "gas.gamma"; empty for what parameter files cannot choose.
  std::string key{};
  /// With their dashes; messages and --help put the first one in front.
  std::vector<std::string> options{};
  std::string type{};
  std::string unit{};
  /// Limits or choices, for lists.
  std::string range{};
  /// Completes "must be ...".
  std::string allowed{};
  /// One line.
  std::string meaning{};
  /// Of the option's value in --help; empty where the option takes none.
  std::string placeholder{};
  /// What the option without a value chooses, of a flag.
  bool implied = true;
  /// The value may be left out.
  bool may_lack_value = false;
  std::function<Verdict(const Given&)> judge{};
  /// The present value as in a parameter file; empty when there is none.
  std::function<std::string()> show{};
  std::string default_text{};
  std::optional<Origin> origin{};
};

/// What is common to parameters of any type.
struct About {
  std::string key{};
  std::string meaning{};
  std::vector<std::string> options{};
};

/// A finite number in `unit` ("" for none). `show` and `store` reach the variable behind it.
Parameter number_parameter(About about, const Bounds& bounds, const std::string& unit,
                           std::function<std::optional<double>()> show,
                           std::function<void(double)> store);
/// The same for seconds that may also be given as 1h30m.
Parameter duration_parameter(About about, const Bounds& bounds,
                             std::function<std::optional<double>()> show,
                             std::function<void(double)> store);
Parameter whole_parameter(About about, const Bounds& bounds, const std::string& unit,
                          std::function<std::optional<std::int64_t>()> show,
                          std::function<void(std::int64_t)> store);
Parameter choice_parameter(About about, std::string& value, std::vector<std::string> choices,
                           const std::string& allowed);
/// @param implied  what the option, which takes no value, means
Parameter flag_parameter(About about, bool& value, bool implied);
Parameter vector_parameter(About about, std::span<double> value, const Bounds& bounds,
                           const std::string& unit);
Parameter text_parameter(About about, const std::string& placeholder, const std::string& allowed,
                         std::function<std::string()> show,
                         std::function<void(const std::string&)> store);

/// Words with a text between them.
std::string joined(const std::vector<std::string>& words, std::string_view separator);

}  // namespace sphmbs::examples
