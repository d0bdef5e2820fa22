// SPDX-License-Identifier: MIT
// Parameter files: what they set, what of them is refused, and how.
#include "support/parameters.hpp"

#include <algorithm>
#include <filesystem>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "support/catch.hpp"
#include "support/suggestion.hpp"
#include "support/wedge.hpp"

namespace sphmbs::examples {
namespace {

namespace fs = std::filesystem;
using test::Run;

const std::string whole_file = R"(# a case
[run]
spacing = 0.25   # [m]
until = 3
cfl = 0.2
threads = 2
backend = "openmp"
walltime = "1h30m"
checkpoint_every = 90
plots = false
fields = 7
samples = 11

[gas]
gamma = 1.3
viscous = true

[scheme]
kernel = "wendland"

[wedge]
corner = [0.5, 3]

[[probes]]
name = "tip"
at = [1, 2]
fields = ["p", "mach"]

[[probes]]
name = "wake"
kind = "line"
from = [0, 0]
to = [4.0, 0.0]
points = 20
interval = 1e-3
)";

/// What the wedge says of the text of a file, with the file called case.toml.
std::string complaints_about(const std::string& text) {
  Run run;
  try {
    run.line.parse_text(text, "case.toml");
    return "";
  } catch (const BadParameters& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a parameter file sets everything") {
  Run run;
  run.with({run.file(whole_file)});
  REQUIRE(run.err == "");
  const Settings& s = *run.settings;
  CHECK(s.spacing == 0.25);
  CHECK(s.until == 3);
  CHECK(s.cfl == 0.2);
  CHECK_FALSE(s.step);
  CHECK(s.threads == 2);
  CHECK(s.walltime == 5400);
  CHECK(s.checkpoint_every == 90);
  CHECK_FALSE(s.plots);
  CHECK(s.fields == 7);
  CHECK(s.samples == 11);
  CHECK(run.gamma == 1.3);
  CHECK(run.viscous);
  CHECK(run.kernel == "wendland");
  CHECK(run.corner == Vec<2>{0.5, 3});
  CHECK(run.mach == 3);
  REQUIRE(s.probes.size() == 2);
  CHECK(s.probes[0].name == "tip");
  CHECK(s.probes[0].kind == "point");
  CHECK(s.probes[0].at == std::vector<double>{1, 2});
  CHECK(s.probes[0].fields == std::vector<std::string>{"p", "mach"});
  CHECK(s.probes[0].interval == 0);
  CHECK(s.probes[1].from == std::vector<double>{0, 0});
  CHECK(s.probes[1].to == std::vector<double>{4, 0});
  CHECK(s.probes[1].points == 20);
  CHECK(s.probes[1].interval == 1e-3);
}

TEST_CASE("the command line precedes the file and the file the defaults") {
  Run run;
  const std::string file = run.file("[run]\nuntil = 3\nspacing = 0.1\n[gas]\ngamma = 1.2\n");
  run.with({"--until", "4", file, "--set", "gas.gamma=1.6", "--set", "wedge.corner=[7, 8]"});
  REQUIRE(run.err == "");
  CHECK(run.settings->until == 4);
  CHECK(run.settings->spacing == 0.1);
  CHECK(run.settings->cfl == 0.4);
  CHECK(run.gamma == 1.6);
  CHECK(run.corner == Vec<2>{7, 8});
  // An empty file has the defaults.
  Run empty;
  empty.with({empty.file("")});
  CHECK(empty.err == "");
  CHECK(empty.settings->until == 2);
}

TEST_CASE("a step and a Courant number exclude each other in one place, and the later one holds") {
  Run run;
  run.with({run.file("run.step = 1e-3"), "--cfl", "0.1"});
  CHECK(run.err == "");
  CHECK_FALSE(run.settings->step);
  CHECK(run.settings->cfl == 0.1);
  run.with({run.file("run.cfl = 0.1"), "--step", "1e-3"});
  CHECK(run.settings->step == 1e-3);
  CHECK(complaints_about("run.cfl = 0.1\nrun.step = 1e-3") ==
        "case.toml:2:12: error E014 run.step = 0.001: excludes run.cfl; give one of them\n"
        "1 error; nothing was written");
}

TEST_CASE("options of the run reach the settings") {
  Run run;
  const std::string out = (run.scratch / "out").string();
  run.with({"--check", "-t", "5", "-o", out, "--steps", "12", "--walltime", "1h30m",
            "--checkpoint-every=10m", "--no-plots", "--resume"});
  REQUIRE(run.err == "");
  CHECK(run.settings->check);
  CHECK(run.settings->threads == 5);
  CHECK(run.settings->output == out);
  CHECK(run.settings->steps == 12);
  CHECK(run.settings->walltime == 5400);
  CHECK(run.settings->checkpoint_every == 600);
  CHECK_FALSE(run.settings->plots);
  CHECK(run.settings->resume == fs::path());
  // A parameter file after --resume is no checkpoint.
  run.with({"--resume", run.file("run.until = 9"), "--out", out});
  REQUIRE(run.err == "");
  CHECK(run.settings->resume == fs::path());
  CHECK(run.settings->until == 9);
  run.with({"--resume", "some.ckpt"});
  CHECK(run.settings->resume == fs::path("some.ckpt"));
}

TEST_CASE("to resume needs no empty directory") {
  Run run;
  const std::string out = (run.scratch / "full").string();
  fs::create_directory(out);
  std::ofstream(fs::path(out) / "old") << "x";
  CHECK(run.with({"--output", out}).code == 2);
  CHECK(run.with({"--output", out, "--resume"}).code == 0);
}

TEST_CASE("a text that a run was dumped to gives the same dump") {
  for (const std::string& text : {std::string(), whole_file, std::string("run.step = 1e-5"),
                                  std::string("run.backend = \"serial\"")}) {
    Run first, second;
    first.with({first.file(text), "--dump-params"});
    REQUIRE(first.err == "");
    CHECK_FALSE(first.settings);
    second.with({second.file(first.out), "--dump-params"});
    CAPTURE(first.out);
    CHECK(second.err == "");
    CHECK(second.out == first.out);
    for (const char* part : {"[run]\n", "[m] place of the wedge's corner", "# steps is not set",
                             "gamma = 1.", "ratio of specific heats; above 1"})
      CHECK_THAT(first.out, Catch::Matchers::Contains(part));
  }
}

TEST_CASE("the list has key, type, unit, default, range and meaning") {
  Run run;
  run.with({"--list-params", "--nonsense"});
  CHECK(run.code == 0);
  for (const char* part :
       {"gas.gamma", "number", "above 1", "ratio of specific heats", "scheme.kernel",
        "quintic, wendland", "2 numbers", "run.until", "--until", "[[probes]]"})
    CHECK_THAT(run.out, Catch::Matchers::Contains(part));
}

TEST_CASE("every bad line of a file gives one line with its place", "[examples][fault]") {
  struct Case {
    std::string text;
    std::string message;
  };
  const std::string seconds = "must be a positive number of seconds";
  const std::string probe = "[[probes]]\nname = \"a\"\nat = [1, 2]\n";
  const std::vector<Case> cases{
      {"a = ", "1:5: error E003 Error while parsing key-value pair: encountered end-of-file"},
      {"[run]\nuntil = 1\nuntil = 2",
       "3:9: error E004 Error while parsing key-value pair: cannot redefine existing integer "
       "'until'"},
      {"[gsa]\ngamma = 2", "1:2: error E020 gsa: unknown table; did you mean \"gas\"?"},
      {"[nothing.like.it]\nx = 2",
       "1:2: error E020 nothing: unknown table; --list-params shows all"},
      {"[run]\n\ncfll = 0.2", "3:1: error E021 run.cfll: unknown key; did you mean \"run.cfl\"?"},
      {"cfl = 0.2", "1:1: error E021 cfl: unknown key; did you mean \"run.cfl\"?"},
      {"\"run.cfl\" = 0.2", "1:1: error E021 run.cfl: unknown key; did you mean \"run.cfl\"?"},
      {"run.zzzzzz = 0.2", "1:5: error E021 run.zzzzzz: unknown key; --list-params shows all"},
      {"[gas]\n  gamma = 0.9",
       "2:11: error E022 gas.gamma = 0.9: must be above 1 (ratio of specific heats)"},
      {"run = 3", "1:7: error E024 run = 3: must be a table, [run]"},
      {"[run.until]\nx = 1", "1:1: error E024 run.until = {...}: " + seconds},
      {"run.until = \"2\"", "1:13: error E024 run.until = \"2\": " + seconds},
      {"run.until = true", "1:13: error E024 run.until = true: " + seconds},
      {"run.until = 1979-05-27", "1:13: error E024 run.until = (date or time): " + seconds},
      {"run.threads = 2.0",
       "1:15: error E024 run.threads = 2: must be a whole number from 1 to 4096"},
      {"wedge.corner = [1, 2, 3]",
       "1:16: error E024 wedge.corner = [1, 2, 3]: must be a list of 2 numbers [m], each at least "
       "0"},
      {"wedge.corner = [1, \"b\"]",
       "1:16: error E024 wedge.corner = [1, \"b\"]: must be a list of 2 numbers [m], each at least "
       "0"},
      {"wedge.corner = [1, -2]",
       "1:16: error E022 wedge.corner = [1, -2]: must be a list of 2 numbers [m], each at least 0 "
       "(place of the wedge's corner)"},
      {"wedge.corner = [1, inf]",
       "1:16: error E025 wedge.corner = [1, inf]: must be a list of 2 numbers [m], each at least "
       "0, finite"},
      {"run.until = nan", "1:13: error E025 run.until = nan: " + seconds + ", finite"},
      {"run.until = -inf", "1:13: error E025 run.until = -inf: " + seconds + ", finite"},
      {"run.threads = 9223372036854775808",
       "1:34: error E003 Error while parsing decimal integer: '9223372036854775808' is not "
       "representable in 64 bits"},
      {"run.until = 0",
       "1:13: error E022 run.until = 0: " + seconds + " (physical time at which the run ends)"},
      {"run.cfl = 1.5",
       "1:11: error E022 run.cfl = 1.5: must be a positive number, at most 1 (Courant number of "
       "the time step, excludes --step)"},
      {"run.spacing = -0.1",
       "1:15: error E022 run.spacing = -0.1: must be a positive number of metres (distance of "
       "neighbouring particles)"},
      {"run.fields = 0",
       "1:14: error E022 run.fields = 0: must be a whole number from 1 to 1e+06 (how often fields "
       "are written until the end)"},
      {"run.walltime = \"soon\"",
       "1:16: error E024 run.walltime = \"soon\": " + seconds + ", or a text such as 1h30m"},
      {"scheme.kernel = \"cubic\"",
       "1:17: error E022 scheme.kernel = \"cubic\": must be one of quintic, wendland"},
      {"run.backend = \"cuda\"",
       "1:15: error E022 run.backend = \"cuda\": must be compiled into this program: openmp, "
       "serial; SPHMBS_OFFLOAD adds openacc, omp_target or cuda (docs/gpu.md)"},
      {"gas.viscous = 1", "1:15: error E024 gas.viscous = 1: must be true or false"},
      {"probes = 3", "1:10: error E026 probes: must be tables, each under a line [[probes]]"},
      {probe + probe,
       "4:1: error E026 probes[2].name = \"a\": must be unique, another probe has it"},
      {"[[probes]]\nat = [1, 2]", "1:1: error E026 probes[1].name: is missing"},
      {"[[probes]]\nname = \"a/b\"\nat = [1, 2]",
       "2:8: error E026 probes[1].name = \"a/b\": must be a text of letters, digits, - and _, at "
       "most 64"},
      {"[[probes]]\nname = \"a\"", "1:1: error E026 probes[1].at: is missing"},
      {"[[probes]]\nname = \"a\"\nat = [1, 2, 3]",
       "3:6: error E026 probes[1].at = [1, 2, 3]: must be a list of 2 numbers [m], one for each "
       "dimension"},
      {probe + "kind = \"disk\"",
       "4:8: error E026 probes[1].kind = \"disk\": must be one of point, line, plane, volume"},
      {probe + "fields = [\"p\", \"q\"]",
       "4:10: error E026 probes[1].fields = [\"p\", \"q\"]: must be a list of some of p, rho, e, "
       "v, speed, c, T, mach"},
      {probe + "interval = -1",
       "4:12: error E026 probes[1].interval = -1: must be a number of seconds, at least 0"},
      {probe + "point = 3",
       "4:1: error E021 probes[1].point: unknown key; did you mean \"points\"?"},
      {probe + "to = [1, 2]",
       "4:6: error E026 probes[1].to = [1, 2]: must be left out: a point has at"},
      {"[[probes]]\nname = \"a\"\nkind = \"line\"\nfrom = [1, 1]\nto = [1, 1]",
       "5:6: error E026 probes[1].to = [1, 1]: must be another place than \"from\""},
      {"[[probes]]\nname = \"a\"\nkind = \"plane\"\nfrom = [1, 1]\nto = [1, 2]",
       "5:6: error E026 probes[1].to = [1, 2]: must differ from \"from\" in both coordinates"},
  };
  for (const Case& bad : cases) {
    CAPTURE(bad.text);
    CHECK(complaints_about(bad.text) ==
          "case.toml:" + bad.message + "\n1 error; nothing was written");
  }
}

TEST_CASE("a file that cannot be read is refused", "[examples][fault]") {
  const auto message = [](Run& run, const std::string& file) {
    run.with({file});
    CHECK(run.code == 2);
    CHECK_FALSE(run.settings);
    return run.err;
  };
  Run run;
  const std::string last = "\n1 error; nothing was written\n";
  const std::string missing = (run.scratch / "missing.toml").string();
  CHECK(message(run, missing) ==
        missing + ": error E001 cannot read: No such file or directory" + last);
  run.with({missing, "other.toml"});
  CHECK(run.err == missing +
                       ": error E001 cannot read: No such file or directory\n"
                       "command line: error E010 other.toml: is not an option, and a "
                       "parameter file was named before: " +
                       missing + "\n2 errors; nothing was written\n");
  const std::string folder = run.scratch.path().string();
  CHECK(message(run, folder) ==
        folder + ": error E001 cannot read: is a directory, not a parameter file" + last);
  const std::string binary = run.file(std::string("a = 1\0b", 7), "binary");
  CHECK(message(run, binary) ==
        binary + ": error E002 holds bytes that are no text: no parameter file" + last);
  const std::string large = run.file(std::string(2 << 20, '#'), "large");
  CHECK(message(run, large) ==
        large + ": error E001 is larger than 1 MiB: no parameter file" + last);
}

TEST_CASE("all mistakes are listed at once, those of the file by line", "[examples][fault]") {
  Run run;
  const std::string file = run.file(
      "[wedge]\ncorner = 3\n[run]\nuntil = -1\ncfll = 1\n[[probes]]\nname = \"a\"\n[gas]\n"
      "gamma = \"x\"\n");
  run.with({"--threads", "0", file, "--kernel=cubic", "--set", "gas.gama=2", "--spacng", "4"});
  CHECK(run.code == 2);
  CHECK(run.mach == 3);
  std::vector<std::string> starts;
  std::istringstream lines(run.err);
  for (std::string line; std::getline(lines, line);)
    starts.push_back(line.substr(0, line.find(" error") + 11));
  CHECK(starts == std::vector<std::string>{file + ":2:10: error E024", file + ":4:9: error E022",
                                           file + ":5:1: error E021", file + ":6:1: error E026",
                                           file + ":9:9: error E024", "command line: error E021",
                                           "command line: error E010", "command line: error E022",
                                           "command line: error E022", "9 errors; no"});
  CHECK(run.err.ends_with("\n9 errors; nothing was written\n"));
  CHECK_FALSE(fs::exists(run.scratch / "new"));
}

TEST_CASE("require says where the value came from") {
  Run run;
  const auto check = [&run](const Settings& settings) {
    require(settings.spacing < 0.2, "--spacing", settings.spacing, "below 0.2 m");
    require(run.gamma < 2, "gas.gamma", run.gamma, "below 2");
  };
  const std::string last = "\n1 error; nothing was written\n";
  run.with({"--set", "gas.gamma=3", "--spacing=0.1"}, check);
  CHECK(run.err == "command line: error E023 gas.gamma = 3: must be below 2" + last);
  run.with({"--spacing", "0.3"}, check);
  CHECK(run.err == "command line: error E023 --spacing 0.3: must be below 0.2 m" + last);
  const std::string file = run.file("[run]\nspacing = 0.3\n");
  run.with({file}, check);
  CHECK(run.err == file + ":2:11: error E023 run.spacing = 0.3: must be below 0.2 m" + last);
}

TEST_CASE("mutated parameter files are read or refused, whatever they hold", "[examples][fault]") {
  std::mt19937 random(20240607);
  const auto any = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::string alphabet = "[]{}=.,\"'#\\\n\t +-_0123456789eEinfatrul\xc3\xa9";
  Run run;
  int accepted = 0, refused = 0;
  for (int k = 0; k < 10000; ++k) {
    std::string text = whole_file;
    for (std::size_t changes = 1 + any(4); changes > 0; --changes) {
      const std::size_t at = any(text.size());
      const char letter =
          any(8) == 0 ? static_cast<char>(any(256)) : alphabet[any(alphabet.size())];
      switch (any(4)) {
        case 0:
          text[at] = letter;
          break;
        case 1:
          text.insert(at, 1, letter);
          break;
        case 2:
          text.erase(at, 1 + any(10));
          break;
        default:
          text.insert(at, text.substr(any(text.size()), any(40)));
      }
    }
    try {
      run.line.parse_text(text, "case.toml");
      ++accepted;
    } catch (const BadParameters& error) {
      const std::string message = error.what();
      REQUIRE_THAT(message, Catch::Matchers::StartsWith("case.toml:"));
      ++refused;
    }
  }
  CHECK(accepted > 100);
  CHECK(refused > 500);
}

TEST_CASE("a key or an option that is taken cannot be added") {
  Run run;
  double x = 1;
  CHECK_THROWS_AS(run.line.add_number("gas.gamma", x, {}, "", "again"), std::invalid_argument);
  CHECK_THROWS_AS(run.line.add_number("gas.delta", x, {}, "", "again", "--mach"),
                  std::invalid_argument);
}

TEST_CASE("names are suggested that were likely meant") {
  const std::vector<std::string> names{"run.cfl", "run.until", "gas.gamma"};
  CHECK(nearest_key("run.untl", names) == "run.until");
  CHECK(nearest_key("gamma", names) == "gas.gamma");
  CHECK(nearest_key("gas.gmama", names) == "gas.gamma");
  CHECK(nearest_key("else", names).empty());
  CHECK(nearest_name(std::string(100000, 'a'), names).empty());
}

TEST_CASE("a run writes what it used and keeps others out of its directory", "[examples][fault]") {
  Run run;
  const fs::path out = run.scratch / "out";
  const std::string text = out.string();
  const auto work = [&](const Settings& settings) {
    CHECK(prepare_output(settings));
    write_used(settings);
    CHECK(fs::exists(out / ".lock"));
    std::ostringstream used;
    used << std::ifstream(out / "used.toml").rdbuf();
    CHECK(used.str() == settings.used);
    Run other;
    const std::string owner = "is in use by process " + std::to_string(::getpid()) + " on ";
    other.with({"--output", text, "--overwrite"});
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Matchers::Contains("E030 --output " + text + ": " + owner));
    // One that was let in before the first one had begun.
    Settings late = settings;
    late.lock = std::make_shared<OutputLock>();
    CHECK_THROWS_WITH(prepare_output(late), Catch::Matchers::Contains(owner));
    CHECK_FALSE(prepare_output(settings));
  };
  run.with({"--output", text}, work);
  CHECK(run.err == "");
  CHECK(run.code == 0);
  run.settings.reset();
  CHECK_FALSE(fs::exists(out / ".lock"));
  CHECK(fs::exists(out / "used.toml"));
}

TEST_CASE("all conditions that do not hold are told of at once, each where it was given") {
  Run run;
  const std::string file = run.file("[wedge]\ncorner = [0.5, 3]\n\n[run]\nuntil = 3\n");
  run.with({file, "--spacing", "0.25"}, [](const Settings& settings) {
    require_all({{settings.spacing > 1, "--spacing", settings.spacing, "above 1 m"},
                 {true, "gas.gamma", 1.4, "anything"},
                 {settings.until < 2, "run.until", settings.until, "below 2 s"},
                 {settings.until < 2, "run.until", settings.until, "below 2 s"}});
  });
  CHECK(run.code == 2);
  CHECK(run.err == file + ":5:9: error E023 run.until = 3: must be below 2 s\n" +
                       "command line: error E023 --spacing 0.25: must be above 1 m\n"
                       "2 errors; nothing was written\n");
  run.with({}, [](const Settings&) { require_all({{true, "gas.gamma", 1.4, "anything"}}); });
  CHECK(run.code == 0);
}

TEST_CASE("what is in a file that a parameter names belongs to a run") {
  const Run scratch;
  const fs::path path = scratch.scratch / "shape.txt";
  const auto content = [&](const std::string& text) {
    std::ofstream(path) << text;
    Run run;
    std::string file = path.string();
    run.line.add_path("shape.file", file, "of a shape");
    std::string found;
    run.with({"--output", (scratch.scratch / "out").string()},
             [&](const Settings& settings) { found = settings.contents.at("shape.file"); });
    return found;
  };
  const std::string first = content("0 0\n1 0\n");
  CHECK_THAT(first, Catch::Matchers::Contains("8 bytes"));
  CHECK(content("0 0\n1 0\n") == first);
  CHECK(content("0 0\n1 1\n") != first);
  CHECK(content(std::string(200000, ' ')) != content(std::string(200000, '\n')));
}

TEST_CASE("what a run leaves that was killed is taken over", "[examples][fault]") {
  Run run;
  const fs::path out = run.scratch / "out";
  fs::create_directory(out);
  const ::pid_t child = ::fork();
  if (child == 0) {
    OutputLock lock;
    lock.acquire(out);
    ::_exit(0);  // nothing is cleaned up
  }
  ::waitpid(child, nullptr, 0);
  REQUIRE(fs::exists(out / ".lock"));
  run.with({"--output", out.string(), "--overwrite"}, [&](const Settings& settings) {
    prepare_output(settings);
    std::ostringstream owner;
    owner << std::ifstream(out / ".lock").rdbuf();
    CHECK_THAT(owner.str(),
               Catch::Matchers::StartsWith("process " + std::to_string(::getpid()) + " on "));
  });
  CHECK(run.err == "");
}

}  // namespace sphmbs::examples
