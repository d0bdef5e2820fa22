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

namespace detail {

/// Writes all to an open file. @return 0, or the number of the error
inline int write_all(int file, std::span<const std::byte> bytes) {
  constexpr std::size_t most = std::size_t{1} << 30;  // systems write less than 2 GiB at once
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(file, bytes.data(), std::min(most, bytes.size()));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Hands an open file to the disk. @return 0, or the number of the error
inline int sync(int file) {
  while (::fsync(file) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

/// @throws OutputError
[[noreturn]] inline void fail(const std::string& what, const std::filesystem::path& path,
                              int reason) {
  throw OutputError(what + " " + path.string() + ": " + std::generic_category().message(reason));
}

/// Hands what a folder lists to the disk; an empty path is the current one. A folder that may not
/// be read gets there in its own time, and some systems cannot do this for folders.
/// @throws OutputError with path and reason.
inline void sync_folder(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.empty() ? "." : path;
  const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int reason = directory < 0 ? errno : sync(directory);
  if (directory >= 0) ::close(directory);
  if (reason != 0 && reason != EACCES && reason != ENOENT && reason != EINVAL)
    fail("cannot hand to the disk", folder, reason);
}

}  // namespace detail

/// Hands files that were written, and the folders they are in, to the disk: they are there when the
/// power fails. Those that are gone are left out.
/// @throws OutputError with path and reason.
inline void hand_to_disk(const std::set<std::filesystem::path>& files) {
  std::set<std::filesystem::path> folders;
  for (const std::filesystem::path& path : files) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const int reason = file < 0 ? errno : detail::sync(file);
    if (file >= 0) ::close(file);
    if (reason != 0 && reason != ENOENT && reason != EINVAL)
      detail::fail("cannot hand to the disk", path, reason);
    folders.insert(path.parent_path());
  }
  for (const std::filesystem::path& folder : folders) detail::sync_folder(folder);
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
    if (file_ < 0) detail::fail("cannot create", temporary_, errno);
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
    if (const int reason = detail::write_all(file_, bytes); reason != 0)
      detail::fail("cannot write", path_, reason);
  }

  /// Hands everything to the disk and closes the file, which then still has its temporary name.
  /// @throws OutputError with path and reason.
  void close() {
    if (const int reason = detail::sync(file_); reason != 0)
      detail::fail("cannot hand to the disk", path_, reason);
    // Whatever close says, the descriptor is free afterwards.
    if (::close(std::exchange(file_, -1)) != 0 && errno != EINTR)
      detail::fail("cannot close", path_, errno);
  }

  /// Gives the closed file its name, in place of an earlier one.
  /// @throws OutputError with path and reason.
  void finish() {
    if (::rename(temporary_.c_str(), path_.c_str()) != 0)
      detail::fail("cannot rename", path_, errno);
    finished_ = true;
    detail::sync_folder(path_.parent_path());
  }

 private:
  std::filesystem::path path_, temporary_;
  int file_ = -1;
  bool finished_ = false;
};

}  // namespace sphmbs::io
