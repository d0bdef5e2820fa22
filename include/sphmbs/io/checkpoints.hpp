// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/io/state_archive.hpp>

namespace sphmbs::io {

/// What a checkpoint belongs to: names with values, such as {"dimension", "2"} or
/// {"gas.gamma", "1.4"}. A run that differs in one of them is refused.
using Identity = std::map<std::string, std::string>;

/// Compares what a checkpoint belongs to with what the run is, name by name.
/// @param harmless  whether a name may differ
/// @throws RefusedCheckpoint with each difference, both values named.
inline void require_same_identity(
    const CheckpointFile& file, const Identity& saved, const Identity& present,
    const std::function<bool(const std::string&)>& harmless = [](const std::string&) {
      return false;
    }) {
  std::string differences;
  const auto compare = [&](const std::string& name, const std::string& was, const std::string& is) {
    if (was == is || harmless(name)) return;
    differences += (differences.empty() ? "" : "; ") + name + " was " + was + " and is " + is;
  };
  for (const auto& [name, value] : saved) {
    const auto now = present.find(name);
    compare(name, value, now == present.end() ? "not given" : now->second);
  }
  for (const auto& [name, value] : present)
    if (!saved.contains(name)) compare(name, "not given", value);
  if (!differences.empty()) file.refuse("E406", "belongs to another run: " + differences);
}

/// The checkpoints of a run in a directory of its own, named by step: a new one is written beside
/// the others, read again and checked, and only then gets its name and the oldest go.
class Checkpoints {
 public:
  /// @param keep  how many stay, at least 2
  explicit Checkpoints(std::filesystem::path folder, std::size_t keep = 2)
      : folder_(std::move(folder)), keep_(std::max<std::size_t>(keep, 2)) {}

  /// Where the files are.
  const std::filesystem::path& folder() const { return folder_; }

  /// Writes the checkpoint of a step.
  /// @param show  called as show(StateWriter&)
  /// @return its path
  /// @throws OutputError with path and reason, also where there is less room than the newest one
  ///         takes, RefusedCheckpoint if what was written cannot be read again: earlier checkpoints
  ///         are then untouched.
  template <class Show>
  std::filesystem::path write(std::uint64_t step, const Identity& identity, const Show& show) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) throw OutputError("cannot create " + folder_.string() + ": " + error.message());
    const std::filesystem::path path = folder_ / name_of(step);
    require_room(path);
    CheckpointFileWriter file(path);
    StateWriter archive(file);
    Identity belongs = identity;
    archive("identity", belongs);
    show(archive);
    CheckpointFile written(file.close());
    file.finish();
    const auto all = list();
    for (std::size_t k = keep_; k < all.size(); ++k)
      if (all[k] != path) std::filesystem::remove(all[k], error);
    return path;
  }

  /// For a run that goes on from a checkpoint: those of later steps, which are of another course of
  /// the run or damaged, get names that end in .aside, and what a run that was killed left
  /// unfinished goes.
  void set_aside_others(const std::filesystem::path& from) const {
    std::error_code ignored;
    for (const std::filesystem::path& path : list())
      if (path.filename() > from.filename() || !is_name(from))
        std::filesystem::rename(path, path.string() + ".aside", ignored);
    remove_unfinished();
  }

  /// Removes files of writes that never ended. No other run may write into the folder.
  void remove_unfinished() const {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored))
      if (entry.path().string().find(std::string(extension) + ".tmp.") != std::string::npos)
        std::filesystem::remove(entry.path(), ignored);
  }

  /// Complete or not, newest first.
  std::vector<std::filesystem::path> list() const {
    std::vector<std::filesystem::path> all;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder_, error))
      if (is_name(entry.path())) all.push_back(entry.path());
    std::sort(all.begin(), all.end(), std::greater<>());
    return all;
  }

  /// The newest checkpoint that is whole, or nothing.
  /// @param skipped  gets a line for each newer one that is not
  std::unique_ptr<CheckpointFile> newest(std::vector<std::string>& skipped) const {
    for (const std::filesystem::path& path : list()) {
      try {
        return std::make_unique<CheckpointFile>(path);
      } catch (const RefusedCheckpoint& refused) {
        skipped.push_back(refused.what());
      }
    }
    return nullptr;
  }

  /// What a file belongs to.
  static Identity identity_of(CheckpointFile& file) {
    Identity identity;
    StateReader archive(file);
    archive("identity", identity);
    return identity;
  }

  static constexpr const char* extension = ".ckpt";  ///< of their names

 private:
  // For as much as the newest checkpoint takes.
  void require_room(const std::filesystem::path& path) const {
    const auto all = list();
    std::error_code unknown;
    const auto needed = all.empty() ? 0 : std::filesystem::file_size(all.front(), unknown);
    const auto room = std::filesystem::space(folder_, unknown);
    if (!unknown && room.available < needed)
      throw OutputError("cannot write " + path.string() + ": it needs about " +
                        std::to_string(needed) + " bytes, and " + std::to_string(room.available) +
                        " are free");
  }

  // Twenty digits, so that names sort as numbers.
  static std::string name_of(std::uint64_t step) {
    const std::string number = std::to_string(step);
    return "step_" + std::string(20 - number.size(), '0') + number + extension;
  }

  static bool is_name(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    return name.size() == name_of(0).size() && name.starts_with("step_") &&
           name.ends_with(extension) && name.find_first_not_of("0123456789", 5) == 25;
  }

  std::filesystem::path folder_;
  std::size_t keep_;
};

}  // namespace sphmbs::io
