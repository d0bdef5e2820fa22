// SPDX-License-Identifier: MIT
#include "support/session_checkpoints.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <vector>

#include <cxxabi.h>

#include "sphmbs/core/error.hpp"
#include "sphmbs/version.hpp"

namespace sphmbs::examples {
namespace {

/// "table.key" with value, of each parameter in the text of a parameter file that a program wrote.
io::Identity parameters_in(const std::string& text) {
  io::Identity all;
  std::istringstream lines(text);
  std::string table;
  int entries = 0;  // of lists of tables
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[["))
      table = line.substr(2, line.find(']') - 2) + "." + std::to_string(entries++) + ".";
    else if (line.starts_with('['))
      table = line.substr(1, line.find(']') - 1) + ".";
    const std::size_t equals = line.find(" = ");
    if (line.empty() || line.starts_with('#') || equals == std::string::npos) continue;
    bool quoted = false;
    std::size_t end = equals + 3;
    for (; end < line.size() && (quoted || line[end] != '#'); ++end)
      if (line[end] == '"' && line[end - 1] != '\\') quoted = !quoted;
    const std::string value = line.substr(equals + 3, end - equals - 3);
    all[table + line.substr(0, equals)] = value.substr(0, value.find_last_not_of(' ') + 1);
  }
  return all;
}

/// What may change from one part of a run to the next.
bool is_harmless(const std::string& parameter) {
  if (parameter.starts_with("guards.")) return true;
  constexpr std::array<std::string_view, 9> names{
      "run.until",    "run.fields", "run.samples", "run.steps",           "run.threads",
      "run.walltime", "run.plots",  "run.quiet",   "run.checkpoint_every"};
  return std::find(names.begin(), names.end(), parameter) != names.end();
}

}  // namespace

std::string readable_type(const std::type_info& type) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), std::free);
  return text ? text.get() : type.name();
}

SessionCheckpoints::SessionCheckpoints(const Settings& settings, const std::string& program,
                                       io::Identity identity)
    : checkpoints_(settings.output / "checkpoint"),
      asked_(settings.resume.value_or(std::filesystem::path())),
      identity_(std::move(identity)) {
  identity_["program"] = program;
  identity_["version"] = std::string(version);
  identity_["backend"] = settings.backend;
  identity_["precision"] = settings.precision;
  for (const auto& [key, content] : settings.contents) identity_["content of " + key] = content;
  identity_.merge(parameters_in(settings.used));
}

std::unique_ptr<io::CheckpointFile> SessionCheckpoints::open(Report& report) const {
  std::unique_ptr<io::CheckpointFile> file;
  if (!asked_.empty()) {
    file = std::make_unique<io::CheckpointFile>(asked_);
  } else {
    std::vector<std::string> skipped;
    file = checkpoints_.newest(skipped);
    for (const std::string& why : skipped) report.warn("skipped " + why, why + "; skipped");
  }
  if (!file)
    throw InvalidInput("--resume: there is no whole checkpoint in " +
                           checkpoints_.folder().string() +
                           "; start without it, or name one with --resume FILE",
                       "E040");
  io::require_same_identity(*file, io::Checkpoints::identity_of(*file), identity_, is_harmless);
  return file;
}

void SessionCheckpoints::go_on_from(const io::CheckpointFile& file) const {
  checkpoints_.set_aside_others(file.path());
}

void SessionCheckpoints::forget_earlier() const {
  std::error_code ignored;
  for (const auto& path : checkpoints_.list()) std::filesystem::remove(path, ignored);
  checkpoints_.remove_unfinished();
}

}  // namespace sphmbs::examples
