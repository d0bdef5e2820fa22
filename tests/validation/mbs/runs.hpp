// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"
#include "support/program.hpp"

namespace test {

/// What a run of a structure left on disk.
struct StructureRun {
  Table traces;
  Table history;
  nlohmann::ordered_json summary;
  Ended ended;
};

/// A whole run on one thread, whose energy does not grow: the sum of all energies, less the work
/// done, stays below its start up to a share of the largest kinetic energy, which is the error that
/// Newton's method leaves.
inline StructureRun run_structure(const char* program, std::vector<std::string> words) {
  const Scratch scratch;
  words.insert(words.end(), {"--threads", "1", "--quiet", "--output", "run"});
  StructureRun run;
  run.ended = start(scratch, program, words);
  CAPTURE(run.ended.err);
  REQUIRE(run.ended.code == 0);
  const auto folder = scratch.work() / "run";
  run.traces = table_of(folder / "trajectories.csv");
  run.history = table_of(folder / "history.csv");
  run.summary = summary_of(folder);

  const auto total = run.history.column("total[J]"), kinetic = run.history.column("kinetic[J]");
  const double largest = *std::max_element(kinetic.begin(), kinetic.end());
  for (const double e : total) CHECK(e - total.front() <= 1e-6 * largest);
  CHECK(run.summary["structure"]["violation"].get<double>() <= 1e-9);
  return run;
}

/// Rows of trajectories.csv are at every multiple of 5 ms, and at no other time but the end.
inline void check_times(const Table& traces, double until) {
  const auto time = traces.column("t[s]");
  REQUIRE(time.size() >= 2);
  for (std::size_t k = 0; k + 1 < time.size(); ++k)
    CHECK(time[k] == Approx(5e-3 * static_cast<double>(k)).margin(1e-12));
  CHECK(time.back() == Approx(until).margin(1e-12));
  CHECK(time[time.size() - 1] - time[time.size() - 2] <= 5e-3 + 1e-12);
}

/// Largest distance between a column of the trajectories and a member of the reference's rows, at
/// the times of these up to `until`.
template <class Rows, class Row>
double largest_difference(const Table& traces, std::string_view column, const Rows& rows,
                          double Row::*member, double until) {
  const auto time = traces.column("t[s]"), value = traces.column(column);
  double largest = 0;
  for (const Row& row : rows) {
    if (row.t > until + 1e-9) break;
    std::size_t k = 0;
    while (k < time.size() && std::abs(time[k] - row.t) > 1e-9) ++k;
    REQUIRE(k < time.size());
    largest = std::max(largest, std::abs(value[k] - row.*member));
  }
  return largest;
}

/// Largest distance between a column of two runs, at the rows that both have, up to `until`.
inline double largest_difference(const Table& a, const Table& b, std::string_view column,
                                 double until) {
  const auto time = a.column("t[s]"), x = a.column(column), y = b.column(column);
  double largest = 0;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()) && time[k] <= until + 1e-9; ++k)
    largest = std::max(largest, std::abs(x[k] - y[k]));
  return largest;
}

}  // namespace test
