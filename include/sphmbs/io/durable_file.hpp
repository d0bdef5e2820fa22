// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <sphmbs/core/error.hpp>

namespace sphmbs::io {

/// Hands files that were written, and the folders they are in, to the disk: they are there when the
/// power fails. Those that are gone are left out.
/// @throws OutputError with path and reason.
inline void hand_to_disk(const std::set<std::filesystem::path>& files) {
  const auto hand = [](const std::filesystem::path& path, int kind) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | kind);
    int failed = file < 0 ? errno : 0;
    // Some systems cannot do this for folders.
    while (failed == 0 && ::fsync(file) != 0)
      if (errno != EINTR) failed = errno == EINVAL ? -1 : errno;
    if (file >= 0) ::close(file);
    // A folder that may not be read gets there in its own time.
    const bool harmless = failed == ENOENT || (kind == O_DIRECTORY && failed == EACCES);
    if (failed > 0 && !harmless)
      throw OutputError("cannot hand to the disk " + path.string() + ": " +
                        std::generic_category().message(failed));
  };
  std::set<std::filesystem::path> folders;
  for (const std::filesystem::path& path : files) {
    hand(path, 0);
    folders.insert(path.has_parent_path() ? path.parent_path() : ".");
  }
  for (const std::filesystem::path& folder : folders) hand(folder, O_DIRECTORY);
}

/// A file that appears under its name complete, and once it does stays there when the power fails:
/// written under another name, handed to the disk, renamed. One that is not finished leaves
/// nothing. POSIX.
class DurableFile {
 public:
  /// Begins a file; `path` itself is untouched until finish().
  /// @throws OutputError with path and reason.
  explicit DurableFile(std::filesystem::path path) : path_(std::move(path)) {
    temporary_ = path_;
    temporary_ += ".tmp." + std::to_string(::getpid());
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) fail("cannot create", temporary_, errno);
  }
  DurableFile(const DurableFile&) = delete;
  DurableFile& operator=(const DurableFile&) = delete;
  ~DurableFile() {
    if (file_ >= 0) ::close(file_);
    std::error_code ignored;
    if (!finished_) std::filesystem::remove(temporary_, ignored);
  }

  /// Where the file is before it has its name.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// @throws OutputError with path and reason.
  void write(std::span<const std::byte> bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;  // systems write less than 2 GiB at once
    while (!bytes.empty()) {
      const ::ssize_t written = ::write(file_, bytes.data(), std::min(most, bytes.size()));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail("cannot write", path_, written < 0 ? errno : ENOSPC);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  /// Hands everything to the disk and closes the file, which then still has its temporary name.
  /// @throws OutputError with path and reason.
  void close() {
    while (::fsync(file_) != 0)
      if (errno != EINTR) fail("cannot hand to the disk", path_, errno);
    // Whatever close says, the descriptor is free afterwards.
    if (::close(std::exchange(file_, -1)) != 0 && errno != EINTR)
      fail("cannot close", path_, errno);
  }

  /// Gives the closed file its name, in place of an earlier one.
  /// @throws OutputError with path and reason.
  void finish() {
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot rename", path_, errno);
    finished_ = true;
    const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory < 0) return;  // not allowed to be read: the disk gets it in its own time
    const bool known = ::fsync(directory) == 0 || errno == EINVAL || errno == EINTR;
    const int reason = errno;
    ::close(directory);
    if (!known) fail("cannot hand to the disk", folder, reason);
  }

 private:
  [[noreturn]] static void fail(const std::string& what, const std::filesystem::path& path,
                                int reason) {
    throw OutputError(what + " " + path.string() + ": " + std::generic_category().message(reason));
  }

  std::filesystem::path path_, temporary_;
  int file_ = -1;
  bool finished_ = false;
};

}  // namespace sphmbs::io
