// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "support/settings.hpp"

namespace sphmbs::examples {

/// Keeps a second run out of a directory of results, by a locked file `.lock` with the number of
/// the process and the name of the computer. The operating system gives the lock of a process that
/// is dead free, so that what a killed run leaves is taken over.
class OutputLock {
 public:
  OutputLock() = default;
  ~OutputLock() { release(); }
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

  /// Throws InvalidInput with the number of the process that has the directory, and OutputError if
  /// the file cannot be made. Where the file system has no locks, fault() says so. Nothing happens
  /// if this lock has the directory already.
  void acquire(const std::filesystem::path& directory);
  /// Removes the file.
  void release();
  /// Why the file could not be locked, and other runs are not kept out; empty where they are.
  const std::string& fault() const { return fault_; }

 private:
  std::filesystem::path file_{};
  std::string fault_{};
  int descriptor_ = -1;
};

/// Why `path` cannot become the directory of the results, or nothing if it can: it must be new, or
/// empty unless `overwrite` is set, writable, and no other run may be at work in it. Changes
/// nothing.
std::optional<std::string> fault_of_output(const std::filesystem::path& path, bool overwrite);

/// Creates the directory of the results, once all input is accepted, and locks it; files stay.
/// Returns whether it is new. Throws OutputError with path and reason, and InvalidInput if another
/// run is at work in it.
bool prepare_output(const Settings& settings);

/// Writes used.toml, once nothing is left that could be refused. Throws OutputError with path and
/// reason.
void write_used(const Settings& settings);

}  // namespace sphmbs::examples
