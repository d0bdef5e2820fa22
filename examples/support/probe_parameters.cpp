// SPDX-License-Identifier: MIT
#include "support/probe_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "support/parameter.hpp"
#include "support/suggestion.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

const std::vector<std::string> keys{"name", "kind",   "at",     "from",
                                    "to",   "points", "fields", "interval"};
const std::vector<std::string> kinds{"point", "line", "plane", "volume"};
const std::vector<std::string> field_names{"p", "rho", "e", "v", "speed", "c", "T", "mach"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool fits_file_name(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), fits);
}

/// Reads one table.
class Reader {
 public:
  Reader(const Given& given, std::string name, int dim, Complaints& complaints)
      : table_(std::get<Given::Table>(given.value)),
        place_(given.place),
        name_(std::move(name)),
        dim_(static_cast<std::size_t>(dim)),
        complaints_(complaints) {}

  ProbeSpec read() {
    spec_.place = place_;
    for (const Given::Member& member : table_) {
      if (contains(keys, member.key)) continue;
      const std::string nearest = nearest_name(member.key, keys);
      complaints_.add(member.place, "E021",
                      name_ + "." + member.key + ": unknown key" +
                          (nearest.empty() ? "; probes have " + joined(keys, ", ")
                                           : "; did you mean \"" + nearest + "\"?"));
    }
    if (!find("name")) refuse_missing("name");
    take("name", spec_.name, as_text, "a text of letters, digits, - and _, at most 64",
         fits_file_name);
    take("kind", spec_.kind, as_text, "one of " + joined(kinds, ", "),
         [](const std::string& kind) { return contains(kinds, kind); });
    take("interval", spec_.interval, as_number, "a number of seconds, at least 0",
         [](double interval) { return std::isfinite(interval) && interval >= 0; });
    std::int64_t points = spec_.points;
    take("points", points, as_whole_number, "a whole number from 2 to 100000",
         [](std::int64_t n) { return n >= 2 && n <= 100000; });
    spec_.points = static_cast<int>(points);
    take("fields", spec_.fields, texts_of, "a list of some of " + joined(field_names, ", "),
         [](const std::vector<std::string>& names) {
           return !names.empty() && std::set(names.begin(), names.end()).size() == names.size() &&
                  std::all_of(names.begin(), names.end(),
                              [](const auto& name) { return contains(field_names, name); });
         });
    if (contains(kinds, spec_.kind)) read_places();
    return spec_;
  }

 private:
  static std::optional<std::vector<std::string>> texts_of(const Given& given) {
    const auto* list = std::get_if<Given::List>(&given.value);
    if (!list) return std::nullopt;
    std::vector<std::string> texts;
    for (const Given& item : *list) {
      const auto text = as_text(item);
      if (!text) return std::nullopt;
      texts.push_back(*text);
    }
    return texts;
  }

  const Given* find(const std::string& key) const {
    for (const Given::Member& member : table_)
      if (member.key == key) return &member.value;
    return nullptr;
  }

  void refuse(const Given& given, const std::string& key, const std::string& why) {
    complaints_.add(given.place, "E026", name_ + "." + key + " = " + given.shown() + ": " + why);
  }
  void refuse_missing(const std::string& key) {
    complaints_.add(place_, "E026", name_ + "." + key + ": is missing");
  }

  template <class T, class Read, class Fits>
  bool take(const std::string& key, T& value, const Read& read, const std::string& allowed,
            const Fits& fits) {
    const Given* const given = find(key);
    if (!given) return false;
    const auto got = read(*given);
    if (got && fits(*got)) {
      value = *got;
      return true;
    }
    refuse(*given, key, "must be " + allowed);
    return false;
  }

  bool take_place(const std::string& key, std::vector<double>& place) {
    const std::string allowed =
        dim_ == 1 ? "a list of 1 number [m], as the gas has one dimension"
                  : "a list of " + std::to_string(dim_) + " numbers [m], one for each dimension";
    return take(key, place, as_numbers, allowed, [this](const std::vector<double>& r) {
      return r.size() == dim_ &&
             std::all_of(r.begin(), r.end(), [](double x) { return std::isfinite(x); });
    });
  }

  void read_places() {
    const bool point = spec_.kind == "point";
    const auto needed =
        point ? std::vector<std::string>{"at"} : std::vector<std::string>{"from", "to"};
    for (const std::string key : {"at", "from", "to"}) {
      const Given* const given = find(key);
      if (contains(needed, key)) {
        if (!given) refuse_missing(key);
      } else if (given) {
        refuse(*given, key, "must be left out: a " + spec_.kind + " has " + joined(needed, ", "));
      }
    }
    if (point) {
      take_place("at", spec_.at);
      return;
    }
    const bool from = take_place("from", spec_.from), to = take_place("to", spec_.to);
    if (!from || !to) return;
    std::size_t extents = 0;
    for (std::size_t k = 0; k < dim_; ++k) extents += spec_.from[k] == spec_.to[k] ? 0 : 1;
    // Plane gas has no plane but its own.
    const std::size_t of_plane = dim_ == 3 ? 2 : dim_;
    if (spec_.kind == "line" && extents == 0) {
      refuse(*find("to"), "to", "must be another place than \"from\"");
    } else if (spec_.kind == "plane" && (dim_ == 1 || extents != of_plane)) {
      refuse(*find("to"), "to",
             dim_ == 1   ? "must not be: a gas of one dimension has no planes"
             : dim_ == 2 ? "must differ from \"from\" in both coordinates"
                         : "must differ from \"from\" in two coordinates and share the third");
    } else if (spec_.kind == "volume" && extents != dim_) {
      refuse(*find("to"), "to", "must differ from \"from\" in every coordinate");
    }
  }

  const Given::Table& table_;
  Place place_;
  std::string name_;
  std::size_t dim_;
  Complaints& complaints_;
  ProbeSpec spec_{};
};

std::string list_of(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(format_exact(number));
  return "[" + joined(texts, ", ") + "]";
}

}  // namespace

std::vector<ProbeSpec> read_probes(const Given& given, int dim, Complaints& complaints) {
  const auto* list = std::get_if<Given::List>(&given.value);
  const auto is_table = [](const Given& item) {
    return std::holds_alternative<Given::Table>(item.value);
  };
  if (!list || !std::all_of(list->begin(), list->end(), is_table)) {
    complaints.add(given.place, "E026", "probes: must be tables, each under a line [[probes]]");
    return {};
  }
  std::vector<ProbeSpec> probes;
  std::set<std::string> names;
  for (const Given& item : *list) {
    const std::string name = "probes[" + std::to_string(probes.size() + 1) + "]";
    probes.push_back(Reader(item, name, dim, complaints).read());
    const std::string& own = probes.back().name;
    if (!own.empty() && !names.insert(own).second) {
      complaints.add(item.place, "E026",
                     name + ".name = " + quoted(own) + ": must be unique, another probe has it");
    }
  }
  return probes;
}

std::string dump_probes(const std::vector<ProbeSpec>& probes) {
  std::string text;
  for (const ProbeSpec& probe : probes) {
    std::vector<std::string> fields;
    for (const std::string& field : probe.fields) fields.push_back(quoted(field));
    text += "\n[[probes]]\nname = " + quoted(probe.name) + "\nkind = " + quoted(probe.kind) + "\n";
    if (!probe.at.empty()) text += "at = " + list_of(probe.at) + "  # [m]\n";
    if (!probe.from.empty()) {
      text += "from = " + list_of(probe.from) + "  # [m]\nto = " + list_of(probe.to) + "  # [m]\n";
    }
    text +=
        "points = " + std::to_string(probe.points) + "  # along a line or a plane's longer side\n";
    text += "fields = [" + joined(fields, ", ") + "]\n";
    text += "interval = " + format_exact(probe.interval) + "  # [s], 0: as history.csv\n";
  }
  return text;
}

}  // namespace sphmbs::examples
