// SPDX-License-Identifier: MIT
#include "support/parameters.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"
#include "support/guarded_main.hpp"
#include "support/output_folder.hpp"
#include "support/wedge.hpp"

namespace sphmbs::examples {
namespace {

namespace fs = std::filesystem;
using test::Run;

/// Gives up the rights of root, to whom no directory is closed.
class Unprivileged {
 public:
  Unprivileged() { change(was_root_ ? 65534 : ::geteuid()); }
  ~Unprivileged() { change(was_root_ ? 0 : ::geteuid()); }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;

 private:
  static void change(::uid_t user) { CHECK(::seteuid(user) == 0); }

  bool was_root_ = ::geteuid() == 0;
};

const std::string last_line = "1 error; nothing was written\n";

bool is_one_line(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

}  // namespace

TEST_CASE("without options the defaults of the program hold and nothing is created") {
  Run run;
  run.with({});
  REQUIRE(run.code == 0);
  REQUIRE(run.settings);
  CHECK(run.settings->spacing == 0.5);
  CHECK(run.settings->until == 2.0);
  CHECK_FALSE(run.settings->step);
  CHECK(run.settings->cfl == 0.4);
  CHECK(run.settings->threads == 3);
  CHECK(run.settings->backend == "openmp");
  CHECK(run.settings->output == run.scratch / "new" / "folder");
  CHECK_FALSE(run.settings->overwrite);
  CHECK_FALSE(run.settings->quiet);
  CHECK(run.out.empty());
  CHECK(run.err.empty());
  CHECK_FALSE(fs::exists(run.scratch / "new"));
}

TEST_CASE("every option reaches its variable") {
  Run run;
  const std::string output = (run.scratch / "out").string();
  run.with({"--spacing", "+2.5e-1", "--until=4", "--step",   "1e-3",        "--threads", "7",
            "--backend", "openmp",  "--output",  output,     "--overwrite", "--quiet",   "--mach",
            "5",         "--order", "1",         "--kernel", "wendland",    "--viscous"});
  REQUIRE(run.err == "");
  CHECK(run.settings->spacing == 0.25);
  CHECK(run.settings->until == 4.0);
  CHECK(run.settings->step == 1e-3);
  CHECK(run.settings->threads == 7);
  CHECK(run.settings->output == output);
  CHECK(run.settings->overwrite);
  CHECK(run.settings->quiet);
  CHECK(run.mach == 5.0);
  CHECK(run.order == 1);
  CHECK(run.kernel == "wendland");
  CHECK(run.viscous);
}

TEST_CASE("the serial back end has one thread") {
  CHECK(Run().with({"--backend", "serial"}).settings->threads == 1);
  CHECK(Run().with({"--backend", "serial", "--threads", "1"}).settings->threads == 1);
  CHECK(Run().with({"--backend", "serial", "--threads", "2"}).err ==
        "command line: error E023 --threads 2: must be 1 with --backend serial\n" + last_line);
}

TEST_CASE("every bad option gives one line, exit code 2 and no result", "[examples][fault]") {
  struct Case {
    std::vector<std::string> words;
    std::string message;
  };
  const std::string metres = "must be a positive number of metres";
  const std::string seconds = "must be a positive number of seconds";
  const std::string courant = "must be a positive number, at most 1";
  const std::string threads = "must be a whole number from 1 to 4096";
  const std::vector<Case> cases{
      {{"--spacng", "1"}, "E010 --spacng: is not an option; did you mean --spacing?"},
      {{"--spacng=1"}, "E010 --spacng: is not an option; did you mean --spacing?"},
      {{"-spacing", "1"}, "E010 -spacing: is not an option; did you mean --spacing?"},
      {{"--machs", "1"}, "E010 --machs: is not an option; did you mean --mach?"},
      {{"-q"}, "E010 -q: is not an option; did you mean --quiet?"},
      {{"--frobnicate"}, "E010 --frobnicate: is not an option; --help lists all"},
      {{"--"}, "E010 --: is not an option; --help lists all"},
      {{"--spacing"}, "E011 --spacing: needs a value; it " + metres},
      {{"--spacing="}, "E011 --spacing: needs a value; it " + metres},
      {{"--spacing", ""}, "E011 --spacing: needs a value; it " + metres},
      {{"--spacing", "--quiet"}, "E011 --spacing: needs a value; it " + metres},
      {{"--spacing", "1", "--spacing", "2"}, "E013 --spacing: is given more than once"},
      {{"--quiet=no"}, "E012 --quiet: takes no value"},
      {{"--spacing", "abc"}, "E024 --spacing abc: " + metres},
      {{"--spacing", "0.5m"}, "E024 --spacing 0.5m: " + metres},
      {{"--spacing", "0,5"}, "E024 --spacing 0,5: " + metres},
      {{"--spacing", "+-1"}, "E024 --spacing +-1: " + metres},
      {{"--spacing", "1\n2"}, "E024 --spacing 1 2: " + metres},
      {{"--spacing", "nan"}, "E025 --spacing nan: " + metres + ", finite"},
      {{"--spacing", "inf"}, "E025 --spacing inf: " + metres + ", finite"},
      {{"--spacing", "1e999"}, "E025 --spacing 1e999: " + metres + ", finite"},
      {{"--spacing", "0"},
       "E022 --spacing 0: " + metres + std::string(" (distance of neighbouring particles)")},
      {{"--spacing", "-1"},
       "E022 --spacing -1: " + metres + std::string(" (distance of neighbouring particles)")},
      {{"--spacing=-1"},
       "E022 --spacing -1: " + metres + std::string(" (distance of neighbouring particles)")},
      {{"--until", "0"},
       "E022 --until 0: " + seconds + std::string(" (physical time at which the run ends)")},
      {{"--until", "-2"},
       "E022 --until -2: " + seconds + std::string(" (physical time at which the run ends)")},
      {{"--until", "NaN"}, "E025 --until NaN: " + seconds + ", finite"},
      {{"--step", "0"}, "E022 --step 0: " + seconds + std::string(" (fixed time step)")},
      {{"--step", "-1e-3"}, "E022 --step -1e-3: " + seconds + std::string(" (fixed time step)")},
      {{"--step", "1e-3", "--cfl", "0.3"}, "E014 --step 1e-3: excludes --cfl; give one of them"},
      {{"--cfl", "0"},
       "E022 --cfl 0: " + courant +
           std::string(" (Courant number of the time step, excludes --step)")},
      {{"--cfl", "-0.1"},
       "E022 --cfl -0.1: " + courant +
           std::string(" (Courant number of the time step, excludes --step)")},
      {{"--cfl", "1.01"},
       "E022 --cfl 1.01: " + courant +
           std::string(" (Courant number of the time step, excludes --step)")},
      {{"--cfl", "inf"}, "E025 --cfl inf: " + courant + ", finite"},
      {{"--threads", "0"}, "E022 --threads 0: " + threads + std::string(" (number of threads)")},
      {{"--threads", "-1"}, "E022 --threads -1: " + threads + std::string(" (number of threads)")},
      {{"--threads", "4097"},
       "E022 --threads 4097: " + threads + std::string(" (number of threads)")},
      {{"--threads", "2.5"}, "E024 --threads 2.5: " + threads},
      {{"--threads", "99999999999999999999"}, "E024 --threads 99999999999999999999: " + threads},
      {{"--backend", "cuda"},
       "E022 --backend cuda: must be compiled into this program: openmp, serial; SPHMBS_OFFLOAD "
       "adds "
       "openacc, omp_target or cuda (docs/gpu.md)"},
      {{"--mach", "1"},
       "E022 --mach 1: must be above 1 and below 20" + std::string(" (inflow Mach number)")},
      {{"--mach", "20"},
       "E022 --mach 20: must be above 1 and below 20" + std::string(" (inflow Mach number)")},
      {{"--order", "0"},
       "E022 --order 0: must be a whole number, at least 1" +
           std::string(" (order of reconstruction)")},
      {{"--kernel", "cubic"}, "E022 --kernel cubic: must be one of quintic, wendland"},
      {{"--viscous=1x"}, "E012 --viscous: takes no value"},
  };
  for (const Case& bad : cases) {
    Run run;
    run.with(bad.words);
    CAPTURE(bad.words, run.err);
    CHECK(run.code == 2);
    CHECK(run.err == "command line: error " + bad.message + "\n" + last_line);
    CHECK_FALSE(run.settings);
    CHECK(run.out.empty());
    CHECK_FALSE(fs::exists(run.scratch / "new"));
  }
}

TEST_CASE("a refused command line changes no variable") {
  Run run;
  std::ofstream(run.scratch / "file") << "x";
  run.with({"--mach", "5", "--viscous", "--output", (run.scratch / "file").string()});
  CHECK(run.code == 2);
  CHECK(run.mach == 3.0);
  CHECK_FALSE(run.viscous);
}

TEST_CASE("the output directory is checked and nothing in it is touched", "[examples][fault]") {
  Run run;
  const auto message = [&run](const fs::path& output, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--output", output.string()});
    run.with(more);
    CAPTURE(run.err);
    CHECK(run.code == (run.err.empty() ? 0 : 2));
    CHECK((run.err.empty() || run.err.ends_with("\n" + last_line)));
    return run.err.substr(0, run.err.find('\n') + 1);
  };
  const fs::path file = run.scratch / "file";
  std::ofstream(file) << "kept";
  const fs::path full = run.scratch / "full";
  fs::create_directory(full);
  std::ofstream(full / "foreign.txt") << "kept";
  const fs::path empty = run.scratch / "empty";
  fs::create_directory(empty);

  CHECK(message(empty).empty());
  CHECK(message(file) == "command line: error E030 --output " + file.string() +
                             ": must be a directory, but a file has this name\n");
  CHECK(message(file / "below") ==
        "command line: error E030 --output " + (file / "below").string() +
            ": must be a directory that can be created: " + file.string() +
            " is not a directory\n");
  CHECK(message(full) ==
        "command line: error E030 --output " + full.string() +
            ": must be new or empty; --overwrite replaces the files of the same names in it\n");
  CHECK(message(full, {"--overwrite"}).empty());
  CHECK_THAT(message(run.scratch / std::string(300, 'x')),
             Catch::Matchers::Contains("must be a directory that can be created: File name too"));
  CHECK(fs::exists(full / "foreign.txt"));

  fs::permissions(empty, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_exec |
                             fs::perms::others_exec);
  const Unprivileged unprivileged;
  CHECK(message(empty) == "command line: error E030 --output " + empty.string() +
                              ": must be a directory that can be written: Permission denied\n");
  CHECK(message(empty / "below") ==
        "command line: error E030 --output " + (empty / "below").string() +
            ": must be a directory that can be created: " + empty.string() +
            ": Permission denied\n");
}

TEST_CASE("prepare_output creates the directory once and keeps what is in it") {
  Run run;
  const Settings settings{.output = run.scratch / "a" / "b"};
  CHECK(prepare_output(settings));
  std::ofstream(settings.output / "foreign.txt") << "kept";
  CHECK_FALSE(prepare_output(settings));
  CHECK(fs::exists(settings.output / "foreign.txt"));
  std::ofstream(run.scratch / "file") << "x";
  CHECK_THROWS_AS(prepare_output({.output = run.scratch / "file" / "c"}), OutputError);
}

TEST_CASE("the help lists every option with unit, default and two examples") {
  Run run;
  run.with({"--spacing", "bad", "--help"});
  CHECK(run.code == 0);
  CHECK_FALSE(run.settings);
  for (const char* part : {"flow over a wedge",
                           "--help",
                           "--version",
                           "--spacing NUMBER [m]",
                           "(default 0.5)",
                           "--until NUMBER [s]",
                           "(default 2)",
                           "--step NUMBER [s]",
                           "--cfl",
                           "(default 0.4)",
                           "--threads",
                           "from 1 to 4096 (default 3)",
                           "--backend",
                           "openmp, serial",
                           "-o,--output,--out DIR",
                           "--overwrite",
                           "--quiet",
                           "--mach",
                           "above 1 and below 20 (default 3)",
                           "--order",
                           "--kernel",
                           "one of quintic, wendland (default quintic)",
                           "--viscous",
                           "wedge --spacing 0.25",
                           "wedge --threads 1",
                           "Exit codes"}) {
    CAPTURE(run.out);
    CHECK_THAT(run.out, Catch::Matchers::Contains(part));
  }
}

TEST_CASE("the version is one line with compiler, Eigen and back ends") {
  Run run;
  run.with({"--version"});
  CHECK(run.code == 0);
  CHECK(is_one_line(run.out));
  for (const char* part : {"wedge (sphmbs ", "Eigen 3.", "back ends openmp, serial"}) {
    CHECK_THAT(run.out, Catch::Matchers::Contains(part));
  }
}

TEST_CASE("a program checks its options against the problem by require") {
  Run run;
  run.with({}, [](const Settings& settings) {
    require(settings.until > 1.0, "--until", settings.until, "at most 1 s");
    require(settings.spacing < 0.2, "--spacing", settings.spacing, "below 0.2 m, half the radius");
  });
  CHECK(run.code == 2);
  CHECK(run.err == "default: error E023 run.spacing = 0.5: must be below 0.2 m, half the radius\n" +
                       last_line);
  CHECK_THROWS_AS(require(false, "--kernel", "cubic", "smooth"), InvalidInput);
}

TEST_CASE("guarded_main maps every exception to its exit code", "[examples][fault]") {
  const auto code = [](const std::function<void(const Settings&)>& body, const std::string& line) {
    Run run;
    run.with({}, body);
    CHECK(run.err == "error " + line + "\n");
    return run.code;
  };
  CHECK(code([](const Settings&) { throw InvalidInput("two\nlines"); }, "E100 two lines") == 2);
  CHECK(code([](const Settings&) { throw NumericalFailure("a", "E301"); }, "E301 a") == 3);
  CHECK(code([](const Settings&) { throw RefusedCheckpoint("d"); }, "E400 d") == 4);
  CHECK(code([](const Settings&) { throw OutputError("b"); }, "E500 b") == 5);
  CHECK(code([](const Settings&) { throw std::bad_alloc(); },
             "E090 out of memory; a larger --spacing means fewer particles") == 6);
  CHECK(code([](const Settings&) { throw std::logic_error("c"); }, "E099 c") == 1);
  CHECK(code([](const Settings&) { throw 1; }, "E099 unknown exception") == 1);
}

TEST_CASE("a program with a default that no user could give is refused") {
  const auto build = [](Settings defaults) {
    Parameters({.name = "x", .backends = {"serial"}, .defaults = std::move(defaults)});
  };
  CHECK_NOTHROW(build({.spacing = 1.0, .until = 1.0}));
  CHECK_THROWS_AS(build({.spacing = 0.0, .until = 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(build({.spacing = 1.0, .until = 1.0, .cfl = 1.5}), std::invalid_argument);
  CHECK_THROWS_AS(build({.spacing = 1.0, .until = 1.0, .backend = "cuda"}), std::invalid_argument);
}

}  // namespace sphmbs::examples
