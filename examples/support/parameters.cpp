// SPDX-License-Identifier: MIT
#include "support/parameters.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <ostream>
#include <span>
#include <stdexcept>
#include <utility>

#include "support/build_info.hpp"
#include "support/output_folder.hpp"
#include "support/parameter_file.hpp"
#include "support/parameters_parts.hpp"

#include "sphmbs/io/crc64.hpp"
#include "sphmbs/version.hpp"

namespace sphmbs::examples {
namespace {

About about(const std::string& key, const std::string& meaning, const std::string& option) {
  return {key, meaning, option.empty() ? std::vector<std::string>{} : std::vector{option}};
}

/// Checksum and size of a file, to tell whether it is still the same.
std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "not readable";
  io::Crc64 checksum;
  std::size_t size = 0;
  std::array<char, 1 << 16> piece;
  do {
    file.read(piece.data(), piece.size());
    const auto read = static_cast<std::size_t>(file.gcount());
    checksum.add(std::as_bytes(std::span(piece).first(read)));
    size += read;
  } while (file);
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(checksum.value()));
  return std::string(digits.data()) + " (CRC-64 of " + std::to_string(size) + " bytes)";
}

}  // namespace

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

void Parameters::add_path(const std::string& key, std::string& value, const std::string& meaning,
                          const std::string& option) {
  parts_->add(text_parameter(
      about(key, meaning, option), "FILE", "the path of a file", [&value] { return value; },
      [&value](const std::string& path) { value = path; }));
  parts_->files.push_back({key, &value});
}

void Parameters::add_vector(const std::string& key, std::span<double> value, const Bounds& bounds,
                            const std::string& unit, const std::string& meaning,
                            const std::string& option) {
  parts_->add(vector_parameter(about(key, meaning, option), value, bounds, unit));
}

std::optional<Settings> Parameters::parse(int argc, const char* const* argv, std::ostream& out) {
  const auto answer = [&](const std::string& word) {
    if (word == "-h" || word == "--help") return help();
    if (word == "--version") return version_line() + '\n';
    if (word == "--list-params") return list();
    return std::string();
  };
  for (int i = 1; i < argc; ++i) {
    const std::string text = answer(argv[i]);
    out << text;
    if (!text.empty()) return std::nullopt;
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
  for (const auto& [key, path] : parts.files) accepted.contents[key] = content_of(*path);
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

BadParameters Parameters::located(const std::vector<RefusedValue>& all) const {
  Complaints complaints;
  for (const RefusedValue& refused : all) {
    const Parameter* const p = parts_->find(refused.name);
    std::string name = refused.name;
    Place place{"default"};
    if (p && p->origin) {
      place = p->origin->place;
      name = p->origin->name;
    } else if (p && !p->key.empty()) {
      name = p->key;
    }
    complaints.add(place, refused.id, named(name, refused.value) + refused.why);
  }
  try {
    complaints.raise();
  } catch (const BadParameters& error) {
    return error;
  }
  throw std::logic_error("a complaint that is none");
}

}  // namespace sphmbs::examples
