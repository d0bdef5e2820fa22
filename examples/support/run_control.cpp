// SPDX-License-Identifier: MIT
#include "support/run_control.hpp"

#include <system_error>

#include "support/text.hpp"

namespace sphmbs::examples {

RunControl::RunControl(const Settings& settings)
    : settings_(settings), stop_file_(settings.output / "stop") {}

void RunControl::begin() {
  std::error_code ignored;
  std::filesystem::remove(stop_file_, ignored);
}

RunControl::Decision RunControl::decide(std::int64_t step) {
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto stop = [](std::string why, int exit_code) {
    return Decision{.save = true, .stop = std::move(why), .exit_code = exit_code};
  };
  const Clock::time_point now = Clock::now();
  if (const int signal = signals_.end()) return stop(name_of_signal(signal), 128 + signal);
  std::error_code ignored;
  if (std::filesystem::remove(stop_file_, ignored)) return stop("the file stop", 0);
  if (settings_.walltime && seconds(now - begin_) >= *settings_.walltime)
    return stop("the wall time of " + format_exact(*settings_.walltime) + " s", 0);
  if (settings_.steps && step >= *settings_.steps)
    return stop("the number of steps of " + std::to_string(*settings_.steps), 0);
  return {.save = signals_.take_save() || seconds(now - last_save_) >= settings_.checkpoint_every};
}

void RunControl::saved() {
  last_save_ = Clock::now();
  failures_ = 0;
}

bool RunControl::failed() {
  last_save_ = Clock::now();
  return ++failures_ >= 3;
}

}  // namespace sphmbs::examples
