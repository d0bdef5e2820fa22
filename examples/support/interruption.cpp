// SPDX-License-Identifier: MIT
#include "support/interruption.hpp"

#include <array>
#include <csignal>
#include <string_view>

#include <unistd.h>

namespace sphmbs::examples {
namespace {

// What a signal handler may write to.
volatile std::sig_atomic_t end_signal = 0;
volatile std::sig_atomic_t save_asked = 0;

constexpr std::array<int, 3> ending{SIGINT, SIGTERM, SIGHUP};

extern "C" void note_end(int signal) {
  if (signal == SIGINT && end_signal == SIGINT) ::_exit(128 + SIGINT);
  end_signal = signal;
}
extern "C" void end_at_once(int signal) {
  constexpr std::string_view message = "stopped   before the first step, with nothing to save\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(128 + signal);
}
extern "C" void note_save(int) { save_asked = 1; }

void handle(int signal, void (*handler)(int)) {
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  const bool ends = handler == note_end || handler == end_at_once;
  if (ends && before.sa_handler == SIG_IGN) return;  // as under nohup
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  end_signal = 0;
  save_asked = 0;
  for (const int signal : ending) handle(signal, note_end);
  handle(SIGUSR1, note_save);
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
}

Interruption::~Interruption() {
  for (const int signal : ending) handle(signal, SIG_DFL);
  handle(SIGUSR1, SIG_IGN);
}

int Interruption::end() const { return end_signal; }

bool Interruption::take_save() const {
  const bool asked = save_asked != 0;
  save_asked = 0;
  return asked;
}

void end_at_signals() {
  for (const int signal : ending) handle(signal, end_at_once);
}

std::string name_of_signal(int signal) {
  switch (signal) {
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    case SIGHUP:
      return "SIGHUP";
    default:
      return "signal " + std::to_string(signal);
  }
}

}  // namespace sphmbs::examples
