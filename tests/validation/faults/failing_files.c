/* SPDX-License-Identifier: MIT */
/* Preloaded, makes the n-th call of write, fsync, rename or close on a file under the folder FAIL_IN
   fail: n is FAIL_AT, the error FAIL_WITH, 0 for half of what was to be written. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static long calls = 0;

static int is_meant(int file) {
  const char* folder = getenv("FAIL_IN");
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (folder == NULL || length < 0) return 0;
  path[length] = '\0';
  return strncmp(path, folder, strlen(folder)) == 0;
}

/* Whether this call is to fail. */
static int fails(void) {
  const char* at = getenv("FAIL_AT");
  return at != NULL && ++calls == atol(at);
}

static int error_number(void) {
  const char* with = getenv("FAIL_WITH");
  return with == NULL ? EIO : atoi(with);
}

ssize_t write(int file, const void* data, size_t size) {
  ssize_t (*real)(int, const void*, size_t) =
      (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  if (is_meant(file) && fails()) {
    if (error_number() == 0) return real(file, data, size > 1 ? size / 2 : size);
    errno = error_number();
    return -1;
  }
  return real(file, data, size);
}

int fsync(int file) {
  int (*real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
  if (is_meant(file) && error_number() != 0 && fails()) {
    errno = error_number();
    return -1;
  }
  return real(file);
}

int close(int file) {
  int (*real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "close");
  if (is_meant(file) && error_number() != 0 && fails()) {
    real(file);
    errno = error_number();
    return -1;
  }
  return real(file);
}

int rename(const char* from, const char* to) {
  int (*real)(const char*, const char*) =
      (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  const char* folder = getenv("FAIL_IN");
  if (folder != NULL && strncmp(to, folder, strlen(folder)) == 0 && error_number() != 0 && fails()) {
    errno = error_number();
    return -1;
  }
  return real(from, to);
}
