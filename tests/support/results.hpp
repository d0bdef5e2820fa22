// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "support/program.hpp"

namespace test {

/// The files of a run, by name, without those that tell of times on the clock, of checkpoints and
/// of the folder, and without SVG, in which names count the pictures that a process has drawn; PNG
/// of the same are there.
inline std::map<std::string, std::string> results_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (!entry.is_regular_file() || name.starts_with("checkpoint") || name == "summary.json" ||
        name == "used.toml" || name == ".lock" || name.ends_with(".svg") || name == "view.py")
      continue;
    files[name] = text_of(entry.path());
  }
  return files;
}

/// What differs between the files of two runs, by name; empty where nothing does.
inline std::string differences(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::string names;
  const auto mine = results_in(a), its = results_in(b);
  for (const auto& [name, text] : mine)
    if (!its.contains(name) || its.at(name) != text) names += name + " ";
  for (const auto& [name, text] : its)
    if (!mine.contains(name)) names += name + " ";
  return names;
}

}  // namespace test
