// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <system_error>

#include <sphmbs/core/error.hpp>

namespace sphmbs::io::detail {

/// Replaces the file `path` by the concatenated chunks. They go to `path` + ".tmp" first, which is
/// renamed once it is complete, so that a reader never meets half a file. Two processes must not
/// write the same path at the same time. Throws OutputError with path and reason; an earlier file
/// `path` is then untouched.
inline void replace_file(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> chunks) {
  const auto failed = [&path](const std::error_code& reason) {
    return OutputError("cannot write " + path.string() + ": " + reason.message());
  };
  const auto last_error = [] { return std::error_code(errno, std::generic_category()); };

  std::filesystem::path temporary = path;
  temporary += ".tmp";
  std::FILE* const file = std::fopen(temporary.string().c_str(), "wb");
  if (file == nullptr) throw failed(last_error());

  std::error_code reason;
  for (const auto chunk : chunks) {
    if (reason || chunk.empty()) continue;
    if (std::fwrite(chunk.data(), 1, chunk.size(), file) != chunk.size()) reason = last_error();
  }
  if (std::fclose(file) != 0 && !reason) reason = last_error();
  if (!reason) std::filesystem::rename(temporary, path, reason);
  if (reason) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw failed(reason);
  }
}

}  // namespace sphmbs::io::detail
