// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace test {

/// What a program is started with beside its arguments.
struct Surroundings {
  std::vector<std::pair<std::string, std::string>> environment{};
  rlim_t file_size = RLIM_INFINITY;  // largest file it may write [bytes]
  rlim_t memory = RLIM_INFINITY;     // address space [bytes]
  bool output_gone = false;          // nobody reads its standard output
};

/// A program that runs in the background, with its output in a file.
class Process {
 public:
  Process(const std::string& program, const std::vector<std::string>& arguments,
          const std::filesystem::path& output, const Surroundings& surroundings = {}) {
    int gone[2] = {-1, -1};
    if (surroundings.output_gone && ::pipe(gone) == 0) ::close(gone[0]);
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    child_ = ::fork();
    if (child_ == 0) {
      for (const auto& [name, value] : surroundings.environment)
        ::setenv(name.c_str(), value.c_str(), 1);
      limit(RLIMIT_FSIZE, surroundings.file_size);
      limit(RLIMIT_AS, surroundings.memory);
      const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
      ::dup2(surroundings.output_gone ? gone[1] : file, STDOUT_FILENO);
      ::dup2(file, STDERR_FILENO);
      ::execv(program.c_str(), words.data());
      ::_exit(127);
    }
    if (gone[1] >= 0) ::close(gone[1]);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (child_ <= 0) return;
    signal(SIGKILL);
    wait();
  }

  void signal(int number) const { ::kill(child_, number); }
  /// Exit code, or 128 + the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(child_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  static void limit(decltype(RLIMIT_AS) what, rlim_t most) {
    const rlimit limits{most, most};
    if (most != RLIM_INFINITY) ::setrlimit(what, &limits);
  }

  ::pid_t child_;
};

/// Waits until something is so; gives up after a minute.
template <class Condition>
bool wait_until(const Condition& condition) {
  for (int k = 0; k < 60000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace test
