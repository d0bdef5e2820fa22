// SPDX-License-Identifier: MIT
#include "support/report.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "support/catch.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

/// A report on strings, with a clock that only moves when it is told to.
struct Console {
  double now = 100.0;
  std::ostringstream out{};
  std::ostringstream err{};
  Report report;

  explicit Console(ReportStyle style)
      : report(out, err,
               (
                   style.clock = [this] { return now; }, style)) {}

  /// Ten thousand steps of dt = 1e-4 s, each of which takes `seconds`.
  void march(double seconds) {
    for (int step = 0; step <= 10'000; ++step) {
      report.progress({.step = step,
                       .time = step / 10'000.0,
                       .time_step = 1e-4,
                       .until = 1.0,
                       .limited_by = "acoustic",
                       .pair_interactions = std::int64_t{step} * 1'000'000});
      now += seconds;
    }
  }
};

std::ptrdiff_t count_of(const std::string& text, char c) {
  return std::count(text.begin(), text.end(), c);
}

Summary example() {
  return {.case_name = "gas_cylinder",
          .steps = 1000,
          .time_end = 1.0,
          .wall_seconds = 12.3,
          .phases = {{"neighbours", 2.214}, {"rates", 8.61}},
          .pair_interactions = 1'230'000'000,
          .peak_memory_bytes = 9'437'184,
          .conservation = {.mass = 0.0, .momentum = 3e-13, .energy = 2.1e-6},
          .results = {{"drag coefficient", 1.236, 1.2, "-"},
                      {"shift", 0.5, 0.0, "m"},
                      {"temperature", 300.0, {}, "K"}}};
}

}  // namespace

TEST_CASE("the banner has the version, the title and aligned lines") {
  Console console({});
  console.report.banner("airflow around a circular cylinder",
                        {{"case", "gas_cylinder", "results/gas_cylinder (new)"},
                         {"gas", "2D, γ 1.4", "quintic spline"},
                         {"run", "to 1 s"}});
  CHECK(console.out.str() ==
        "sphmbs " + std::string(version) +
            "  airflow around a circular cylinder\n"
            "case      gas_cylinder                                          "
            "results/gas_cylinder (new)\n"
            "gas       2D, γ 1.4                                             quintic spline\n"
            "run       to 1 s\n\n");
}

TEST_CASE("a fast run has a line in the log at each 10 %") {
  Console console({});
  console.march(1e-5);
  const std::string log = console.out.str();
  CAPTURE(log);
  CHECK(count_of(log, '\n') == 1 + 11);
  CHECK(count_of(log, '\r') == 0);
  CHECK_THAT(log, Catch::Matchers::StartsWith(
                      "    step       t [s]      dt [s]  limited by            Mpair/s     ETA\n"));
  CHECK_THAT(log, Catch::Matchers::Contains(
                      "   5 000         0.5      0.0001  acoustic                1e+05    0:00\n"));
}

TEST_CASE("a slow run has a line in the log at most every five seconds, and the heading again") {
  Console console({});
  console.march(0.1);
  const auto lines = count_of(console.out.str(), '\n');
  CHECK(lines >= 200);
  CHECK(lines <= 220);
  CHECK_THAT(console.out.str(),
             Catch::Matchers::Contains(
                 "   5 000         0.5      0.0001  acoustic                   10    8:20\n"));
}

TEST_CASE("a terminal has one line that is updated ten times per second and fits") {
  Console console({.terminal = true, .width = 60});
  console.march(1e-3);
  const std::string text = console.out.str();
  CHECK(count_of(text, '\n') == 0);
  CHECK(count_of(text, '\r') <= 112);
  CHECK_THAT(text,
             Catch::Matchers::Contains("[############............]  50 %  step 5 000  t 0.5"));
  std::istringstream updates(text);
  for (std::string update; std::getline(updates, update, '\r');) {
    CHECK(update.size() < 60 + std::string("\x1b[K").size());
  }
}

TEST_CASE("the line on a terminal shows time step, limit and remaining time") {
  Console console({.terminal = true, .width = 120});
  console.march(1e-3);
  CHECK_THAT(console.out.str(),
             Catch::Matchers::Contains("t 0.5 s  dt 0.0001 s (acoustic)  ETA 0:05"));
}

TEST_CASE("a quiet report prints warnings only") {
  Console console({.quiet = true});
  console.report.banner("title", {{"case", "x"}});
  console.march(1.0);
  console.report.warn("floor", "pressure below 1 Pa");
  console.report.finish(example(), {"a"});
  CHECK(console.out.str().empty());
  CHECK(console.err.str() == "warning: floor: pressure below 1 Pa\n");
}

TEST_CASE("a warning is printed once and counted at the end") {
  Console console({.terminal = true});
  console.report.progress({.step = 1, .time = 0.1, .time_step = 0.1, .until = 1.0});
  for (int i = 0; i < 3; ++i) console.report.warn("floor", "pressure below 1 Pa");
  console.report.warn("retry", "step 7");
  CHECK(console.err.str() == "warning: floor: pressure below 1 Pa\nwarning: retry: step 7\n");
  console.report.finish(example(), {});
  CHECK_THAT(console.out.str(),
             Catch::Matchers::Contains("warning   floor: 3 times\nwarning   retry: 1 time\n"));
}

TEST_CASE("the closing block has times, memory, conservation, results and files") {
  Console console({});
  console.report.finish(example(), {"results/gas_cylinder/summary.json", "results/a.svg"});
  CHECK(console.out.str() ==
        "\n"
        "done      1 000 steps, t = 1 s in 12.3 s\n"
        "phases    neighbours 2.21 s (18 %) | rates 8.61 s (70 %) | other 1.48 s (12 %)\n"
        "pairs     1.23e+09 interactions, 100 million/s                  peak memory 9.0 MiB\n"
        "conserved mass 0 | momentum 3e-13 | energy 2.1e-06              (relative change)\n"
        "incidents 0 particles lost, 0 steps tried again, 0 reconstructions refused\n"
        "results                         computed     reference  unit   difference\n"
        "          drag coefficient         1.236           1.2  -         +3.00 %\n"
        "          shift                      0.5             0  m            +0.5\n"
        "          temperature                300             -  K               -\n"
        "wrote     results/gas_cylinder/summary.json\n"
        "          results/a.svg\n");
}

TEST_CASE("numbers are printed for reading") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(format_exact(0.1) == "0.1");
  CHECK(format_number(0.31284) == "0.3128");
  CHECK(format_count(0) == "0");
  CHECK(format_count(999) == "999");
  CHECK(format_count(18681) == "18 681");
  CHECK(format_count(-1234567) == "-1 234 567");
  CHECK(format_bytes(470) == "470 B");
  CHECK(format_bytes(9'437'184) == "9.0 MiB");
  CHECK(format_bytes(96ULL << 20) == "96 MiB");
  CHECK(format_duration(0.5) == "0.50 s");
  CHECK(format_duration(12.34) == "12.3 s");
  CHECK(format_duration(59.97) == "1 min 00 s");
  CHECK(format_duration(362.0) == "6 min 02 s");
  CHECK(format_duration(3900.0) == "1 h 05 min");
  CHECK(format_duration(nan) == "unknown");
  CHECK(format_clock(12.0) == "0:12");
  CHECK(format_clock(3900.0) == "1:05:00");
  CHECK(format_clock(nan) == "-");
  CHECK(format_clock(1e9) == "-");
  CHECK(padded("γ", 3) == "γ  ");
  CHECK(one_line("a\nb\tc") == "a b c");
}

}  // namespace sphmbs::examples
