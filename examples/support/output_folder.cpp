// SPDX-License-Identifier: MIT
#include "support/output_folder.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "sphmbs/core/error.hpp"

namespace sphmbs::examples {
namespace {

namespace fs = std::filesystem;

/// Why no file can be created in a directory, or nothing.
std::optional<std::string> fault_of_writing(const fs::path& directory) {
  if (::faccessat(AT_FDCWD, directory.c_str(), W_OK | X_OK, AT_EACCESS) == 0) return std::nullopt;
  return std::generic_category().message(errno);
}

std::optional<std::string> fault_of_creating(const fs::path& path) {
  std::error_code error;
  fs::path ancestor = fs::absolute(path, error);
  if (error) return error.message();
  fs::file_status status = fs::status(ancestor, error);
  while (status.type() == fs::file_type::not_found && ancestor.has_relative_path()) {
    ancestor = ancestor.parent_path();
    status = fs::status(ancestor, error);
  }
  if (status.type() == fs::file_type::none) return error.message();
  if (!fs::is_directory(status)) return ancestor.string() + " is not a directory";
  if (const auto fault = fault_of_writing(ancestor)) return ancestor.string() + ": " + *fault;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> fault_of_output(const fs::path& path, bool overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    const auto fault = fault_of_creating(path);
    return fault ? std::optional("must be a directory that can be created: " + *fault)
                 : std::nullopt;
  }
  if (!fs::is_directory(status)) return "must be a directory, but a file has this name";
  if (const auto fault = fault_of_writing(path)) {
    return "must be a directory that can be written: " + *fault;
  }
  const bool empty = fs::is_empty(path, error);
  if (error) return "must be a directory that can be read: " + error.message();
  if (!empty && !overwrite) {
    return "must be new or empty; --overwrite replaces the files of the same names in it";
  }
  return std::nullopt;
}

bool prepare_output(const Settings& settings) {
  std::error_code error;
  const bool created = fs::create_directories(settings.output, error);
  if (error) {
    throw OutputError("cannot create " + settings.output.string() + ": " + error.message());
  }
  return created;
}

}  // namespace sphmbs::examples
