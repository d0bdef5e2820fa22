// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sphmbs::examples {

/// Heeds the signals of this process for as long as it lives: one that asks the process to end
/// (SIGINT, SIGTERM, SIGHUP) is noted, to end the run at the next step boundary; a second SIGINT
/// ends the process at once. SIGUSR1 asks for a checkpoint. SIGPIPE is ignored: a reader of
/// standard output that went away does not end a run. Only one at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that asks to end, or 0.
  int end() const;
  /// Whether SIGUSR1 has come since it was last asked for.
  bool take_save() const;
};

/// From now on, while there is nothing to save yet, a signal that asks the process to end does so
/// at once, with exit code 128 + its number; until an Interruption lives.
void end_at_signals();

/// "SIGTERM" and so on.
std::string name_of_signal(int signal);

}  // namespace sphmbs::examples
