// SPDX-License-Identifier: MIT
#include "support/parameter_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include <toml++/toml.h>

#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;

Place place_of(const toml::source_region& region, const std::string& name) {
  return {name, region.begin.line, region.begin.column};
}

Given given(const toml::node& node, const std::string& name) {
  Given result{Given::Other{}, place_of(node.source(), name)};
  if (const auto* number = node.as_floating_point()) {
    result.value = number->get();
  } else if (const auto* whole = node.as_integer()) {
    result.value = whole->get();
  } else if (const auto* flag = node.as_boolean()) {
    result.value = flag->get();
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else if (const auto* array = node.as_array()) {
    Given::List list;
    for (const toml::node& item : *array) list.push_back(given(item, name));
    result.value = std::move(list);
  } else if (const auto* table = node.as_table()) {
    Given::Table members;
    for (const auto& [key, value] : *table)
      members.push_back({std::string(key.str()), place_of(key.source(), name), given(value, name)});
    result.value = std::move(members);
  }
  return result;
}

}  // namespace

std::optional<std::string> read_parameter_file(const std::string& path, Complaints& complaints) {
  const auto refuse = [&](std::string_view id, const std::string& why) {
    complaints.add({path}, id, why);
    return std::nullopt;
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return refuse("E001", "cannot read: is a directory, not a parameter file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return refuse("E001", "cannot read: " + std::generic_category().message(errno));
  std::string text;
  std::array<char, 4096> block;
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), count);
    if (text.size() > largest_file) {
      return refuse("E001", "is larger than 1 MiB: no parameter file");
    }
  }
  if (std::ferror(file.get())) return refuse("E001", "cannot read to its end");
  if (text.find('\0') != std::string::npos) {
    return refuse("E002", "holds bytes that are no text: no parameter file");
  }
  return text;
}

std::optional<Given> parse_toml(std::string_view text, const std::string& name,
                                Complaints& complaints) {
  try {
    const toml::table table = toml::parse(text);
    return given(table, name);
  } catch (const toml::parse_error& error) {
    const std::string why(error.description());
    const bool twice = why.find("redefine") != std::string::npos;
    complaints.add(place_of(error.source(), name), twice ? "E004" : "E003", why);
    return std::nullopt;
  }
}

}  // namespace sphmbs::examples
