// SPDX-License-Identifier: MIT
// Preloaded into a program, makes the n-th call of write, fsync, close or rename on files below the
// folder FAIL_IN fail: n is FAIL_AT, the error FAIL_WITH, where 0 means half of what was to be
// written, -1 that another byte is, and -2 that it takes ten seconds. With FAIL_CALL only calls of
// that function count. Locks fail with the error FAIL_FLOCK, and FAIL_ROOM blocks are free on every
// disk, where those are given.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

int calls = 0;

int error_number() {
  const char* with = std::getenv("FAIL_WITH");
  return with == nullptr ? EIO : std::atoi(with);
}

bool is_below(const char* path) {
  const char* folder = std::getenv("FAIL_IN");
  return folder != nullptr && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_below(int file) {
  char path[4096];
  const ssize_t length =
      ::readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path, sizeof path - 1);
  if (length < 0) return false;
  path[length] = '\0';
  return is_below(path);
}

/// Counts a call of a function, and whether it is the one to fail.
bool fails(std::string_view call) {
  const char* only = std::getenv("FAIL_CALL");
  if (only != nullptr && call != only) return false;
  const char* at = std::getenv("FAIL_AT");
  return at != nullptr && ++calls == std::atoi(at);
}

template <class Function>
Function* real(Function* /*same type*/, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int failed() {
  errno = error_number();
  return -1;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
  const bool fail = is_below(file) && fails("write");
  if (fail && error_number() == -2)
    for (unsigned left = 10; left > 0;) left = ::sleep(left);
  if (fail && error_number() == -1 && size > 0) {
    std::string other(static_cast<const char*>(data), size);
    other[size / 2] = static_cast<char>(other[size / 2] ^ 1);
    return real(write, "write")(file, other.data(), size);
  }
  if (fail && error_number() > 0) return failed();
  return real(write, "write")(file, data,
                              fail && error_number() == 0 && size > 1 ? size / 2 : size);
}

// What streams write in pieces; half of that is its first piece.
ssize_t writev(int file, const iovec* pieces, int count) {
  const bool fail = is_below(file) && fails("write");
  if (fail && error_number() > 0) return failed();
  return real(writev, "writev")(file, pieces, fail && error_number() == 0 ? 1 : count);
}

int fsync(int file) {
  if (is_below(file) && error_number() != 0 && fails("fsync")) return failed();
  return real(fsync, "fsync")(file);
}

int close(int file) {
  const bool fail = error_number() != 0 && is_below(file) && fails("close");
  const int result = real(close, "close")(file);
  return fail ? failed() : result;
}

int flock(int file, int operation) noexcept {
  const char* with = std::getenv("FAIL_FLOCK");
  if (with == nullptr) return real(flock, "flock")(file, operation);
  errno = std::atoi(with);
  return -1;
}

int statvfs(const char* path, struct statvfs* about) noexcept {
  const int result = real(statvfs, "statvfs")(path, about);
  const char* room = std::getenv("FAIL_ROOM");
  if (room != nullptr) about->f_bavail = std::strtoul(room, nullptr, 10);
  return result;
}

int rename(const char* from, const char* to) noexcept {
  if (is_below(to) && error_number() == EIO && fails("rename")) return failed();
  return real(rename, "rename")(from, to);
}
}
