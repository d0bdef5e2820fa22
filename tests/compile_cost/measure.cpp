// SPDX-License-Identifier: MIT
// measure <CPU seconds> <MB> <command...>: runs a command and fails if it, with the programs that
// it starts, takes more. Processor time, since other programs on the computer lengthen the time of
// day.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const double most_seconds = std::atof(argv[1]), most_memory = std::atof(argv[2]);
  const pid_t command = fork();
  if (command == 0) {
    execvp(argv[3], argv + 3);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (command < 0 || wait4(command, &status, 0, &usage) != command) return 2;
  const double seconds = static_cast<double>(usage.ru_utime.tv_sec) +
                         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  const double memory = static_cast<double>(usage.ru_maxrss) / 1000;  // of the largest process
  std::printf("%.1f CPU seconds, allowed %g; %.0f MB, allowed %g\n", seconds, most_seconds, memory,
              most_memory);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return 2;
  return seconds <= most_seconds && memory <= most_memory ? 0 : 1;
}
