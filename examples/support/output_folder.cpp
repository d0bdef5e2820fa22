// SPDX-License-Identifier: MIT
#include "support/output_folder.hpp"

#include <array>
#include <cerrno>
#include <fstream>
#include <span>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sphmbs/core/error.hpp"
#include "sphmbs/io/durable_file.hpp"
#include "support/text.hpp"

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

constexpr const char* lock_name = ".lock";

std::string reason() { return std::generic_category().message(errno); }

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown computer";
}

/// What a lock file says: "process 1234 on node7".
std::string owner(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line.empty() ? "another process" : one_line(line.substr(0, 300));
}

std::string in_use(const fs::path& file) {
  return "is in use by " + owner(file) + "; wait for its end or choose another directory";
}

/// Whether another run holds the lock of a directory.
bool is_locked(const fs::path& directory) {
  const int descriptor = ::open((directory / lock_name).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  const bool locked = !free && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

/// Whether a file that was opened is still the one of this name.
bool is_named(int descriptor, const fs::path& file) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

void OutputLock::acquire(const fs::path& directory) {
  const fs::path file = directory / lock_name;
  if (descriptor_ >= 0 && is_named(descriptor_, file)) return;
  release();
  const auto fail = [&file] {
    throw OutputError("cannot lock " + file.string() + ": " + reason());
  };
  // An owner that ends removes the file, perhaps after it was opened here.
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail();
    fault_.clear();
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) continue;
    if (errno == EWOULDBLOCK) {
      ::close(descriptor_);
      descriptor_ = -1;
      throw InvalidInput(directory.string() + ": " + in_use(file), "E031");
    }
    fault_ = "cannot lock " + file.string() + ": " + reason();
  } while (!is_named(descriptor_, file));
  file_ = file;
  const std::string line = "process " + std::to_string(::getpid()) + " on " + host() + "\n";
  if (::ftruncate(descriptor_, 0) != 0) fail();
  errno = io::detail::write_all(descriptor_, std::as_bytes(std::span(line)));
  if (errno != 0) fail();
}

void OutputLock::release() {
  if (descriptor_ < 0) return;
  if (is_named(descriptor_, file_)) ::unlink(file_.c_str());
  ::close(descriptor_);
  descriptor_ = -1;
}

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
  if (is_locked(path)) return in_use(path / lock_name);
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
  if (settings.lock) settings.lock->acquire(settings.output);
  return created;
}

void write_used(const Settings& settings) {
  if (settings.used.empty()) return;
  const fs::path file = settings.output / "used.toml";
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  if (!stream.write(settings.used.data(), static_cast<std::streamsize>(settings.used.size()))
           .flush()) {
    throw OutputError("cannot write " + file.string() + ": " + reason());
  }
}

}  // namespace sphmbs::examples
