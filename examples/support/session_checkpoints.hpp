// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <typeinfo>

#include <sphmbs/io/checkpoints.hpp>
#include <sphmbs/io/durable_file.hpp>

#include "support/report.hpp"
#include "support/run_control.hpp"
#include "support/settings.hpp"

namespace sphmbs::examples {

/// A type as the source writes it.
std::string readable_type(const std::type_info& type);

/// The checkpoints of an example program, in the folder `checkpoint` of its results.
class SessionCheckpoints {
 public:
  /// @param identity  what the types of the system are, to which the parameters are added
  SessionCheckpoints(const Settings& settings, const std::string& program, io::Identity identity);

  /// Opens the checkpoint to go on from: the one that was asked for, or the newest one that is
  /// whole; those that are not are told of in warnings.
  /// @throws InvalidInput where there is none; RefusedCheckpoint for one that is damaged or belongs
  ///         to another run.
  std::unique_ptr<io::CheckpointFile> open(Report& report) const;

  /// Once the state is restored: checkpoints of another course of the run are set aside.
  void go_on_from(const io::CheckpointFile& file) const;

  /// For a run from the beginning: no earlier checkpoint may be taken for one of it.
  void forget_earlier() const;

  /// Saves the state that `show` shows to a StateWriter, behind the results that it goes on from,
  /// which are handed to the disk first. A failure is a warning.
  /// @return the file; empty where it could not be written
  /// @throws OutputError for the third failure in a row.
  template <class Show>
  std::filesystem::path save(std::int64_t step, Report& report, RunControl& control,
                             const std::set<std::filesystem::path>& results, const Show& show) {
    try {
      io::hand_to_disk(results);
      const auto path = checkpoints_.write(static_cast<std::uint64_t>(step), identity_, show);
      control.saved();
      return path;
    } catch (const OutputError& error) {
      if (control.failed()) throw;
      report.warn("checkpoint not written", error.what());
    } catch (const RefusedCheckpoint& error) {
      if (control.failed()) throw OutputError(error.what(), "E502");
      report.warn("checkpoint not written", error.what());
    }
    return {};
  }

  /// Saves the state in another folder. @throws OutputError, RefusedCheckpoint as io::Checkpoints.
  template <class Show>
  std::filesystem::path save_in(const std::filesystem::path& folder, std::int64_t step,
                                const Show& show) const {
    return io::Checkpoints(folder).write(static_cast<std::uint64_t>(step), identity_, show);
  }

 private:
  io::Checkpoints checkpoints_;
  std::filesystem::path asked_;
  io::Identity identity_;
};

}  // namespace sphmbs::examples
